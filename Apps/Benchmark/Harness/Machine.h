/// @file
/// The machine a figure was measured on, as far as the figure depends on it. No names of hosts or users.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace pointhaptics
{
namespace bench
{

struct Machine
{
  std::string processor; ///< Model name.
  int cores = 1;
  std::string caches;
  double memoryGigabytes = 0.0;
  std::string system;   ///< Name and version of the distribution.
  std::string compiler; ///< Name, version, build type.
  std::string vtk;      ///< Version and SMP back end.
  double load = 0.0;    ///< Runnable threads, mean of the last minute, when this was asked.
};

Machine thisMachine();
nlohmann::ordered_json toJson(const Machine& machine);
/// One sentence for a reader.
std::string describe(const Machine& machine);

/// Bytes that can be had without pushing anything out; 0 where that is unknown.
std::int64_t availableMemory();

} // namespace bench
} // namespace pointhaptics
