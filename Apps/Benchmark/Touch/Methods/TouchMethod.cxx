#include "Benchmark/Touch/Methods/TouchMethod.h"

#include "Benchmark/Touch/Methods/LateScenes.h"

#include "SmpExecutor.h"

#include <algorithm>
#include <optional>

namespace pointhaptics::bench::touch
{
namespace
{

/// A method of the class Proxy.
class ProxyTouch : public TouchMethod
{
public:
  ProxyTouch(const HapticParameters& parameters, InstructionSet wanted, bool prefetches = true)
    : proxy_(parameters, wanted)
    , prefetches_(prefetches)
  {
  }
  void reset(const TouchScene& scene) override
  {
    proxy_.setScene(nullptr);
    scenes_.reset();
    if (scene.local)
    {
      scenes_.emplace(scene.local, scene.scene, scene.lateTicks);
    }
    proxy_.setScene(scene_ = scene.scene.get());
    proxy_.reset();
    last_ = ProxyState();
  }
  void prepare(const Vec3& hip) override
  {
    const HapticScene* next = scenes_ ? scenes_->at(hip, last_.contact ? last_.proxy : hip) : scene_;
    if (next != scene_)
    {
      proxy_.setScene(scene_ = next);
    }
    // The servo loop does so in the time before each tick, when it has taken the scene.
    if (prefetches_)
    {
      proxy_.prefetch();
    }
  }
  ProxyState step(const Vec3& hip, double dt) override { return last_ = proxy_.step(hip, dt); }

private:
  Proxy proxy_;
  bool prefetches_;
  std::optional<LateScenes> scenes_;
  const HapticScene* scene_ = nullptr;
  ProxyState last_;
};

Contestant ofProxy(const std::string& name, const HapticParameters& parameters, InstructionSet wanted)
{
  return { name, [parameters, wanted] { return std::make_unique<ProxyTouch>(parameters, wanted); } };
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
  scene.lateTicks = settings.lateTicks;
  scene.scene = proxy::sceneOf(points, how);
  scene.points = std::make_shared<const std::vector<Vec3>>(std::move(points));
  if (settings.local && !settings.raw && scene.scene)
  {
    const auto index = std::make_shared<PointIndex>();
    const PointView view(scene.points->data(), std::int64_t(scene.points->size()));
    scene.local = index->build(view, SmpExecutor()) == Status::Ok ? index : nullptr;
  }
  return scene;
}

std::vector<Contestant> contestants(InstructionSet wanted)
{
  std::vector<Contestant> all;
  all.push_back(ofProxy("surface-fit", {}, wanted));
  HapticParameters sphere;
  sphere.method = ProxyMethod::Sphere;
  all.push_back(ofProxy("sphere", sphere, wanted));
  all.push_back(ofProxy("gradient-steps-tuned", gradientSteps(GradientStepsParameters::tuned()), wanted));
  all.push_back(ofProxy("gradient-steps-paper", gradientSteps(GradientStepsParameters::paper()), wanted));
  return all;
}

std::unique_ptr<TouchMethod> proxyWithoutPrefetch(const ContactParameters& contact, InstructionSet wanted)
{
  HapticParameters parameters;
  parameters.contact = contact;
  return std::make_unique<ProxyTouch>(parameters, wanted, false);
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

std::vector<Contestant> contestantsNamed(const std::vector<std::string>& names, InstructionSet wanted)
{
  std::vector<Contestant> chosen;
  for (Contestant& contestant : contestants(wanted))
  {
    if (names.empty() || std::find(names.begin(), names.end(), contestant.name) != names.end())
    {
      chosen.push_back(std::move(contestant));
    }
  }
  return chosen;
}

} // namespace pointhaptics::bench::touch
