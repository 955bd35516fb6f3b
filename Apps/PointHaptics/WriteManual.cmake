# cmake -DPROGRAM=<pointhaptics> -DFOLDER=<folder> -P WriteManual.cmake
# Writes pointhaptics.1 (man page) and pointhaptics (bash completion) into the folder.
file(MAKE_DIRECTORY "${FOLDER}")
foreach (pair "man:pointhaptics.1" "bash:pointhaptics")
  string(REPLACE ":" ";" pair "${pair}")
  list(GET pair 0 what)
  list(GET pair 1 name)
  execute_process(COMMAND "${PROGRAM}" manual ${what}
    OUTPUT_FILE "${FOLDER}/${name}" RESULT_VARIABLE code ERROR_VARIABLE error)
  if (NOT code EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} manual ${what} failed: ${error}")
  endif ()
endforeach ()
