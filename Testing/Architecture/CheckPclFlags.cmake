# cmake -DCOMMANDS=<compile_commands.json> -P CheckPclFlags.cmake
# Fails where a file that includes PCL or Eigen is compiled for wider instructions than the baseline: Eigen's alignment
# would differ from that of PCL's own libraries, and the program would crash. Such files are known by PCL's folder of headers.
cmake_minimum_required(VERSION 3.18)
file(STRINGS "${COMMANDS}" lines REGEX "\"command\"")
set(number_of_files 0)
foreach (line IN LISTS lines)
  if (line MATCHES "include/pcl-")
    math(EXPR number_of_files "${number_of_files} + 1")
    if (line MATCHES "-march=|-mavx|-mfma|-msse4|-mtune=native")
      message(SEND_ERROR "a file that includes PCL is compiled for wider instructions, take the flag away: ${line}")
    endif ()
  endif ()
endforeach ()
if (number_of_files EQUAL 0)
  message(FATAL_ERROR "${COMMANDS}: no file includes PCL: is this the build with the module PCL?")
endif ()
message(STATUS "${number_of_files} files include PCL, none for wider instructions")
