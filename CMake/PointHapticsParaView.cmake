# The build of the ParaView plugin: Core, Haptics, Filters, IO and Rendering from the same sources as everywhere, against
# the VTK that ParaView brings along, and nothing else. One shared object, as a plugin is copied and loaded by itself.

# ParaView's VTK needs MPI::MPI_C and does not look for it.
find_package(MPI REQUIRED COMPONENTS C)
find_package(ParaView 5.11 REQUIRED COMPONENTS WrapClientServer ProcessXML RemotingCore RemotingServerManager
  RemotingViews)
message(STATUS "ParaView plugin: for ParaView ${ParaView_VERSION} in ${ParaView_DIR}")

set(POINTHAPTICS_HAS_MPI ON)
set(BUILD_SHARED_LIBS OFF)
add_subdirectory(Modules/Core)
add_subdirectory(Modules/Haptics)
set(POINTHAPTICS_USE_LIBUSB OFF)
set(POINTHAPTICS_USE_HIDAPI OFF)
add_subdirectory(Modules/Devices)
vtk_module_scan(
  MODULE_FILES
    "${CMAKE_CURRENT_SOURCE_DIR}/Modules/Filters/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Modules/IO/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Modules/Parallel/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Modules/ParaView/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Modules/Rendering/vtk.module"
    "${CMAKE_CURRENT_SOURCE_DIR}/Modules/Scene/vtk.module"
  PROVIDES_MODULES pointhaptics_provided
  WANT_BY_DEFAULT ON)
vtk_module_build(
  MODULES ${pointhaptics_provided}
  PACKAGE PointHapticsParaView
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}"
  INSTALL_HEADERS OFF)

set(BUILD_SHARED_LIBS ON)
paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/Modules/ParaView/Plugin/paraview.plugin"
  PROVIDES_PLUGINS pointhaptics_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
paraview_plugin_build(
  PLUGINS ${pointhaptics_plugins}
  LIBRARY_SUBDIRECTORY "${PARAVIEW_PLUGIN_SUBDIR}"
  PLUGINS_COMPONENT paraview
  DISABLE_XML_DOCUMENTATION ON)

include(PointHapticsPackages)
