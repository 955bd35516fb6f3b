/// Scenes near the hand that come later than the hand.
#include "Benchmark/Touch/Methods/LateScenes.h"
#include "Benchmark/Touch/Methods/TouchMethod.h"
#include "Benchmark/Touch/TouchMesh.h"

#include <gtest/gtest.h>

namespace
{

using namespace pointhaptics;
using namespace pointhaptics::bench::touch;

constexpr double kEdge = 0.01;

/// A box that is finer near its edges.
TouchScene boxScene()
{
  constexpr std::int64_t kPoints = 100000;
  const TouchMesh box =
    blockMesh({ -kEdge, kEdge }, { -kEdge, kEdge }, { -kEdge, kEdge }, [](int, int, int) { return true; });
  return makeTouchScene(samplesOf(box, kPoints, 1), {});
}

const Vec3 kOnEdge{ kEdge, 0.0, kEdge };

TEST(LateScenes, ComeSoManyTicksAfterTheLook)
{
  const TouchScene scene = boxScene();
  ASSERT_TRUE(scene.local);
  for (const int late : { 0, 3 })
  {
    LateScenes scenes(scene.local, scene.scene, late);
    for (int tick = 0; tick < 6; ++tick)
    {
      const HapticScene* const felt = scenes.at(kOnEdge, kOnEdge);
      EXPECT_EQ(felt->isLocal(), tick >= late) << late << ' ' << tick;
    }
  }
}

TEST(LateScenes, AreNotLookedForWhileOneIsComing)
{
  const TouchScene scene = boxScene();
  ASSERT_TRUE(scene.local);
  LateScenes scenes(scene.local, scene.scene, 3);
  const Vec3 other{ -kEdge, 0.0, kEdge };
  EXPECT_FALSE(scenes.at(kOnEdge, kOnEdge)->isLocal());
  EXPECT_FALSE(scenes.at(other, other)->isLocal());
  EXPECT_FALSE(scenes.at(other, other)->isLocal());
  EXPECT_TRUE(scenes.at(other, other)->covers(kOnEdge)) << "of the place of the look";
  for (int tick = 4; tick < 7; ++tick)
  {
    EXPECT_TRUE(scenes.at(other, other)->covers(kOnEdge)) << tick;
  }
  const HapticScene* const next = scenes.at(other, other);
  EXPECT_TRUE(next->covers(other));
  EXPECT_FALSE(next->covers(kOnEdge));
}

} // namespace
