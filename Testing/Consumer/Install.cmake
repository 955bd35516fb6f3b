# cmake -DBUILD=<build folder> -DSCRATCH=<folder> -DCONFIG=<Release...> -P Install.cmake
# Installs into SCRATCH/prefix. The folder starts empty: no file, and no cache of a consumer, of an earlier run may help.
file(REMOVE_RECURSE "${SCRATCH}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${SCRATCH}/prefix" --config "${CONFIG}"
  RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE error)
if (NOT code EQUAL 0)
  message(FATAL_ERROR "cmake --install ${BUILD} failed:\n${error}")
endif ()
if (EXISTS "${SCRATCH}/prefix/bin/pointhaptics")
  foreach (pattern share/man/man1/pointhaptics.1 share/bash-completion/completions/pointhaptics
      share/applications/pointhaptics.desktop share/mime/packages/pointhaptics.xml
      share/icons/hicolor/scalable/apps/pointhaptics.svg)
    file(GLOB found "${SCRATCH}/prefix/${pattern}")
    if (NOT found)
      message(FATAL_ERROR "cmake --install has not installed ${pattern}")
    endif ()
  endforeach ()
endif ()
