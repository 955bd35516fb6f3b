# Compiler settings every target of this project takes: warnings and sanitizers. Nothing here is
# installed or seen by users of the package.
add_library(pointhaptics_compiler INTERFACE)
target_compile_options(pointhaptics_compiler INTERFACE -Wall -Wextra -Wshadow)
if (CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 14)
  # It takes the members of a std::optional that emplace() fills for uninitialized.
  target_compile_options(pointhaptics_compiler INTERFACE -Wno-maybe-uninitialized)
endif ()
if (POINTHAPTICS_WARNINGS_AS_ERRORS)
  target_compile_options(pointhaptics_compiler INTERFACE -Werror)
endif ()
if (POINTHAPTICS_SANITIZE)
  add_compile_options(-fsanitize=${POINTHAPTICS_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${POINTHAPTICS_SANITIZE})
endif ()
if (POINTHAPTICS_BUILD_FUZZERS)
  if (NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "POINTHAPTICS_BUILD_FUZZERS needs clang: add -DCMAKE_CXX_COMPILER=clang++ to a new build folder")
  endif ()
  # Every file tells libFuzzer which of its branches were taken.
  add_compile_options(-fsanitize=fuzzer-no-link)
endif ()

# pointhaptics_compile_with(<target> <interface library>...)
# Compiles a library with the settings, definitions and headers of interface libraries, and links nothing: an installed
# static library would otherwise name them to its users, who have none of them.
function (pointhaptics_compile_with target)
  get_target_property(aliased ${target} ALIASED_TARGET)
  if (aliased)
    set(target ${aliased})
  endif ()
  foreach (library IN LISTS ARGN)
    # As they are now: imported targets are not known everywhere that looks at the library.
    foreach (property IN ITEMS COMPILE_OPTIONS COMPILE_DEFINITIONS INCLUDE_DIRECTORIES)
      get_target_property(${property} ${library} INTERFACE_${property})
      if (NOT ${property})
        set(${property} "")
      endif ()
    endforeach ()
    target_compile_options(${target} PRIVATE ${COMPILE_OPTIONS})
    target_compile_definitions(${target} PRIVATE ${COMPILE_DEFINITIONS})
    target_include_directories(${target} SYSTEM PRIVATE ${INCLUDE_DIRECTORIES})
  endforeach ()
endfunction ()

# pointhaptics_compile_together(<target>)
# Compiles a target's files seven at a time, where the headers of VTK, CLI11 or GoogleTest take most of the time. Names in
# their anonymous namespaces must differ.
function (pointhaptics_compile_together target)
  get_target_property(aliased ${target} ALIASED_TARGET)
  if (aliased)
    set(target ${aliased})
  endif ()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 7)
  # A class of a source file may have members of types of that file: GCC takes it for one of a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction ()

# pointhaptics_use_x(<VTK module>)
# Links the X library and defines POINTHAPTICS_USES_X where VTK's windows are those of an X server.
function (pointhaptics_use_x module)
  if (TARGET X11::X11)
    vtk_module_link(${module} PRIVATE X11::X11)
    vtk_module_definitions(${module} PRIVATE POINTHAPTICS_USES_X)
  endif ()
endfunction ()

# pointhaptics_plain_library(<Name> SOURCES ... HEADERS ... [PUBLIC libs...] [PRIVATE libs...] [EXPORT set]
#   [COMPONENTS <of the library> <of its headers>])
# A C++17 library that is no VTK module: target PointHaptics<Name>, alias PointHaptics::<Name>, installed and
# exported with the package. Export set: PointHapticsPlain, of those that do without VTK. Components of the installation: those
# that VTK's modules have.
function (pointhaptics_plain_library name)
  cmake_parse_arguments(ARG "" "EXPORT" "SOURCES;HEADERS;PUBLIC;PRIVATE;COMPONENTS" ${ARGN})
  if (NOT ARG_EXPORT)
    set(ARG_EXPORT PointHapticsPlain)
  endif ()
  if (NOT ARG_COMPONENTS)
    set(ARG_COMPONENTS runtime development)
  endif ()
  list(GET ARG_COMPONENTS 0 runtime)
  list(GET ARG_COMPONENTS 1 development)
  set(target "PointHaptics${name}")
  add_library(${target} ${ARG_SOURCES} ${ARG_HEADERS})
  add_library(PointHaptics::${name} ALIAS ${target})
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_include_directories(${target} PUBLIC
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/Modules>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/PointHaptics>")
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  pointhaptics_compile_with(${target} pointhaptics_compiler)
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  install(TARGETS ${target} EXPORT ${ARG_EXPORT}
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT ${runtime}
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${runtime} NAMELINK_COMPONENT ${development}
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${development})
  list(TRANSFORM ARG_HEADERS PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" OUTPUT_VARIABLE headers)
  set_target_properties(${target} PROPERTIES POINTHAPTICS_HEADERS "${headers}") # for the documentation
  foreach (header IN LISTS ARG_HEADERS)
    get_filename_component(folder "${header}" DIRECTORY)
    install(FILES "${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/PointHaptics/${name}/${folder}"
      COMPONENT ${development})
  endforeach ()
endfunction ()
