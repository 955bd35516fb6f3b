# cmake -DFOLDER=<scratch> -P CheckWordsSelfTest.cmake
# Plants one line at a time into a small tree and expects CheckWords.cmake to accept or refuse it.
cmake_minimum_required(VERSION 3.18)

function (check_planted expected file line instead)
  file(REMOVE_RECURSE "${FOLDER}")
  file(WRITE "${FOLDER}/Modules/Core/A.h" "#pragma once\n")
  file(WRITE "${FOLDER}/${file}" "// A file\n\n${line}\n")
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DROOT=${FOLDER}" -P "${CMAKE_CURRENT_LIST_DIR}/CheckWords.cmake"
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE error)
  string(REGEX REPLACE "[ \n]+" " " error "${error}")
  if (expected STREQUAL "accepted" AND NOT code EQUAL 0)
    message(SEND_ERROR "${line} was refused:\n${error}")
  elseif (expected STREQUAL "refused" AND (code EQUAL 0 OR NOT error MATCHES "${file}:3: [A-Za-z:_]+: say ${instead}"))
    message(SEND_ERROR "${line} was not refused with file, line and word:\n${output}${error}")
  endif ()
endfunction ()

check_planted(accepted Modules/Haptics/A.h "class HapticPort; // a share of [all] names" "")
check_planted(accepted Modules/Haptics/A.cxx "PointRecordPool pool; simd::Pack pack;" "")
check_planted(accepted Documentation/Changes.md "`HapticPort` was `HandPort`." "")
check_planted(refused Modules/Haptics/A.h "class HandPort; // [x]" HapticPort)
check_planted(refused Modules/Haptics/A.cxx "  proxy.rehearse();" prefetch)
check_planted(refused Modules/Core/Resample/A.h "RecordPool pool;" PointRecordPool)
check_planted(refused Apps/PointHaptics/A.cxx "kernel::sum(1);" simd::)
check_planted(refused Testing/Unit/A.cxx "loop.statistics().missedTicks" deadlineMisses)
check_planted(refused Documentation/A.md "The lateness of a tick." jitter)
check_planted(refused Modules/Core/CMakeLists.txt "  FalconServo.cxx" FalconProtocol)
