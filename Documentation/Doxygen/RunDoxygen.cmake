# cmake -DDOXYGEN=<program> -DDOXYFILE=<file> -DWARNINGS=<its WARN_LOGFILE> -P RunDoxygen.cmake
# Builds the pages and fails with what is wrong in the comments: parameters that a function has not, references to
# nothing, broken commands, classes and structs without a description.
cmake_minimum_required(VERSION 3.18)

if (NOT DOXYGEN OR DOXYGEN MATCHES "NOTFOUND")
  message(STATUS "skipped: doxygen is not installed")
  return ()
endif ()
execute_process(COMMAND "${DOXYGEN}" "${DOXYFILE}" RESULT_VARIABLE result ERROR_VARIABLE error)
if (NOT result EQUAL 0)
  message(FATAL_ERROR "${DOXYGEN} ${DOXYFILE}: ended with ${result}\n${error}")
endif ()
file(STRINGS "${WARNINGS}" problems)
# Names and types say much: a member need not have a comment, nor a comment all parameters.
list(FILTER problems EXCLUDE REGEX ": Member .* is not documented\\.$")
list(FILTER problems EXCLUDE REGEX ": The following parameters? of .* (is|are) not documented:$")
list(FILTER problems EXCLUDE REGEX "^ +parameter '[^']+'$|^ *$")
if (problems)
  list(LENGTH problems number)
  list(JOIN problems "\n  " text)
  message(FATAL_ERROR "${number} faults in the comments of installed headers:\n  ${text}")
endif ()
