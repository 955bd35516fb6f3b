#include "Haptics/Servo/SceneExchange.h"

#include "Haptics/HapticScene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

using namespace pointhaptics;

namespace
{
/// A scene of a few points whose transform carries @p number.
std::shared_ptr<const HapticScene> scene(double number)
{
  HapticSceneInput input;
  for (int i = 0; i < 12; ++i)
  {
    input.points.push_back({ 0.001 * (i % 4), 0.001 * (i / 4), 0.0 });
  }
  input.cellSize = 0.001;
  input.modelToWorkspace = AffineTransform::translation({ number, 0.0, 0.0 });
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status);
}

double numberOf(const HapticScene* taken)
{
  return taken->modelToWorkspace().m[0][3];
}
}

TEST(SceneExchange, GivesNothingBeforeTheFirstScene)
{
  SceneExchange exchange;
  EXPECT_EQ(exchange.acquire(), nullptr);
}

TEST(SceneExchange, GivesTheNewestSceneAgainAndAgain)
{
  SceneExchange exchange;
  exchange.publish(scene(1.0));
  exchange.publish(scene(2.0));
  const HapticScene* taken = exchange.acquire();
  ASSERT_NE(taken, nullptr);
  EXPECT_EQ(numberOf(taken), 2.0);
  EXPECT_EQ(exchange.acquire(), taken);
}

TEST(SceneExchange, FreesASceneThatWasNeverTakenAtTheNextPublish)
{
  SceneExchange exchange;
  std::shared_ptr<const HapticScene> first = scene(1.0);
  const std::weak_ptr<const HapticScene> watched = first;
  exchange.publish(std::move(first));
  EXPECT_FALSE(watched.expired());
  exchange.publish(scene(2.0));
  EXPECT_TRUE(watched.expired());
}

TEST(SceneExchange, KeepsTheSceneBeforeUntilTheCallAfterNext)
{
  SceneExchange exchange;
  std::shared_ptr<const HapticScene> first = scene(1.0);
  const std::weak_ptr<const HapticScene> watched = first;
  exchange.publish(std::move(first));
  exchange.acquire();
  exchange.publish(scene(2.0));
  exchange.acquire();
  exchange.collect();
  EXPECT_FALSE(watched.expired()) << "the acquiring thread may still compare the two";
  exchange.acquire();
  EXPECT_FALSE(watched.expired()) << "acquire() must not free";
  exchange.collect();
  EXPECT_TRUE(watched.expired());
}

TEST(SceneExchange, HandsOverNoScene)
{
  SceneExchange exchange;
  exchange.publish(scene(1.0));
  EXPECT_NE(exchange.acquire(), nullptr);
  exchange.publish(nullptr);
  EXPECT_EQ(exchange.acquire(), nullptr);
}

TEST(SceneExchange, KeepsAtMostFourScenesWhateverTheThreadsDo)
{
  constexpr int kScenes = 2000;
  SceneExchange exchange;
  std::atomic<bool> done{ false };
  std::thread servo(
    [&]
    {
      double last = 0.0;
      const HapticScene* before = nullptr;
      while (last < double(kScenes))
      {
        const HapticScene* const taken = exchange.acquire();
        if (taken)
        {
          ASSERT_GE(numberOf(taken), last);
          // Both are read: a scene freed too early shows under the sanitizers.
          last = numberOf(taken) + (before ? 0.0 * numberOf(before) : 0.0);
        }
        before = taken;
      }
      done = true;
    });
  for (int i = 1; i <= kScenes; ++i)
  {
    exchange.publish(scene(double(i)));
    ASSERT_LE(exchange.numberOfKeptScenes(), 4u);
  }
  servo.join();
  EXPECT_TRUE(done);
}
