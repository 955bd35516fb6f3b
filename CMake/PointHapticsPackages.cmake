# The target "package" and the program cpack make Debian packages of what was built: a package per component of the
# installation. Dependencies on libraries are found by dpkg-shlibdeps (package dpkg-dev, and file).
#
#     cpack --config build/release/CPackConfig.cmake -B build/packages

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pointhaptics)
set(CPACK_PACKAGE_CONTACT "The PointHaptics authors <pointhaptics@localhost>")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_COMPONENTS_ALL "")

# pointhaptics_package(<component> <package> SECTION <section> SUMMARY <one line> TEXT <sentences>
#   [DEPENDS <package>...] [RECOMMENDS <package>...])
# Dependencies are those beside the libraries that the files link.
macro (pointhaptics_package component package)
  cmake_parse_arguments(ARG "" "SECTION;SUMMARY;TEXT" "DEPENDS;RECOMMENDS" ${ARGN})
  string(TOUPPER "${component}" _name)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  list(JOIN ARG_DEPENDS ", " CPACK_DEBIAN_${_name}_PACKAGE_DEPENDS)
  list(JOIN ARG_RECOMMENDS ", " CPACK_DEBIAN_${_name}_PACKAGE_RECOMMENDS)
  set(CPACK_DEBIAN_${_name}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${_name}_PACKAGE_SECTION ${ARG_SECTION})
  set(CPACK_DEBIAN_${_name}_DESCRIPTION "${ARG_SUMMARY}\n${ARG_TEXT}")
  # cpack asks "file" about each of the headers otherwise, none of which links a library.
  if (ARG_SECTION STREQUAL libdevel)
    set(CPACK_DEBIAN_${_name}_PACKAGE_SHLIBDEPS OFF)
  endif ()
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "share/doc/${package}" RENAME copyright
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro ()

set(_same "(= ${PROJECT_VERSION})")
if (POINTHAPTICS_BUILD_PARAVIEW)
  # It may lie where no package installs it (Testing/ParaView/root.sh): its libraries are those of the package all the same.
  get_filename_component(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${ParaView_DIR}/../.." ABSOLUTE)
  string(REGEX MATCH "^[0-9]+\\.[0-9]+" _version "${ParaView_VERSION}")
  pointhaptics_package(paraview paraview-pointhaptics SECTION science
    SUMMARY "PointHaptics: plugin for ParaView"
    TEXT "Exact voxel means, kernel bandwidths, and a reader and a writer of point clouds."
    DEPENDS "paraview (>= ${_version})" "paraview (<< ${_version}.99)")
else ()
  if (POINTHAPTICS_BUILD_APPS)
    pointhaptics_package(program pointhaptics SECTION science
      SUMMARY "See and feel raw point clouds"
      TEXT "The program: viewer with haptic rendering, resampling, kernel bandwidths, conversion of files."
      DEPENDS "libpointhaptics0 ${_same}")
  endif ()
  # Apart, as the plain program needs no mpirun. The library of the commands, which it shares with that, is in runtime.
  if (TARGET pointhaptics-mpi)
    pointhaptics_package(mpi pointhaptics-mpi SECTION science
      SUMMARY "See and feel raw point clouds: on many processes"
      TEXT "The program pointhaptics-mpi: resampling and kernel bandwidths under mpirun."
      DEPENDS "libpointhaptics0 ${_same}" "libpointhaptics-mpi0 ${_same}" RECOMMENDS "openmpi-bin | mpi-default-bin")
  endif ()
  pointhaptics_package(runtime libpointhaptics0 SECTION libs
    SUMMARY "See and feel raw point clouds: libraries"
    TEXT "VTK filters for point clouds, readers and writers, and a haptic servo loop.")
  pointhaptics_package(development libpointhaptics-dev SECTION libdevel
    SUMMARY "See and feel raw point clouds: headers, CMake package and examples"
    TEXT "find_package(PointHaptics) for programs; the plain components do without VTK."
    DEPENDS "libpointhaptics0 ${_same}" libvtk9-dev RECOMMENDS cmake)
  # Apart, as the other libraries need no MPI.
  if (POINTHAPTICS_HAS_MPI)
    pointhaptics_package(parallel libpointhaptics-mpi0 SECTION libs
      SUMMARY "See and feel raw point clouds: library for many processes"
      TEXT "The VTK filters for clouds whose points lie on several processes, on VTK's MPI."
      DEPENDS "libpointhaptics0 ${_same}")
    pointhaptics_package(parallel-development libpointhaptics-mpi-dev SECTION libdevel
      SUMMARY "See and feel raw point clouds: headers for many processes"
      TEXT "The component Parallel of find_package(PointHaptics)."
      DEPENDS "libpointhaptics-mpi0 ${_same}" "libpointhaptics-dev ${_same}")
  endif ()
  # Apart, as PCL brings many libraries.
  if (POINTHAPTICS_HAS_PCL)
    pointhaptics_package(pcl libpointhaptics-pcl0 SECTION libs
      SUMMARY "See and feel raw point clouds: library for PCL"
      TEXT "PclVoxelMean in the place of pcl::VoxelGrid, and clouds of PCL and VTK converted."
      DEPENDS "libpointhaptics0 ${_same}")
    pointhaptics_package(pcl-development libpointhaptics-pcl-dev SECTION libdevel
      SUMMARY "See and feel raw point clouds: headers for PCL"
      TEXT "The component PCL of find_package(PointHaptics)."
      DEPENDS "libpointhaptics-pcl0 ${_same}" "libpointhaptics-dev ${_same}" libpcl-dev)
  endif ()
  if (POINTHAPTICS_HAS_PYTHON)
    pointhaptics_package(python python3-pointhaptics SECTION python
      SUMMARY "See and feel raw point clouds: Python package"
      TEXT "Functions over NumPy arrays, and the VTK classes wrapped."
      DEPENDS "libpointhaptics0 ${_same}" python3 python3-numpy python3-vtk9)
  endif ()
endif ()
# So that the loader finds new libraries, and packages of others depend on them.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PCL_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PARALLEL_PACKAGE_GENERATE_SHLIBS ON)
include(CPack)
