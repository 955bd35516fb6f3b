// What is felt near the hand while the model moves, against scenes of the whole cloud.
#include "SceneWorker.h"

#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Shapes.h"
#include "Haptics/Proxy.h"

#include <gtest/gtest.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <mutex>
#include <vector>

using namespace pointhaptics;

namespace
{

constexpr double kTick = 0.001;

vtkSmartPointer<vtkPolyData> makeCloud(Shape shape, std::int64_t size, double noise)
{
  std::vector<Vec3> drawn;
  EXPECT_EQ(generateShape(shape, size, 1, noise, drawn), Status::Ok);
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(vtkIdType(drawn.size()));
  for (std::size_t i = 0; i < drawn.size(); ++i)
  {
    points->SetPoint(vtkIdType(i), &drawn[i].x);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

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

class NearSceneTest : public ::testing::Test
{
protected:
  NearSceneTest()
  {
    resampler_->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    resampler_->SetDimensions(300, 300, 300);
    resampler_->ComputeCovarianceOn();
    bandwidth_->ComputeDensityOff();
  }

  Scenes request(const AffineTransform& place, const Vec3& hand, const Vec3& contact)
  {
    SceneRequest request = SceneRequest::of(resampler_, bandwidth_);
    for (int i = 0; i < 12; ++i)
    {
      request.modelToWorkspace[std::size_t(i)] = place.m[i / 4][i % 4];
    }
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
      (scene && scene->beyond() ? scenes.near : scenes.whole) = std::move(scene);
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

/// A hand that goes into the outside of the torus near @p at, and about there; the states of all its ticks.
std::vector<ProxyState> feel(const HapticScene& scene, const Vec3& at, const Vec3& outward)
{
  Proxy proxy;
  proxy.setScene(&scene);
  std::vector<ProxyState> states;
  for (int i = 0; i < 1000; ++i)
  {
    const double t = 0.001 * i;
    const double depth = 0.004 * std::sin(6.0 * t) - 0.0015;
    const Vec3 hip = at - depth * outward + Vec3{ 0.0, 0.003 * std::sin(17.0 * t), 0.004 * std::sin(11.0 * t) };
    states.push_back(proxy.step(hip, kTick));
  }
  return states;
}

TEST_F(NearSceneTest, WithinReachItIsFeltAsTheWholeCloudBitForBit)
{
  worker_.setCloud(makeCloud(Shape::Torus, 400000, 0.0));
  const Vec3 hand{ 0.036, 0.0, 0.0 };
  ASSERT_NE(this->request(placed(0.0, 1.0, 0.0), hand).whole, nullptr);
  for (const AffineTransform& place : { placed(5.0, 1.0, 0.0), placed(5.0, 1.0, 0.002), placed(-3.0, 1.1, -0.003) })
  {
    const Vec3 surface = place.apply(closestPoint(Shape::Torus, place.inverse().apply(hand)).point);
    const Scenes scenes = this->request(place, hand, surface);
    ASSERT_NE(scenes.near, nullptr);
    ASSERT_NE(scenes.whole, nullptr);
    EXPECT_LT(scenes.near->numberOfPoints(), scenes.whole->numberOfPoints() / 2);
    ASSERT_EQ(scenes.near->cellSize(), scenes.whole->cellSize());
    const std::vector<ProxyState> near = feel(*scenes.near, surface, { 1.0, 0.0, 0.0 });
    const std::vector<ProxyState> whole = feel(*scenes.whole, surface, { 1.0, 0.0, 0.0 });
    int touched = 0;
    int left = 0;
    int differ = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < near.size(); ++i)
    {
      touched += whole[i].contact;
      left += !scenes.near->covers(near[i].hip) || !scenes.near->covers(near[i].proxy);
      differ += !(near[i].force.x == whole[i].force.x && near[i].force.y == whole[i].force.y &&
        near[i].force.z == whole[i].force.z && near[i].proxy.x == whole[i].proxy.x);
      most = std::max(most, norm(near[i].force - whole[i].force));
    }
    std::printf("share? %zu of %zu cells; touched %d left %d differ %d most %g\n", scenes.near->numberOfPoints(), scenes.whole->numberOfPoints(), touched, left, differ, most);
    EXPECT_GT(touched, 300);
    EXPECT_EQ(left, 0);
    EXPECT_EQ(differ, 0);
  }
}

} // namespace
