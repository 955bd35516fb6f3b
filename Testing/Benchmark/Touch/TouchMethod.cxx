#include "Benchmark/Touch/TouchMethod.h"

#include "Benchmark/Touch/OccupancyProxy.h"

#include <algorithm>

namespace pointhaptics
{
namespace bench
{
namespace touch
{
namespace
{

/// A method of the class Proxy.
class ProxyTouch : public TouchMethod
{
public:
  explicit ProxyTouch(const HapticParameters& parameters)
    : proxy_(parameters)
  {
  }
  void reset(const TouchScene& scene) override
  {
    proxy_.setScene(scene.scene.get());
    proxy_.reset();
  }
  ProxyState step(const Vec3& hip, double dt) override { return proxy_.step(hip, dt); }

private:
  Proxy proxy_;
};

Contestant ofProxy(const std::string& name, const HapticParameters& parameters)
{
  return { name, [parameters] { return std::make_unique<ProxyTouch>(parameters); } };
}

HapticParameters gradientSteps(const GradientStepsParameters& gains)
{
  HapticParameters parameters;
  parameters.method = ProxyMethod::GradientSteps;
  parameters.gradientSteps = gains;
  return parameters;
}

} // namespace

TouchScene makeTouchScene(std::vector<Vec3> points, const TouchSceneSettings& settings)
{
  proxy::SceneSettings how;
  how.voxelSize = settings.voxelSize;
  how.raw = settings.raw;
  TouchScene scene;
  scene.scene = proxy::sceneOf(points, how);
  scene.points = std::make_shared<const std::vector<Vec3>>(std::move(points));
  return scene;
}

std::vector<Contestant> contestants()
{
  std::vector<Contestant> all;
  all.push_back(ofProxy("surface-fit", {}));
  // The spherical proxy alone, ProxyMethod::Sphere, belongs here as "sphere".
  all.push_back(ofProxy("gradient-steps-tuned", gradientSteps(GradientStepsParameters::tuned())));
  all.push_back(ofProxy("gradient-steps-paper", gradientSteps(GradientStepsParameters::paper())));
  all.push_back(
    { "occupancy", [] { return std::make_unique<OccupancyProxy>(ContactParameters().stiffness); } });
  return all;
}

std::vector<std::string> contestantNames()
{
  std::vector<std::string> names;
  for (const Contestant& contestant : contestants())
  {
    names.push_back(contestant.name);
  }
  return names;
}

std::vector<Contestant> contestantsNamed(const std::vector<std::string>& names)
{
  std::vector<Contestant> chosen;
  for (Contestant& contestant : contestants())
  {
    if (names.empty() || std::find(names.begin(), names.end(), contestant.name) != names.end())
    {
      chosen.push_back(std::move(contestant));
    }
  }
  return chosen;
}

} // namespace touch
} // namespace bench
} // namespace pointhaptics
