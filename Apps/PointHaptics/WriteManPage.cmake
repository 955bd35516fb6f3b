# cmake -DPROGRAM=<program> -DPAGE=<file> -P WriteManPage.cmake
# Writes the man page of a program beside pointhaptics; a program that cannot run here has none.
get_filename_component(folder "${PAGE}" DIRECTORY)
file(MAKE_DIRECTORY "${folder}")
execute_process(COMMAND "${PROGRAM}" manual OUTPUT_FILE "${PAGE}" RESULT_VARIABLE code ERROR_QUIET)
if (NOT code EQUAL 0)
  file(REMOVE "${PAGE}")
  message(STATUS "no man page of ${PROGRAM}: it does not run on this machine")
endif ()
