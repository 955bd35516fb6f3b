# Sets POINTHAPTICS_HAS_MPI where the module Parallel and the program pointhaptics-mpi can be built. Included at the top, so
# that Modules, Apps and Testing see the same imported targets.
option(POINTHAPTICS_BUILD_MPI "Build the module Parallel and pointhaptics-mpi, where VTK's MPI is found" ON)
set(POINTHAPTICS_HAS_MPI OFF)
if (NOT POINTHAPTICS_BUILD_MPI)
  return ()
endif ()
find_package(MPI QUIET COMPONENTS C)
if (TARGET MPI::MPI_C)
  find_package(VTK QUIET OPTIONAL_COMPONENTS ParallelCore ParallelMPI)
endif ()
if (TARGET MPI::MPI_C AND TARGET VTK::ParallelMPI)
  set(POINTHAPTICS_HAS_MPI ON)
  list(APPEND POINTHAPTICS_VTK_COMPONENTS ParallelCore ParallelMPI) # for users of the package
  message(STATUS "MPI: on, ${MPI_C_LIBRARY_VERSION_STRING}")
else ()
  message(STATUS "MPI: off, an MPI and VTK's ParallelMPI were not found (packages libopenmpi-dev and libvtk9-dev)")
endif ()
