#include "Benchmark/Harness/Machine.h"

#include <fmt/format.h>
#include <vtkSMPTools.h>
#include <vtkVersion.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <malloc.h>
#include <unistd.h>

namespace pointhaptics::bench
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

constexpr const char* kStatus = "/proc/self/status";

double kilobytesOf(const char* file, const std::string& key)
{
  return std::strtod(valueOf(file, key).c_str(), nullptr);
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

Json thisMachine()
{
  const std::string processor = valueOf("/proc/cpuinfo", "model name");
  double load = 0.0;
  const bool hasLoad = getloadavg(&load, 1) == 1;
  return { { "processor", processor.empty() ? "unknown processor" : processor },
    { "cores", std::max(1u, std::thread::hardware_concurrency()) }, { "caches", cacheText() },
    { "memory_gigabytes", kilobytesOf("/proc/meminfo", "MemTotal") / (1024.0 * 1024.0) },
    { "system", systemText() }, { "compiler", compilerText() },
    { "vtk", fmt::format("VTK {}, {}", vtkVersion::GetVTKVersion(), vtkSMPTools::GetBackend()) },
    { "load", hasLoad ? load : 0.0 } };
}

std::int64_t peakBytesOf(const std::function<void()>& work)
{
#ifdef __GLIBC__
  malloc_trim(0); // or the work is served from pages that were freed before it
#endif
  const double before = kilobytesOf(kStatus, "VmRSS");
  std::ofstream reset("/proc/self/clear_refs");
  reset << "5" << std::flush; // the high-water mark begins anew
  work();
  return reset && before > 0.0 ? std::int64_t(1024.0 * (kilobytesOf(kStatus, "VmHWM") - before)) : -1;
}

} // namespace pointhaptics::bench
