/// @file
/// The scenes and the methods of the touch benchmark, each made in one place.
#pragma once

#include "Benchmark/Proxy/Scenes.h"

#include "Haptics/LocalScene.h"
#include "Haptics/Proxy.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics::bench::touch
{

struct TouchSceneSettings
{
  double voxelSize = 1e-3 / 3.0; ///< Metres.
  bool raw = false;              ///< The points themselves, no voxels.
  bool local = true;             ///< Scenes as fine as the points near the hand, as the program makes them.
  int lateTicks = 0;             ///< They come so much later than the hand.
};

/// The cloud under a method. Null scene: the cloud has no finite point, or no lattice can be had.
struct TouchScene
{
  proxy::Scene scene;
  std::shared_ptr<const std::vector<Vec3>> points; ///< The cloud itself.
  std::shared_ptr<const PointIndex> local;         ///< Null: the scene of the whole cloud everywhere.
  int lateTicks = 0;                               ///< As TouchSceneSettings has it.
};

/// The one place where scenes are made: a scene that is refined near the hand is to be had from here.
TouchScene makeTouchScene(std::vector<Vec3> points, const TouchSceneSettings& settings);

/// One way of touching a cloud. step() is timed; reset() and prepare() are not.
class TouchMethod
{
public:
  virtual ~TouchMethod() = default;
  /// Out of contact, in @p scene, which outlives its use.
  virtual void reset(const TouchScene& scene) = 0;
  /// Does the work of the thread beside the servo loop before @p hip is felt.
  virtual void prepare(const Vec3& hip) { static_cast<void>(hip); }
  virtual ProxyState step(const Vec3& hip, double dt) = 0;
};

struct Contestant
{
  std::string name; ///< As on the command line.
  std::function<std::unique_ptr<TouchMethod>()> make;
};

/// Every method there is, the program's default first. @param wanted the instructions of those that are a
/// Proxy.
std::vector<Contestant> contestants(InstructionSet wanted = InstructionSet::Automatic);
std::vector<std::string> contestantNames();
/// Those of @p names, all where that is empty.
std::vector<Contestant> contestantsNamed(
  const std::vector<std::string>& names, InstructionSet wanted = InstructionSet::Automatic);

/// The program's default method without prefetching, so that a step's time includes its cache misses.
std::unique_ptr<TouchMethod> proxyWithoutPrefetch(
  const ContactParameters& contact, InstructionSet wanted = InstructionSet::Automatic);

} // namespace pointhaptics::bench::touch
