# Sets POINTHAPTICS_HAS_PCL where the module PCL can be built, and the folders and libraries of PCL and Eigen. PCL's own
# package config asks for far more than two libraries and their headers.
option(POINTHAPTICS_BUILD_PCL "Build the module PCL, where PCL is found" ON)
find_path(POINTHAPTICS_EIGEN_INCLUDE_DIR Eigen/Core PATH_SUFFIXES eigen3)
find_path(POINTHAPTICS_PCL_INCLUDE_DIR pcl/io/pcd_io.h PATH_SUFFIXES pcl-1.15 pcl-1.14 pcl-1.13 pcl-1.12)
find_library(POINTHAPTICS_PCL_COMMON_LIBRARY pcl_common)
find_library(POINTHAPTICS_PCL_FILTERS_LIBRARY pcl_filters)
mark_as_advanced(POINTHAPTICS_EIGEN_INCLUDE_DIR POINTHAPTICS_PCL_INCLUDE_DIR POINTHAPTICS_PCL_COMMON_LIBRARY
  POINTHAPTICS_PCL_FILTERS_LIBRARY)
set(POINTHAPTICS_HAS_PCL OFF)
if (POINTHAPTICS_BUILD_PCL)
  if (POINTHAPTICS_EIGEN_INCLUDE_DIR AND POINTHAPTICS_PCL_INCLUDE_DIR AND POINTHAPTICS_PCL_COMMON_LIBRARY
      AND POINTHAPTICS_PCL_FILTERS_LIBRARY)
    set(POINTHAPTICS_HAS_PCL ON)
  else ()
    message(STATUS "PCL: off, PCL was not found (package libpcl-dev)")
  endif ()
endif ()
