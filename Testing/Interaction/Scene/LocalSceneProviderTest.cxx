// Touch near the hand while the model moves, compared with scenes of the whole cloud.
#include "LocalSceneProvider.h"
#include "SceneWorker.h"

#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Haptics/Proxy.h"
#include "MadeClouds.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

using namespace pointhaptics;

namespace
{

constexpr double kTick = 0.001;

/// A turn about z by @p degrees, then so much larger, then along x.
AffineTransform placed(double degrees, double scale, double x)
{
  const double angle = degrees * 3.14159265358979323846 / 180.0;
  AffineTransform turn;
  turn.m[0][0] = turn.m[1][1] = std::cos(angle);
  turn.m[0][1] = -std::sin(angle);
  turn.m[1][0] = std::sin(angle);
  return AffineTransform::translation({ x, 0.0, 0.0 }) * AffineTransform::scaling({ scale, scale, scale }) *
    turn;
}

/// The two scenes of a request: of what is near the hand, and of the whole cloud.
struct Scenes
{
  std::shared_ptr<const HapticScene> near;
  std::shared_ptr<const HapticScene> whole;
};

class LocalSceneProviderTest : public ::testing::Test
{
protected:
  LocalSceneProviderTest()
  {
    resampler_->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    resampler_->SetDimensions(300, 300, 300);
    resampler_->ComputeCovarianceOn();
    bandwidth_->ComputeDensityOff();
  }

  Scenes request(const AffineTransform& place, const Vec3& hand, const Vec3& contact)
  {
    SceneRequest request = SceneRequest::of(resampler_, bandwidth_);
    request.recipe.modelToWorkspace = place;
    request.hand = [=]
    {
      Bounds bounds;
      bounds.include(hand);
      bounds.include(contact);
      return bounds;
    };
    Scenes scenes;
    std::mutex mutex;
    request.publish = [&](std::shared_ptr<const HapticScene> scene, std::uint64_t)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      (scene && scene->isLocal() ? scenes.near : scenes.whole) = std::move(scene);
    };
    worker_.request(std::move(request));
    worker_.wait();
    BuiltScene built;
    worker_.take(built);
    return scenes;
  }
  Scenes request(const AffineTransform& place, const Vec3& hand) { return request(place, hand, hand); }

  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  SceneWorker worker_;
};

/// A hand that goes in and out of the surface near @p at, and about there; the states of all its ticks.
std::vector<ProxyState> feel(const HapticScene& scene, const Vec3& at, const Vec3& outward)
{
  Proxy proxy;
  proxy.setScene(&scene);
  std::vector<ProxyState> states;
  for (int i = 0; i < 1000; ++i)
  {
    const double t = kTick * i;
    const double depth = 0.003 * std::sin(6.0 * t) - 0.001;
    const Vec3 aside{ 0.0, 0.0015 * std::sin(17.0 * t), 0.002 * std::sin(11.0 * t) };
    states.push_back(proxy.step(at - depth * outward + aside, kTick));
  }
  return states;
}

struct Difference
{
  int touched = 0;      ///< Ticks in contact with the whole cloud.
  int left = 0;         ///< Ticks outside of what the near one covers.
  double largest = 0.0; ///< Largest difference of the forces, newtons.
  double strongest = 0.0;
};

Difference compare(const Scenes& scenes, const Vec3& at, const Vec3& outward)
{
  const std::vector<ProxyState> near = feel(*scenes.near, at, outward);
  const std::vector<ProxyState> whole = feel(*scenes.whole, at, outward);
  Difference result;
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    const bool isFelt = norm(whole[i].force) > 0.01; // contact may begin and end a tick apart
    EXPECT_TRUE(near[i].contact == whole[i].contact || !isFelt) << i;
    result.touched += whole[i].contact;
    result.left += !scenes.near->covers(near[i].hip) || !scenes.near->covers(near[i].proxy);
    result.largest = std::max(result.largest, norm(near[i].force - whole[i].force));
    result.strongest = std::max(result.strongest, norm(whole[i].force));
  }
  return result;
}

TEST_F(LocalSceneProviderTest, HasTheCellsOfTheWholeCloudWithinReachBitForBit)
{
  worker_.setCloud(trial::shapeCloud(Shape::Torus, 200000, 0.0));
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  const Scenes before = this->request({}, hand);
  ASSERT_NE(before.whole, nullptr);
  ASSERT_NE(before.near, nullptr);
  EXPECT_EQ(before.near->fallback(), nullptr) << "there was no whole one yet";
  const Scenes scenes = this->request(placed(-3.0, 1.1, -0.003), hand);
  ASSERT_NE(scenes.near, nullptr);
  EXPECT_LT(scenes.near->numberOfPoints(), scenes.whole->numberOfPoints() / 2);
  ASSERT_EQ(scenes.near->cellSize(), scenes.whole->cellSize());
  ASSERT_EQ(scenes.near->pyramid().numberOfCellLevels(), scenes.whole->pyramid().numberOfCellLevels());
  const double reach = 40.0 * scenes.near->cellSize(); // to the corners of what is covered, and more
  for (int level = 0; level < scenes.near->pyramid().numberOfCellLevels(); ++level)
  {
    std::vector<Cell> cells[2];
    for (int i = 0; i < 2; ++i)
    {
      (i == 0 ? scenes.near : scenes.whole)
        ->pyramid()
        .visitBall(
          level, hand, reach, [&](std::uint32_t, const Cell& cell, double) { cells[i].push_back(cell); });
    }
    ASSERT_EQ(cells[0].size(), cells[1].size()) << level;
    ASSERT_GT(cells[0].size(), level == 0 ? 2000u : 1u);
    for (std::size_t i = 0; i < cells[0].size(); ++i)
    {
      ASSERT_TRUE(cells[0][i].mean.x == cells[1][i].mean.x && cells[0][i].mean.y == cells[1][i].mean.y &&
        cells[0][i].mean.z == cells[1][i].mean.z && cells[0][i].count == cells[1][i].count &&
        cells[0][i].covariance.xy == cells[1][i].covariance.xy)
        << level << " " << i;
    }
  }
}

TEST_F(LocalSceneProviderTest, WithinReachItIsFeltAsTheWholeCloud)
{
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  struct Case
  {
    std::int64_t points; // the last are sparser than the voxels
    double noise;
    double bound; // part of the strongest force; where index cells differ the ball may lie in another gap
  };
  for (const Case& one : { Case{ 150000, 0.0, 1e-13 }, Case{ 150000, 4e-5, 1e-13 }, Case{ 25000, 0.0, 0.4 } })
  {
    worker_.setCloud(trial::shapeCloud(Shape::Torus, one.points, one.noise));
    for (const AffineTransform& place :
      { AffineTransform(), placed(5.0, 1.0, 0.002), placed(-3.0, 1.1, -0.003), placed(3.0, 0.95, -0.001) })
    {
      const Vec3 surface = place.apply(closestPoint(Shape::Torus, place.inverse().apply(hand)).point);
      const Scenes scenes = this->request(place, hand, surface);
      if (!scenes.near || !scenes.near->fallback())
      {
        EXPECT_EQ(place, AffineTransform());
        continue;
      }
      const Difference difference = compare(scenes, surface, { 1.0, 0.0, 0.0 });
      EXPECT_GT(difference.touched, 200);
      EXPECT_EQ(difference.left, 0);
      EXPECT_GT(difference.strongest, 1.0);
      EXPECT_LT(difference.largest, one.bound * difference.strongest) << one.points << " " << one.noise;
    }
  }
}

TEST_F(LocalSceneProviderTest, AHandThatIsFasterThanTheScenesLosesNoContact)
{
  worker_.setCloud(trial::shapeCloud(Shape::Torus, 100000, 0.0));
  const auto handAt = [](double time)
  {
    // 1 mm deep around the outside of the torus, 0.4 m/s.
    const double angle = 0.4 / 0.034 * time;
    return Vec3{ 0.034 * std::cos(angle), 0.034 * std::sin(angle), 0.0 };
  };
  constexpr int kTicksPerStep = 60;
  constexpr int kTicksOfBuild = 12;
  Scenes scenes = this->request({}, handAt(0.0));
  ASSERT_NE(scenes.whole, nullptr);
  std::vector<std::shared_ptr<const HapticScene>> alive{ scenes.whole };
  Proxy near;
  Proxy whole;
  near.setScene(scenes.whole.get());
  whole.setScene(scenes.whole.get());
  const Vec3 outside{ 0.037, 0.0, 0.0 };
  near.step(outside, kTick);
  whole.step(outside, kTick);
  double time = 0.0;
  double largest = 0.0;
  int outOfReach = 0;
  for (int i = 1; i <= 8; ++i)
  {
    const AffineTransform place = placed(1.5 * i, 1.0 + 0.002 * i, 0.0);
    Status status = Status::Ok;
    alive.push_back(alive.back()->moved(place, status));
    near.setScene(alive.back().get());
    scenes = this->request(place, handAt(time));
    ASSERT_NE(scenes.near, nullptr);
    whole.setScene(scenes.whole.get());
    alive.push_back(scenes.whole);
    for (int tick = 0; tick < kTicksPerStep; ++tick)
    {
      if (tick == kTicksOfBuild)
      {
        alive.push_back(scenes.near);
        near.setScene(alive.back().get());
      }
      time += kTick;
      const Vec3 hand = handAt(time);
      const ProxyState felt = near.step(hand, kTick);
      const ProxyState expected = whole.step(hand, kTick);
      ASSERT_TRUE(expected.contact);
      ASSERT_TRUE(felt.contact) << "step " << i << " tick " << tick;
      largest = std::max(largest, norm(felt.force - expected.force));
      outOfReach += tick >= kTicksOfBuild && !scenes.near->covers(hand);
    }
  }
  EXPECT_GT(outOfReach, 100);
  EXPECT_LT(largest, 0.002); // of 0.8 N
}

TEST_F(LocalSceneProviderTest, AHandThatIsTakenFarAwayFeelsWhatIsThere)
{
  worker_.setCloud(trial::shapeCloud(Shape::Torus, 100000, 0.0));
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  ASSERT_NE(this->request({}, hand).whole, nullptr);
  const Scenes scenes = this->request(placed(4.0, 1.0, 0.0), hand);
  ASSERT_NE(scenes.near, nullptr);
  for (const ProxyMethod method : { ProxyMethod::SurfaceFit, ProxyMethod::GradientSteps })
  {
    HapticParameters parameters;
    parameters.method = method;
    Proxy proxy(parameters);
    proxy.setScene(scenes.near.get());
    proxy.step(hand, kTick);
    ProxyState state;
    // Over the hole, to the other side, and in from there.
    for (const Vec3& target : { Vec3{ 0.036, 0.0, 0.02 }, Vec3{ -0.036, 0.0, 0.02 }, Vec3{ -0.036, 0.0, 0.0 },
           Vec3{ -0.034, 0.0, 0.0 } })
    {
      const Vec3 from = proxy.step(state.hip, kTick).hip;
      for (int i = 1; i <= 400; ++i)
      {
        state = proxy.step(from + (i / 400.0) * (target - from), kTick);
      }
    }
    EXPECT_TRUE(state.contact);
    EXPECT_LT(state.force.x, -0.4);
  }
}

TEST_F(LocalSceneProviderTest, IndexesNoPointsBeforeThereIsASceneToMake)
{
  const vtkSmartPointer<vtkPolyData> cloud = trial::shapeCloud(Shape::Torus, 150000, 0.0);
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  worker_.setCloud(cloud);
  const std::shared_ptr<const HapticScene> whole = this->request({}, hand).whole;
  ASSERT_NE(whole, nullptr);
  const SceneOrigin recipe = SceneRequest::of(resampler_, bandwidth_).recipe;
  Bounds bounds;
  bounds.include(hand);
  LocalSceneProvider builder;
  builder.setCloud(cloud->GetPoints());
  EXPECT_NE(builder.build(recipe, bounds, nullptr), nullptr);
  EXPECT_FALSE(builder.isIndexed()) << "no scene of the whole cloud is there yet";
  EXPECT_NE(builder.build(recipe, bounds, whole), nullptr);
  EXPECT_TRUE(builder.isIndexed());
}

TEST_F(LocalSceneProviderTest, IndexesNoPointsForAHandThatFeelsNothing)
{
  const vtkSmartPointer<vtkPolyData> cloud = trial::shapeCloud(Shape::Idol, 150000, 0.0);
  worker_.setCloud(cloud);
  const Vec3 far{ 0.049, 0.049, 0.049 };
  const std::shared_ptr<const HapticScene> whole = this->request({}, far).whole;
  ASSERT_NE(whole, nullptr);
  Bounds hand;
  hand.include(far);
  LocalSceneProvider builder;
  builder.setCloud(cloud->GetPoints());
  EXPECT_EQ(builder.refine(hand, whole), nullptr);
  EXPECT_FALSE(builder.isIndexed());
  // Somewhere on the idol a finer scene is of use.
  std::shared_ptr<const HapticScene> finer;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints() && !finer; i += 500)
  {
    Vec3 place;
    cloud->GetPoint(i, &place.x);
    hand = Bounds();
    hand.include(place);
    finer = builder.refine(hand, whole);
  }
  EXPECT_NE(finer, nullptr);
  EXPECT_TRUE(builder.isIndexed());
}

TEST_F(LocalSceneProviderTest, IsLeftOutWhereItDoesNotPayOrCannotBe)
{
  worker_.setCloud(trial::shapeCloud(Shape::Torus, 50000, 0.0));
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  ASSERT_NE(this->request({}, hand).whole, nullptr);
  EXPECT_NE(this->request(placed(1.0, 1.0, 0.0), hand).near, nullptr);
  EXPECT_EQ(this->request(placed(2.0, 1.0, 0.0), { 0.0, 0.0, 0.3 }).near, nullptr) << "nothing is near";
  EXPECT_EQ(this->request(placed(2.0, 1.8, 0.0), hand).near, nullptr) << "another size";
  AffineTransform stretched;
  stretched.m[2][2] = 1.2;
  EXPECT_EQ(this->request(stretched, hand).near, nullptr) << "another shape";
  resampler_->SetDimensions(40, 40, 40);
  ASSERT_NE(this->request({}, hand).whole, nullptr);
  EXPECT_EQ(this->request(placed(1.0, 1.0, 0.0), hand).near, nullptr) << "most of the cloud is near";
  worker_.setCloud(trial::shapeCloud(Shape::Sphere, 50000, 0.0));
  const Scenes other = this->request({}, hand);
  EXPECT_TRUE(!other.near || !other.near->fallback()) << "the whole one is of another cloud";
}

TEST_F(LocalSceneProviderTest, BeforeThereIsAWholeCloudWhatIsNearTheHandIsFeltAlone)
{
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  for (const double noise : { 0.0, 4e-5 })
  {
    for (const AffineTransform& place : { AffineTransform(), placed(5.0, 1.1, 0.001) })
    {
      worker_.setCloud(trial::shapeCloud(Shape::Torus, 150000, noise));
      const Vec3 surface = place.apply(closestPoint(Shape::Torus, place.inverse().apply(hand)).point);
      const Scenes scenes = this->request(place, hand, surface);
      ASSERT_TRUE(scenes.near && scenes.whole);
      EXPECT_EQ(scenes.near->fallback(), nullptr);
      EXPECT_LT(scenes.near->numberOfPoints(), scenes.whole->numberOfPoints() / 2);
      EXPECT_EQ(scenes.near->cellSize(), scenes.whole->cellSize());
      const Difference difference = compare(scenes, surface, { 1.0, 0.0, 0.0 });
      EXPECT_GT(difference.touched, 200);
      EXPECT_EQ(difference.left, 0);
      EXPECT_GT(difference.strongest, 1.0);
      EXPECT_LT(difference.largest, (noise > 0.0 ? 5e-3 : 1e-9) * difference.strongest);
    }
  }
}

TEST_F(LocalSceneProviderTest, AWholeCloudTakesOverFromAPartThatWasAloneWithoutAKick)
{
  worker_.setCloud(trial::shapeCloud(Shape::Torus, 150000, 4e-5));
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  const Scenes scenes = this->request({}, hand);
  ASSERT_TRUE(scenes.near && scenes.whole);
  Proxy proxy;
  proxy.setScene(scenes.near.get());
  ProxyState state;
  for (int i = 0; i <= 60; ++i)
  {
    state = proxy.step(hand - Vec3{ 5e-5 * i, 0.0, 0.0 }, kTick);
  }
  ASSERT_TRUE(state.contact);
  const Vec3 before = state.force;
  proxy.setScene(scenes.whole.get());
  state = proxy.step(state.hip, kTick);
  EXPECT_TRUE(state.contact);
  EXPECT_LT(norm(state.force - before), 0.01 * norm(before));
}

TEST_F(LocalSceneProviderTest, AHandThatLeavesAPartThatIsAloneFeelsNothing)
{
  worker_.setCloud(trial::shapeCloud(Shape::Torus, 150000, 0.0));
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  const Scenes scenes = this->request({}, hand);
  ASSERT_TRUE(scenes.near && scenes.whole);
  for (const ProxyMethod method : { ProxyMethod::SurfaceFit, ProxyMethod::GradientSteps })
  {
    HapticParameters parameters;
    parameters.method = method;
    Proxy proxy(parameters);
    proxy.setScene(scenes.near.get());
    // Along the surface, 1 mm deep, 50 mm/s.
    double strongest = 0.0;
    int outside = 0;
    ProxyState state = proxy.step(hand, kTick);
    for (int i = 0; i < 400; ++i)
    {
      const double angle = 0.05 / 0.034 * kTick * i;
      const double radius = std::max(0.034, 0.036 - 5e-5 * i);
      const Vec3 hip{ radius * std::cos(angle), radius * std::sin(angle), 0.0 };
      state = proxy.step(hip, kTick);
      strongest = std::max(strongest, norm(state.force));
      outside += !scenes.near->covers(hip);
      ASSERT_TRUE(outside < 12 || state.force == Vec3()) << "it fades in 10 ms; tick " << i;
    }
    EXPECT_GT(strongest, 0.4);
    EXPECT_GT(outside, 100);
    EXPECT_FALSE(state.contact);
    proxy.setScene(scenes.whole.get());
    for (int i = 0; i < 10; ++i)
    {
      state = proxy.step(state.hip, kTick);
      ASSERT_TRUE(std::isfinite(norm(state.force)));
    }
  }
}

TEST_F(LocalSceneProviderTest, NoPartIsAloneFarFromThePointsOrWhereTheyAreSparse)
{
  worker_.setCloud(trial::shapeCloud(Shape::Torus, 150000, 0.0));
  EXPECT_EQ(this->request({}, { 0.0, 0.0, 0.3 }).near, nullptr);
  EXPECT_EQ(this->request({}, { 0.049, 0.049, 0.049 }).near, nullptr);
  worker_.setCloud(trial::shapeCloud(Shape::Torus, 15000, 0.0));
  EXPECT_EQ(this->request({}, { 0.036, 0.0, 0.0 }).near, nullptr);
}

} // namespace
