# cmake -DROOT=<folder with Modules, Apps, Testing and Documentation> -DAWK=<awk> [-DMOST=<number>] [-DEXCEPT=<folder>]
#   -P CheckComments.cmake
# A comment is a sentence that names its thing: subject, verb, object. Fails where more than MOST comments open with "Of",
# "The same" or "What", and prints them with file and line. EXCEPT leaves out a folder of ROOT.
cmake_minimum_required(VERSION 3.18)

if (NOT DEFINED MOST)
  set(MOST 40)
endif ()
set(files "")
foreach (top IN ITEMS Modules Apps Testing Documentation CMake)
  foreach (kind IN ITEMS *.h *.cxx *.py *.sh *.cmake CMakeLists.txt)
    file(GLOB_RECURSE found "${ROOT}/${top}/${kind}")
    list(APPEND files ${found})
  endforeach ()
endforeach ()
if (EXCEPT)
  list(FILTER files EXCLUDE REGEX "^${ROOT}/${EXCEPT}/")
endif ()
if (NOT files)
  message(FATAL_ERROR "${ROOT}: no source file below Modules, Apps, Testing, Documentation and CMake: is ROOT the folder of the sources?")
endif ()

# One call for each hundred files keeps the command line short.
set(openings "")
list(LENGTH files number)
math(EXPR last "${number} - 1")
foreach (begin RANGE 0 ${last} 100)
  list(SUBLIST files ${begin} 100 some)
  execute_process(COMMAND "${AWK}" -f "${CMAKE_CURRENT_LIST_DIR}/CommentOpenings.awk" ${some}
    OUTPUT_VARIABLE output RESULT_VARIABLE code ERROR_VARIABLE error)
  if (NOT code EQUAL 0)
    message(FATAL_ERROR "${AWK} failed: ${error}")
  endif ()
  string(APPEND openings "${output}")
endforeach ()
string(REGEX MATCHALL "\n" lines "${openings}")
list(LENGTH lines count)
if (count GREATER MOST)
  string(REPLACE "${ROOT}/" "  " openings "${openings}")
  message(FATAL_ERROR "${count} comments open with \"Of\", \"The same\" or \"What\", ${MOST} may: name the thing\n${openings}")
endif ()
message(STATUS "${count} comments in ${number} files open with \"Of\", \"The same\" or \"What\"; ${MOST} may")
