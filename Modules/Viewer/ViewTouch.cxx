#include "ViewTouch.h"

#include "HapticViewerOptions.h"
#include "ViewScene.h"

#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include <vtkPointSet.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

namespace pointhaptics
{

std::vector<ServoSample> feelPath(const HapticScene& scene, const HipPath& path, std::int64_t ticks,
  const HapticParameters& parameters, double rateHz)
{
  using Clock = std::chrono::steady_clock;
  std::vector<ServoSample> samples;
  Proxy proxy(parameters);
  proxy.setScene(&scene);
  samples.reserve(std::size_t(ticks));
  std::size_t hint = 0;
  for (std::int64_t tick = 0; tick < ticks; ++tick)
  {
    ServoSample sample;
    sample.tick = std::uint64_t(tick + 1);
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

std::shared_ptr<IdealForce> idealFor(ViewScene& scene, const HapticViewerOptions& options)
{
  Shape shape = Shape::Plane;
  vtkPointSet* cloud = vtkPointSet::SafeDownCast(scene.resampler()->GetInputDataObject(0, 0));
  if (options.ideal == "none" || !cloud || !cloud->GetPoints())
  {
    return nullptr;
  }
  const bool known = options.ideal == "auto" ? recognizeShape(PointAccess(cloud->GetPoints()).view(), shape)
                                             : shapeFromName(options.ideal, shape);
  return known ? std::make_shared<IdealForce>(shape) : nullptr;
}

double idealForce(IdealForce& ideal, ViewScene& scene, const Vec3& hip, double stiffness)
{
  AffineTransform model;
  const bool isAffine = affineFromTransform(scene.resampler()->GetTransform(), model);
  return isAffine ? std::min(ideal.at(hip, model, stiffness), ForceLimits().maximumForce) : NAN;
}

bool TraceFile::open(const std::string& fileName, std::string& message)
{
  isOpen_ = writer_.open(fileName,
    "t,hip_x,hip_y,hip_z,proxy_x,proxy_y,proxy_z,normal_x,normal_y,normal_z,"
    "force_x,force_y,force_z,radius,contact,update_us",
    message);
  return isOpen_;
}

void TraceFile::add(const std::vector<ServoSample>& samples)
{
  for (const ServoSample& sample : samples)
  {
    const ProxyState& state = sample.state;
    const double row[] = { sample.timeSeconds, state.hip.x, state.hip.y, state.hip.z, state.proxy.x,
      state.proxy.y, state.proxy.z, state.normal.x, state.normal.y, state.normal.z, state.force.x,
      state.force.y, state.force.z, state.radius, state.contact ? 1.0 : 0.0, 1e6 * sample.updateSeconds };
    writer_.row(row, std::size(row));
  }
}

bool TraceFile::close(std::string& message)
{
  const bool committed = !isOpen_ || writer_.commit(message);
  isOpen_ = false;
  return committed;
}

} // namespace pointhaptics
