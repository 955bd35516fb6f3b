# cmake -DFOLDER=<scratch> -DROOT=<checkout> -P RunAndExpectSelfTest.cmake
# RunAndExpect.cmake must see each fault by itself, and no test may go back to what ignores the exit code.
cmake_minimum_required(VERSION 3.18)

# check(<accepted|refused> <what a refusal must say> <arguments of RunAndExpect.cmake...>)
function (check expected words)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "CODE;EXPRESSION;FILES" "COMMAND")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" "-DCODE=${ARG_CODE}" "-DEXPRESSION=${ARG_EXPRESSION}" "-DFILES=${ARG_FILES}"
      -P "${CMAKE_CURRENT_LIST_DIR}/RunAndExpect.cmake" -- ${ARG_COMMAND}
    WORKING_DIRECTORY "${FOLDER}" RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if (expected STREQUAL "accepted" AND NOT code EQUAL 0)
    message(SEND_ERROR "refused, though all was as expected:\n${output}")
  elseif (expected STREQUAL "refused" AND (code EQUAL 0 OR NOT output MATCHES "${words}"))
    message(SEND_ERROR "\"${words}\" was not said, exit code ${code}:\n${output}")
  endif ()
endfunction ()

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
set(hello COMMAND "${CMAKE_COMMAND}" -E echo "hello world")
set(talking COMMAND sh -c "echo hello\\; exit 3")
set(missing COMMAND "${CMAKE_COMMAND}" -E cat nothing.txt)
check(accepted "" CODE 0 EXPRESSION "hello .*d" ${hello})
check(accepted "" CODE 1 EXPRESSION "nothing\\.txt" ${missing})
check(refused "exit code 0, not 1" CODE 1 EXPRESSION "hello" ${hello})
check(refused "exit code 1, not 0" CODE 0 EXPRESSION "nothing\\.txt" ${missing})
check(refused "exit code 3, not 0" CODE 0 EXPRESSION "hello" ${talking})
check(refused "does not match" CODE 0 EXPRESSION "hello .*x" ${hello})
check(refused "is missing" CODE 0 ${hello})

# Files: what lies there from an earlier run must not count.
file(WRITE "${FOLDER}/good.csv" "a,b\n1,2\n3,4\n")
file(WRITE "${FOLDER}/ragged.csv" "a,b\n1,2\n3\n")
file(WRITE "${FOLDER}/text.png" "no picture, but as long as one: 0123456789 0123456789\n")
file(WRITE "${FOLDER}/old.csv" "a,b\n1,2\n3,4\n")
set(copy COMMAND "${CMAKE_COMMAND}" -E copy)
check(accepted "" CODE 0 EXPRESSION ".*" FILES new.csv=2 ${copy} good.csv new.csv)
check(refused "has 2 rows, not 3" CODE 0 EXPRESSION ".*" FILES new.csv=3 ${copy} good.csv new.csv)
check(refused "does not fit the header" CODE 0 EXPRESSION ".*" FILES new.csv=2 ${copy} ragged.csv new.csv)
check(refused "no complete PNG" CODE 0 EXPRESSION ".*" FILES new.png=2x2 ${copy} text.png new.png)
check(refused "old.csv was not written" CODE 0 EXPRESSION "hello" FILES old.csv=2 ${hello})
file(REMOVE_RECURSE "${FOLDER}")

file(GLOB_RECURSE lists "${ROOT}/Testing/CMakeLists.txt" "${ROOT}/Apps/CMakeLists.txt" "${ROOT}/Modules/CMakeLists.txt")
foreach (list IN LISTS lists)
  file(READ "${list}" content)
  if (content MATCHES "PASS_REGULAR_EXPRESSION")
    message(SEND_ERROR "${list}: PASS_REGULAR_EXPRESSION ignores the exit code; use pointhaptics_expect_test")
  endif ()
endforeach ()
