#include "ViewTouch.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace pointhaptics
{
namespace app
{

std::vector<ServoSample> feelPath(
  const HapticScene& scene, const HipPath& path, const HapticParameters& parameters, double rateHz)
{
  using Clock = std::chrono::steady_clock;
  std::vector<ServoSample> samples;
  if (path.points.empty())
  {
    return samples;
  }
  Proxy proxy(parameters);
  proxy.setScene(&scene);
  const auto ticks = static_cast<std::uint64_t>(std::floor(path.duration() * rateHz + 1e-6)) + 1;
  samples.reserve(ticks);
  std::size_t hint = 0;
  for (std::uint64_t tick = 0; tick < ticks; ++tick)
  {
    ServoSample sample;
    sample.tick = tick + 1;
    sample.timeSeconds = path.points.front().timeSeconds + double(tick) / rateHz;
    const Clock::time_point begin = Clock::now();
    sample.state = proxy.step(path.position(sample.timeSeconds, hint), 1.0 / rateHz);
    sample.updateSeconds = std::chrono::duration<double>(Clock::now() - begin).count();
    samples.push_back(sample);
  }
  return samples;
}

const ServoSample& mostTelling(const std::vector<ServoSample>& samples)
{
  const ServoSample* best = &samples.back();
  double largest = 0.0;
  for (const ServoSample& sample : samples)
  {
    const double force = norm(sample.state.force);
    if (sample.state.contact && force > largest)
    {
      largest = force;
      best = &sample;
    }
  }
  return *best;
}

TraceFile::~TraceFile()
{
  if (file_)
  {
    std::fclose(file_);
  }
}

bool TraceFile::open(const std::string& fileName, std::string& message)
{
  file_ = std::fopen(fileName.c_str(), "wb");
  name_ = fileName;
  if (!file_)
  {
    message = fmt::format("{}: cannot be created; check that its folder exists and can be written", fileName);
    return false;
  }
  std::fputs("t,hip_x,hip_y,hip_z,proxy_x,proxy_y,proxy_z,normal_x,normal_y,normal_z,"
             "force_x,force_y,force_z,radius,contact,update_us\n",
    file_);
  return true;
}

void TraceFile::add(const std::vector<ServoSample>& samples)
{
  fmt::memory_buffer rows;
  for (const ServoSample& sample : samples)
  {
    fmt::format_to(std::back_inserter(rows), "{}", sample.timeSeconds);
    const ProxyState& state = sample.state;
    for (const Vec3& v : { state.hip, state.proxy, state.normal, state.force })
    {
      fmt::format_to(std::back_inserter(rows), ",{},{},{}", v.x, v.y, v.z);
    }
    fmt::format_to(std::back_inserter(rows), ",{},{},{:.3f}\n", state.radius, int(state.contact),
      1e6 * sample.updateSeconds);
  }
  std::fwrite(rows.data(), 1, rows.size(), file_);
}

bool TraceFile::close(std::string& message)
{
  if (!file_)
  {
    return true;
  }
  const bool failed = std::ferror(file_) != 0;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (failed || !closed)
  {
    message = fmt::format("{}: not all rows could be written; is the disk full?", name_);
    return false;
  }
  return true;
}

} // namespace app
} // namespace pointhaptics
