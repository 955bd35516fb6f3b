# cmake -DFOLDER=<scratch> -DAWK=<awk> -P CheckCommentsSelfTest.cmake
# Plants one text at a time and expects CheckComments.cmake, which may pass over none, to accept or refuse it.
cmake_minimum_required(VERSION 3.18)

function (check_planted expected file text)
  file(REMOVE_RECURSE "${FOLDER}")
  file(WRITE "${FOLDER}/${file}" "\n${text}\n")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" "-DROOT=${FOLDER}" "-DAWK=${AWK}" -DMOST=0 -P "${CMAKE_CURRENT_LIST_DIR}/CheckComments.cmake"
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE error)
  if (expected STREQUAL "accepted" AND NOT code EQUAL 0)
    message(SEND_ERROR "${text} was refused:\n${error}")
  elseif (expected STREQUAL "refused" AND (code EQUAL 0 OR NOT error MATCHES "\n *${file}:[2-4]: (Of|The same|What)"))
    message(SEND_ERROR "${text} was not refused with file and line:\n${output}${error}")
  endif ()
endfunction ()

check_planted(accepted Modules/Core/A.h "/// The radius of a point.")
check_planted(accepted Modules/Core/A.h "/// The hand moves\n/// Of its own accord.")
check_planted(accepted Modules/Core/A.h "int Of; // Offset of What\n// Whatever is here.")
check_planted(accepted Modules/Core/A.cxx "const char* text = \"What is this\";")
check_planted(refused Modules/Core/A.h "/// Of a point.")
check_planted(refused Modules/Core/A.h "  // The same again.")
check_planted(refused Modules/Core/A.h "/// @file\n/// What a tick does.")
check_planted(refused Modules/Core/A.h "  ///@}\n  /// Of the cloud.")
check_planted(refused Modules/Core/A.h "  /**\n   * What is drawn.\n   */")
check_planted(refused Modules/C/a.h "  double mass; /**< Of the hand, kg. */")
check_planted(refused Apps/PointHaptics/A.cxx "int a = 0; ///< Of the cloud.")
check_planted(refused Testing/A.py "def f():\n    \"\"\"What it returns.\"\"\"")
check_planted(refused Testing/A.sh "run\n# What it runs.")
check_planted(refused CMake/A.cmake "# Of fmt the headers alone.")
