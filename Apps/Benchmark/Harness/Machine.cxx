#include "Benchmark/Harness/Machine.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkSMPTools.h>
#include <vtkVersion.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <unistd.h>

namespace pointhaptics
{
namespace bench
{
namespace
{

/// The text after the separator in the first line of @p file that begins with @p key.
std::string valueOf(const char* file, const std::string& key, char separator = ':')
{
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
  {
    const std::size_t end = line.find(separator);
    if (line.rfind(key, 0) == 0 && end != std::string::npos)
    {
      const std::size_t begin = line.find_first_not_of(" \t", end + 1);
      return begin == std::string::npos ? "" : line.substr(begin);
    }
  }
  return "";
}

double kilobytesOf(const std::string& key)
{
  return std::strtod(valueOf("/proc/meminfo", key).c_str(), nullptr);
}

std::string cacheText()
{
#ifdef _SC_LEVEL2_CACHE_SIZE
  const long second = sysconf(_SC_LEVEL2_CACHE_SIZE);
  const long third = sysconf(_SC_LEVEL3_CACHE_SIZE);
  if (second > 0 && third > 0)
  {
    return fmt::format("L2 {} KiB, L3 {} MiB", second / 1024, third / (1024 * 1024));
  }
#endif
  return "caches unknown";
}

std::string systemText()
{
  const std::string name = valueOf("/etc/os-release", "PRETTY_NAME", '=');
  return name.size() > 2 ? name.substr(1, name.size() - 2) : "unknown system";
}

std::string compilerText()
{
#if defined(__clang__)
  return fmt::format("Clang {}, {}", __clang_version__, POINTHAPTICS_BUILD_TYPE);
#else
  return fmt::format("GCC {}, {}", __VERSION__, POINTHAPTICS_BUILD_TYPE);
#endif
}

} // namespace

Machine thisMachine()
{
  Machine machine;
  machine.processor = valueOf("/proc/cpuinfo", "model name");
  if (machine.processor.empty())
  {
    machine.processor = "unknown processor";
  }
  machine.cores = int(std::max(1u, std::thread::hardware_concurrency()));
  machine.caches = cacheText();
  machine.memoryGigabytes = kilobytesOf("MemTotal") / (1024.0 * 1024.0);
  machine.system = systemText();
  machine.compiler = compilerText();
  machine.vtk = fmt::format("VTK {}, {}", vtkVersion::GetVTKVersion(), vtkSMPTools::GetBackend());
  double load = 0.0;
  machine.load = getloadavg(&load, 1) == 1 ? load : 0.0;
  return machine;
}

nlohmann::ordered_json toJson(const Machine& machine)
{
  return { { "processor", machine.processor }, { "cores", machine.cores }, { "caches", machine.caches },
    { "memory_gigabytes", machine.memoryGigabytes }, { "system", machine.system },
    { "compiler", machine.compiler }, { "vtk", machine.vtk }, { "load", machine.load } };
}

std::string describe(const Machine& machine)
{
  return fmt::format("{}, {} cores, {}, {:.0f} GiB; {}; {}; {}; load before the run {:.1f}.",
    machine.processor, machine.cores, machine.caches, machine.memoryGigabytes, machine.system,
    machine.compiler, machine.vtk, machine.load);
}

std::int64_t availableMemory()
{
  return std::int64_t(1024.0 * kilobytesOf("MemAvailable"));
}

} // namespace bench
} // namespace pointhaptics
