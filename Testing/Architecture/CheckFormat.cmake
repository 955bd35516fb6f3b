# Fails where clang-format-14 would change a source. -DROOT=... -DCLANG_FORMAT=program [-DFILES=...]
cmake_minimum_required(VERSION 3.21)
if (NOT FILES)
  foreach (folder Modules Apps Testing)
    file(GLOB_RECURSE found "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cxx")
    list(APPEND FILES ${found})
  endforeach ()
endif ()
execute_process(COMMAND "${CLANG_FORMAT}" --dry-run -Werror ${FILES}
  WORKING_DIRECTORY "${ROOT}" RESULT_VARIABLE code ERROR_VARIABLE differences)
if (NOT code EQUAL 0)
  message(FATAL_ERROR "Not formatted by .clang-format; run clang-format-14 -i on them:\n${differences}")
endif ()
