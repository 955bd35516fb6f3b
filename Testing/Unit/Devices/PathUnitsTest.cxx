// Units that sizes and times of a path suggest; and a device that declares its force by its capabilities
// alone.
#include "Devices/PathUnits.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace pointhaptics;

namespace
{

const UnitNames kOptions{ "--unit", "--path-unit", "--path-time-unit" };

/// To and fro over @p size, @p rows of them @p step apart.
HipPath swing(double size, int rows, double step)
{
  HipPath path;
  for (int i = 0; i < rows; ++i)
  {
    path.points.push_back({ step * i, { 0.5 * size * std::sin(0.01 * i), 0.0, 0.0 } });
  }
  return path;
}

Bounds cube(double edge)
{
  Bounds box;
  box.include({ -0.5 * edge, -0.5 * edge, -0.5 * edge });
  box.include({ 0.5 * edge, 0.5 * edge, 0.5 * edge });
  return box;
}

TEST(PathUnits, ThatAreWrongAreSaidWithTheCure)
{
  struct Case
  {
    HipPath path;
    Bounds cloud;
    std::string cure;
  };
  for (const Case& each : { Case{ swing(60.0, 1000, 0.01), cube(0.05), "--path-unit mm" },
         Case{ swing(60.0, 1000, 0.01), cube(50.0), "--unit mm --path-unit mm" },
         Case{ swing(60.0, 1000, 0.01), Bounds(), "--path-unit mm" },
         Case{ swing(6.0, 1000, 0.01), cube(0.05), "--path-unit cm" },
         Case{ swing(6.0, 1000, 0.01), cube(0.05), "give --path-unit mm if it is in mm, or give" },
         Case{ swing(10.0, 1000, 0.01), cube(8.0), "or give --unit cm --path-unit cm if both are in cm" },
         Case{ swing(0.06, 1000, 1.0), cube(0.05), "--path-time-unit ms" },
         Case{ swing(0.06, 100, 1e4), cube(0.05), "--path-time-unit us" },
         Case{ swing(0.5, 3, 1e3), cube(0.05), "--path-time-unit ms" } })
  {
    const std::string said = unlikelyUnits(each.path, each.cloud, kOptions);
    EXPECT_NE(said.find(each.cure), std::string::npos) << each.cure << ": " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
  const HipPath beside = swing(0.06, 1000, 0.01);
  EXPECT_NE(unlikelyUnits(beside, cube(50.0), kOptions, false).find("give --unit mm"), std::string::npos);
  EXPECT_EQ(unlikelyUnits(beside, cube(50.0), kOptions, true), "");
  EXPECT_EQ(unlikelyUnits(beside, cube(0.05), kOptions, false), "");
  EXPECT_EQ(unlikelyUnits(HipPath(), Bounds(), kOptions, false), "");
}

/// A press is shorter than what it presses: places tell, as a unit scales about the origin.
TEST(PathUnits, OfAPressBesideTheCloudAreToldByPlaces)
{
  const auto press = [](double factor)
  {
    HipPath path;
    path.points = { { 0.0, { 0.0, 0.0, 0.030 * factor } }, { 0.4, { 0.0, 0.0, 0.0285 * factor } } };
    return path;
  };
  const auto said = [](const HipPath& path, const Bounds& cloud)
  { return unlikelyUnits(path, cloud, kOptions, false); };
  EXPECT_NE(said(press(1.0), cube(50.0)).find("give --unit mm if the cloud is in mm"), std::string::npos);
  EXPECT_NE(said(press(1.0), cube(600.0)).find("give --unit mm if the cloud is in mm"), std::string::npos)
    << "a statue of 60 cm";
  EXPECT_NE(said(press(1.0), cube(5.0)).find("give --unit cm if the cloud is in cm"), std::string::npos);
  EXPECT_NE(said(press(1e3), cube(0.05)).find("give --path-unit mm if it is in mm"), std::string::npos);
  EXPECT_EQ(said(press(1.0), cube(0.05)), "");
  EXPECT_NE(said(press(1e4), cube(500.0)).find("--unit mm --path-unit mm"), std::string::npos);
  HipPath far = press(1.0);
  Bounds site;
  for (HipPathPoint& point : far.points)
  {
    point.position = point.position + Vec3{ 5e5, 5e6, 100.0 };
    site.include(point.position + Vec3{ 10.0, 10.0, 10.0 });
  }
  EXPECT_EQ(said(far, site), "") << "a site far from the origin";
}

/// VTK and Python have no options for units.
TEST(PathUnits, AreCuredByAFactorWhereThereAreNoOptions)
{
  EXPECT_NE(
    unlikelyUnits(swing(60.0, 1000, 0.01), cube(0.05)).find("multiply the places of the path by 0.001 if"),
    std::string::npos);
  EXPECT_NE(unlikelyUnits(swing(60.0, 1000, 0.01), cube(50.0))
              .find("multiply the points and the places of the path by 0.001 if both are in mm"),
    std::string::npos);
  EXPECT_NE(unlikelyUnits(swing(0.06, 1000, 1.0), cube(0.05)).find("multiply its times by 0.001 if"),
    std::string::npos);
  EXPECT_NE(
    unlikelyUnits(swing(0.06, 1000, 0.01), cube(50.0), {}, false).find("multiply the points by 0.001 if"),
    std::string::npos);
}

TEST(PathUnits, OfAnyHandAreNotDoubted)
{
  for (const double size : { 1e-4, 0.01, 0.1, 0.5 })
  {
    for (const double step : { 1e-4, 1e-3, 0.02 })
    {
      for (const Bounds& cloud : { Bounds(), cube(0.05), cube(0.3), cube(20.0), cube(1000.0) })
      {
        EXPECT_EQ(unlikelyUnits(swing(size, 200, step), cloud), "") << size << " " << step;
      }
    }
  }
  HipPath rest;
  rest.points = { { 0.0, { 0.0, 0.0, 0.01 } }, { 3600.0, { 0.0, 0.0, 0.01 } } };
  EXPECT_EQ(unlikelyUnits(rest, cube(0.05)), "") << "a hand that rests";
  rest.points.back().position.z = 0.02;
  EXPECT_EQ(unlikelyUnits(rest, cube(0.05)), "") << "a line that somebody drew";
  EXPECT_EQ(unlikelyUnits(HipPath(), Bounds()), "");
}

TEST(PathUnits, MakeMetresAndSeconds)
{
  HipPath path = swing(60.0, 10, 5.0); // 45 s
  applyUnits({ 1e-3, 1e-3 }, path);
  EXPECT_EQ(unlikelyUnits(path, cube(0.05)), "");
  EXPECT_DOUBLE_EQ(path.points.back().timeSeconds, 0.045);
  EXPECT_DOUBLE_EQ(path.points.back().position.x, 0.03 * std::sin(0.09));
}

/// Declares a force by its capabilities alone.
class WeakDevice : public SimulatedDevice
{
public:
  DeviceCapabilities capabilities() const noexcept override
  {
    DeviceCapabilities result = SimulatedDevice::capabilities();
    result.maximumForce = 2.0;
    return result;
  }
};

TEST(DeviceForce, IsTheOneOfTheCapabilities)
{
  const SimulatedDevice simulated;
  const FalconDevice falcon{ FalconSettings() };
  EXPECT_EQ(simulated.maximumForce(), simulated.capabilities().maximumForce);
  EXPECT_EQ(falcon.maximumForce(), 4.0);
  WeakDevice weak;
  ASSERT_EQ(weak.open(), Status::Ok);
  ServoSettings settings;
  settings.realtimePriority = false;
  settings.limits.maximumForce = 1e9;
  ServoLoop loop;
  ASSERT_EQ(loop.start(weak, HapticParameters(), settings), Status::Ok);
  EXPECT_EQ(loop.forceLimit().text(), "2 N (device)");
  loop.stop();
}

TEST(PathUnits, OfACloudAtMapCoordinatesAreNotDoubtedByPlaces)
{
  HipPath path;
  path.points = { { 0.0, { 0.0, 0.0, 0.03 } }, { 0.4, { 0.0, 0.0, 0.0285 } } };
  Bounds site;
  site.include({ 6e5, 2e5, 500.0 });
  site.include({ 6.001e5, 2.001e5, 520.0 });
  EXPECT_EQ(unlikelyUnits(path, site, kOptions, false), "");
}

TEST(PathUnits, OfACloudWhoseUnitIsKnownAreNotDoubted)
{
  EXPECT_NE(unlikelyUnits(swing(0.06, 1000, 0.01), cube(50.0), kOptions, false), "");
  EXPECT_EQ(unlikelyUnits(swing(0.06, 1000, 0.01), cube(50.0), kOptions, false, true), "");
  EXPECT_NE(unlikelyUnits(swing(60.0, 1000, 0.01), cube(50.0), kOptions), "");
  EXPECT_EQ(unlikelyUnits(swing(60.0, 1000, 0.01), cube(50.0), kOptions, true, true), "");
  EXPECT_NE(unlikelyUnits(swing(60.0, 1000, 0.01), cube(0.05), kOptions, true, true), "") << "the path is";
}

} // namespace
