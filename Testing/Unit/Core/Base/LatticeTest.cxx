#include "Core/Base/Lattice.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>

using namespace pointhaptics;

namespace
{

Bounds boxOf(const Vec3& low, const Vec3& high)
{
  Bounds box;
  box.include(low);
  box.include(high);
  return box;
}

bool holds(const Lattice& lattice, const Vec3& p)
{
  return lattice.contains(lattice.continuousIndex(p));
}

/// An automatic workspace about the box must make a valid lattice that clips no corner.
void expectHolds(const Vec3& low, const Vec3& high, const LatticeSettings& settings = {})
{
  Lattice lattice;
  ASSERT_EQ(makeLattice(settings, boxOf(low, high), lattice), Status::Ok) << low.x << ' ' << high.x;
  ASSERT_EQ(lattice.check(), Status::Ok);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 p(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z);
    EXPECT_TRUE(holds(lattice, p)) << "corner " << corner << " of " << low.x << " to " << high.x;
  }
}

} // namespace

TEST(Lattice, VoxelsAreHalfOpen)
{
  Lattice lattice;
  lattice.origin = { -1, -1, -1 };
  lattice.spacing = { 0.5, 0.5, 0.5 };
  lattice.dimensions = { 4, 4, 4 };
  EXPECT_TRUE(holds(lattice, { -1, -1, -1 }));
  EXPECT_FALSE(holds(lattice, { 1, 0, 0 }));
  EXPECT_FALSE(holds(lattice, { 0, 1, 0 }));
  EXPECT_FALSE(holds(lattice, { 0, 0, 1 }));
  EXPECT_TRUE(holds(lattice, { 1.0 - 0x1p-51, 0, 0 }));
  EXPECT_FALSE(holds(lattice, { -1.0 - 0x1p-51, 0, 0 }));
  EXPECT_EQ(std::floor(lattice.continuousIndex({ -0.5, 0, 0 }).x), 1.0)
    << "a face belongs to the voxel above";
  EXPECT_EQ(std::floor(lattice.continuousIndex({ -0.75, 0, 0 }).x), 0.0);
}

TEST(Lattice, HoldsNoPointThatIsNotFinite)
{
  const Lattice lattice;
  EXPECT_FALSE(holds(lattice, { NAN, 0.5, 0.5 }));
  EXPECT_FALSE(holds(lattice, { 0.5, INFINITY, 0.5 }));
  EXPECT_FALSE(holds(lattice, { 0.5, 0.5, -INFINITY }));
}

TEST(Lattice, KeyIsLinearWithXFastestAndInverts)
{
  Lattice lattice;
  lattice.dimensions = { 3, 5, 7 };
  std::uint64_t expected = 0;
  for (std::int64_t k = 0; k < 7; ++k)
  {
    for (std::int64_t j = 0; j < 5; ++j)
    {
      for (std::int64_t i = 0; i < 3; ++i)
      {
        EXPECT_EQ(lattice.key(i, j, k), expected);
        EXPECT_EQ(lattice.indexOf(expected), (std::array<std::int64_t, 3>{ i, j, k }));
        ++expected;
      }
    }
  }
}

TEST(Lattice, KeysOfTheLargestLatticeDoNotOverlap)
{
  Lattice lattice;
  lattice.dimensions = { kMaximumLatticeDimension, kMaximumLatticeDimension, kMaximumLatticeDimension };
  EXPECT_EQ(lattice.check(), Status::Ok);
  const std::int64_t last = kMaximumLatticeDimension - 1;
  EXPECT_EQ(
    lattice.indexOf(lattice.key(last, last, last)), (std::array<std::int64_t, 3>{ last, last, last }));
  EXPECT_EQ(lattice.key(last, last, last), (std::uint64_t(1) << 63) - 1);
}

TEST(Lattice, CheckFindsEveryMistake)
{
  const auto broken = [](auto change)
  {
    Lattice lattice;
    change(lattice);
    return lattice.check();
  };
  EXPECT_EQ(broken([](Lattice&) {}), Status::Ok);
  EXPECT_EQ(broken([](Lattice& l) { l.origin.y = NAN; }), Status::InvalidWorkspace);
  EXPECT_EQ(broken([](Lattice& l) { l.origin.z = INFINITY; }), Status::InvalidWorkspace);
  EXPECT_EQ(broken([](Lattice& l) { l.spacing.x = 0; }), Status::InvalidVoxelSize);
  EXPECT_EQ(broken([](Lattice& l) { l.spacing.y = -1; }), Status::InvalidVoxelSize);
  EXPECT_EQ(broken([](Lattice& l) { l.spacing.z = NAN; }), Status::InvalidVoxelSize);
  EXPECT_EQ(broken([](Lattice& l) { l.dimensions[0] = 0; }), Status::InvalidDimensions);
  EXPECT_EQ(broken([](Lattice& l) { l.dimensions[1] = -3; }), Status::InvalidDimensions);
  EXPECT_EQ(
    broken([](Lattice& l) { l.dimensions[2] = kMaximumLatticeDimension + 1; }), Status::InvalidDimensions);
}

TEST(MakeLattice, DividesAGivenWorkspace)
{
  const struct
  {
    Bounds workspace;
    std::array<std::int64_t, 3> dimensions;
    double voxelSize;
    std::array<std::int64_t, 3> expected;
    Vec3 spacing;
  } cases[] = {
    // The paper's cube.
    { boxOf({ -0.05, -0.05, -0.05 }, { 0.05, 0.05, 0.05 }), LatticeSettings().dimensions, 0.0,
      { 300, 300, 300 }, Vec3(1, 1, 1) * (0.1 / 300) },
    { boxOf({ 0, 0, 0 }, { 1, 2, 4 }), { 10, 5, 8 }, 0.0, { 10, 5, 8 }, { 0.1, 0.4, 0.5 } },
    // VTK 9.1's vtkVoxelGrid makes 27 voxels of this; the answer is 64.
    { boxOf({ 0, 0, 0 }, { 1, 1, 1 }), { 300, 300, 300 }, 0.3, { 4, 4, 4 }, { 0.3, 0.3, 0.3 } },
  };
  for (const auto& of : cases)
  {
    Lattice lattice;
    ASSERT_EQ(makeLattice({ of.dimensions, of.voxelSize, false, of.workspace }, {}, lattice), Status::Ok);
    EXPECT_EQ(lattice.dimensions, of.expected);
    EXPECT_LE(norm(lattice.spacing - of.spacing), 1e-15);
    EXPECT_EQ(lattice.origin, of.workspace.minimum);
  }
}

TEST(MakeLattice, VoxelLargerThanTheCloudGivesOneOrFewVoxels)
{
  LatticeSettings settings;
  settings.voxelSize = 100;
  expectHolds({ 0, 0, 0 }, { 1, 2, 3 }, settings);
  Lattice lattice;
  ASSERT_EQ(makeLattice(settings, boxOf({ 0, 0, 0 }, { 1, 2, 3 }), lattice), Status::Ok);
  EXPECT_LE(lattice.dimensions[0], 2);
}

TEST(MakeLattice, AutomaticWorkspaceIsACubeAboutTheCloudHalfAVoxelWider)
{
  Lattice lattice;
  ASSERT_EQ(makeLattice({}, boxOf({ -1, 2, 3 }, { 1, 2.5, 3.25 }), lattice), Status::Ok);
  EXPECT_DOUBLE_EQ(lattice.spacing.x, lattice.spacing.y);
  EXPECT_DOUBLE_EQ(lattice.spacing.x, lattice.spacing.z);
  const Bounds box = lattice.bounds();
  EXPECT_LE(norm(box.center() - Vec3(0, 2.25, 3.125)), 1e-12);
  EXPECT_NEAR(box.extent().x, 2.0 + lattice.spacing.x, 1e-12) << "half a voxel on each side";
}

TEST(MakeLattice, AutomaticWorkspaceOfFewLayersIsNoWiderForThat)
{
  LatticeSettings settings;
  settings.dimensions = { 300, 300, 1 };
  Lattice lattice;
  ASSERT_EQ(makeLattice(settings, boxOf({ 0, 0, 0 }, { 1, 1, 1 }), lattice), Status::Ok);
  EXPECT_NEAR(lattice.spacing.x, 1.0 / 299, 1e-12);
  expectHolds({ 0, 0, 0 }, { 1, 1, 1 }, settings);
}

TEST(MakeLattice, AutomaticWorkspaceClipsNothingAtAnyScale)
{
  trial::Random random(21);
  for (int i = 0; i < 2000; ++i)
  {
    const double scale = std::pow(10.0, random.uniform(-12, 12));
    const double offset = i % 2 ? 0.0 : random.uniform(-1000, 1000);
    const Vec3 low = scale * (random.inBox({ -1, -1, -1 }, { 1, 1, 1 }) + Vec3(offset, -offset, offset));
    const Vec3 high = low + scale * random.inBox({ 0, 0, 0 }, { 1, 1, 1 });
    LatticeSettings settings;
    if (i % 3 == 0)
    {
      settings.dimensions = { 1 + std::int64_t(random.below(1000)), 1 + std::int64_t(random.below(1000)), 1 };
    }
    else if (i % 3 == 1)
    {
      settings.voxelSize = scale * random.uniform(0.01, 0.5);
    }
    expectHolds(low, high, settings);
  }
}

TEST(MakeLattice, HoldsCloudsOfEveryShapeAndSize)
{
  const Vec3 map{ 512700.123, 5403547.25, 301.5 };
  const struct
  {
    Vec3 low;
    Vec3 high;
    double voxelSize;
  } cases[] = { { map, map + Vec3(90, 53, 48), 0.0 }, { map, map + Vec3(90, 53, 48), 0.1 },
    { { 0, 0, 0 }, { 1, 0, 0 }, 0.0 }, { { 0, -1, 5 }, { 1, 1, 5 }, 0.0 },
    { { 0, 0, 0 }, { 1, 1e-300, 0 }, 0.0 }, { { 1e12, 1e12, 1e12 }, { 1e12 + 1e-3, 1e12, 1e12 }, 0.0 },
    { { 0.3, -0.2, 1 }, { 0.3, -0.2, 1 }, 1e-9 } };
  for (const auto& of : cases)
  {
    expectHolds(of.low, of.high, { LatticeSettings().dimensions, of.voxelSize, true, {} });
  }
  for (const double extent : { 5e-323, 1e-320, 1e-310, 3e-308, 1e-299, 1e-289 })
  {
    expectHolds({ 0, 0, 0 }, { extent, 0, extent }, { { 10, 10, 10 }, 0.0, true, {} });
    expectHolds({ -extent, -extent, 0 }, { extent, 0, extent }, { { 10, 10, 10 }, 0.0, true, {} });
  }
  for (const double size : { 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e9 })
  {
    expectHolds({ 0, 0, 0 }, { 0, 0, 0 }, { LatticeSettings().dimensions, size, true, {} });
    expectHolds({ 1e-6, 0, 0 }, { 1e-6, 0, 0 }, { LatticeSettings().dimensions, size, true, {} });
  }
}

TEST(MakeLattice, CloudsWithoutExtentGetTheDefaultWorkspace)
{
  for (const Vec3& p : { Vec3(0, 0, 0), Vec3(0.3, -0.2, 7), Vec3(-1e-9, 0, 0) })
  {
    Lattice lattice;
    ASSERT_EQ(makeLattice({}, boxOf(p, p), lattice), Status::Ok);
    EXPECT_TRUE(holds(lattice, p));
    EXPECT_NEAR(lattice.bounds().extent().x, kDefaultWorkspaceEdge, 1e-2 * kDefaultWorkspaceEdge);
  }
  for (const Vec3& p : { Vec3(5e6, 0, 0), Vec3(1e12, -1e12, 3), Vec3(1e-300, 0, 0), Vec3(1e15, 1e15, 1e15) })
  {
    expectHolds(p, p);
  }
}

TEST(MakeLattice, EmptyCloudGivesAValidLattice)
{
  Lattice lattice;
  ASSERT_EQ(makeLattice({}, {}, lattice), Status::Ok);
  EXPECT_EQ(lattice.check(), Status::Ok);
  EXPECT_NEAR(lattice.bounds().extent().x, kDefaultWorkspaceEdge, 1e-2 * kDefaultWorkspaceEdge);
}

TEST(MakeLattice, BoxesNearTheLargestNumberGiveALatticeOrAnError)
{
  const double huge = DBL_MAX;
  for (const Bounds& box :
    { boxOf({ -huge, -huge, -huge }, { huge, huge, huge }), boxOf({ huge, 0, 0 }, { huge, 1, 1 }),
      boxOf({ -huge, 0, 0 }, { huge, 1, 1 }), boxOf({ 0, 0, 0 }, { huge / 4, 1, 1 }) })
  {
    Lattice lattice;
    const Status status = makeLattice({}, box, lattice);
    if (status == Status::Ok)
    {
      EXPECT_EQ(lattice.check(), Status::Ok);
      EXPECT_TRUE(isFinite(lattice.bounds().minimum) && isFinite(lattice.bounds().maximum));
      EXPECT_TRUE(holds(lattice, box.minimum));
      EXPECT_TRUE(holds(lattice, box.maximum));
    }
    else
    {
      EXPECT_EQ(lattice.origin, Vec3()) << "an error leaves the lattice unchanged";
    }
  }
}

TEST(MakeLattice, RefusesWhatAKeyCannotHold)
{
  LatticeSettings settings;
  settings.voxelSize = 1e-9;
  Lattice lattice;
  lattice.origin = { 7, 8, 9 };
  EXPECT_EQ(makeLattice(settings, boxOf({ 0, 0, 0 }, { 1, 1, 1 }), lattice), Status::LatticeNotAddressable);
  EXPECT_EQ(lattice.origin, Vec3(7, 8, 9)) << "an error leaves the lattice unchanged";
  settings.voxelSize = DBL_TRUE_MIN;
  EXPECT_EQ(makeLattice(settings, boxOf({ 0, 0, 0 }, { 1, 1, 1 }), lattice), Status::LatticeNotAddressable);
}

TEST(MakeLattice, RefusesNonsense)
{
  const auto made = [](auto change)
  {
    LatticeSettings settings;
    settings.automaticWorkspace = false;
    settings.workspace = boxOf({ 0, 0, 0 }, { 1, 1, 1 });
    change(settings);
    Lattice lattice;
    lattice.origin = { 7, 8, 9 };
    const Status status = makeLattice(settings, boxOf({ 0, 0, 0 }, { 1, 1, 1 }), lattice);
    if (status != Status::Ok)
    {
      EXPECT_EQ(lattice.origin, Vec3(7, 8, 9));
    }
    return status;
  };
  EXPECT_EQ(made([](LatticeSettings&) {}), Status::Ok);
  EXPECT_EQ(made([](LatticeSettings& s) { s.dimensions[1] = 0; }), Status::InvalidDimensions);
  EXPECT_EQ(made([](LatticeSettings& s) { s.dimensions[2] = -1; }), Status::InvalidDimensions);
  EXPECT_EQ(made([](LatticeSettings& s) { s.dimensions[0] = kMaximumLatticeDimension + 1; }),
    Status::InvalidDimensions);
  EXPECT_EQ(made([](LatticeSettings& s) { s.voxelSize = -1; }), Status::InvalidVoxelSize);
  EXPECT_EQ(made([](LatticeSettings& s) { s.voxelSize = NAN; }), Status::InvalidVoxelSize);
  EXPECT_EQ(made([](LatticeSettings& s) { s.voxelSize = INFINITY; }), Status::InvalidVoxelSize);
  EXPECT_EQ(made([](LatticeSettings& s) { s.workspace = Bounds(); }), Status::InvalidWorkspace);
  EXPECT_EQ(made([](LatticeSettings& s) { s.workspace.maximum.z = 0; }), Status::InvalidWorkspace);
  EXPECT_EQ(made([](LatticeSettings& s) { s.workspace.maximum.x = NAN; }), Status::InvalidWorkspace);
  EXPECT_EQ(made([](LatticeSettings& s) { s.workspace.minimum.x = -INFINITY; }), Status::InvalidWorkspace);
}
