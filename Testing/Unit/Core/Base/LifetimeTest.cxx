#include "Core/Base/Lifetime.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

using pointhaptics::Lifetime;
using pointhaptics::WatchedPointer;

namespace
{

struct Watched
{
  ~Watched() { watched.end(); }
  const Lifetime& lifetime() const { return watched; }
  Lifetime watched;
  int value = 7;
};

} // namespace

TEST(WatchedPointer, IsNullOnceItsObjectIsGone)
{
  auto object = std::make_unique<Watched>();
  const WatchedPointer<Watched> pointer(object.get());
  EXPECT_EQ(pointer.get(), object.get());
  object.reset();
  EXPECT_FALSE(pointer);
  EXPECT_FALSE(pointer.use([](Watched&) { FAIL() << "it is gone"; }));
}

TEST(WatchedPointer, PointsToNothingByDefault)
{
  EXPECT_FALSE(WatchedPointer<Watched>());
  EXPECT_FALSE(WatchedPointer<Watched>(nullptr));
  EXPECT_FALSE(WatchedPointer<Watched>().use([](Watched&) {}));
}

TEST(WatchedPointer, DoesNotTakeACopyOfTheObjectForTheObject)
{
  auto object = std::make_unique<Watched>();
  Watched copy(*object);
  const WatchedPointer<Watched> pointer(&copy);
  object.reset();
  EXPECT_EQ(pointer.get(), &copy);
}

TEST(WatchedPointer, KeepsTheObjectWhileAnotherThreadWorksInIt)
{
  auto object = std::make_unique<Watched>();
  const WatchedPointer<Watched> pointer(object.get());
  std::atomic<bool> begun{ false };
  std::atomic<bool> finished{ false };
  std::thread worker(
    [&]
    {
      pointer.use(
        [&](Watched& watched)
        {
          begun = true;
          for (int i = 0; i < 1000; ++i)
          {
            std::this_thread::yield();
          }
          EXPECT_EQ(watched.value, 7);
          finished = true;
        });
    });
  while (!begun)
  {
    std::this_thread::yield();
  }
  object.reset();
  EXPECT_TRUE(finished) << "the destructor waits";
  worker.join();
}
