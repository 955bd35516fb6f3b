// Output port L is the lattice 2^L times as coarse, bit for bit as if the points were resampled into it.
#include "VoxelMeanCases.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{

constexpr int kLevels = 4;
using Dimensions = std::array<int, 3>;

/// Dimensions after @p level halvings, rounded up each time.
Dimensions coarser(Dimensions dimensions, int level)
{
  for (; level > 0; --level)
  {
    for (int& n : dimensions)
    {
      n = (n + 1) / 2;
    }
  }
  return dimensions;
}

/// Points in the unit cube on a grain of 2^-24, with attributes.
vtkSmartPointer<vtkPolyData> scan(int n, std::uint64_t seed, int type = VTK_DOUBLE)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(n, seed, type));
  trial::addScanAttributes(cloud, seed);
  return cloud;
}

/// Each level of @p resampler is what a filter of its own says of that lattice. @p spacing is the finest
/// level's; origin and spacing must be such that the coarse workspace is exact in double.
void expectLevelsAreDirect(vtkVoxelMeanResampler* resampler, vtkPolyData* cloud, Dimensions dimensions,
  const std::array<double, 3>& origin, const std::array<double, 3>& spacing)
{
  resampler->SetInputData(cloud);
  resampler->SetWorkspaceBounds(origin[0], origin[0] + dimensions[0] * spacing[0], origin[1],
    origin[1] + dimensions[1] * spacing[1], origin[2], origin[2] + dimensions[2] * spacing[2]);
  resampler->SetDimensions(dimensions.data());
  resampler->ComputeCovarianceOn();
  resampler->SetNumberOfLevels(kLevels);
  resampler->Update();
  ASSERT_EQ(resampler->GetNumberOfOutputPorts(), kLevels);
  for (int level = 0; level < kLevels; ++level)
  {
    SCOPED_TRACE(testing::Message() << "level " << level);
    const Dimensions n = coarser(dimensions, level);
    const double factor = std::ldexp(1.0, level);
    vtkNew<vtkVoxelMeanResampler> direct;
    direct->SetInputData(cloud);
    direct->SetTransform(resampler->GetTransform());
    direct->SetOutputPointsPrecision(resampler->GetOutputPointsPrecision());
    direct->SetWorkspaceBounds(origin[0], origin[0] + n[0] * factor * spacing[0], origin[1],
      origin[1] + n[1] * factor * spacing[1], origin[2], origin[2] + n[2] * factor * spacing[2]);
    direct->SetDimensions(n.data());
    direct->ComputeCovarianceOn();
    direct->Update();
    vtkPolyData* output = vtkPolyData::SafeDownCast(resampler->GetOutputDataObject(level));
    ASSERT_NE(output, nullptr);
    trial::expectValid(output);
    const pointhaptics::Lattice lattice = trial::latticeOf(resampler, output);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(lattice.dimensions[axis], n[axis]);
      EXPECT_EQ(lattice.spacing[axis], factor * spacing[axis]);
      EXPECT_EQ(lattice.origin[axis], origin[axis]);
    }
    trial::expectSame(output, direct->GetOutput());
  }
}

}

TEST(VoxelMeanLevels, OneLevelUnlessAskedForMore)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  EXPECT_EQ(resampler->GetNumberOfLevels(), 1);
  EXPECT_EQ(resampler->GetNumberOfOutputPorts(), 1);
}

TEST(VoxelMeanLevels, EqualResamplingThePointsDirectly)
{
  const auto cloud = scan(30000, 61);
  for (const Dimensions& dimensions :
    { Dimensions{ 64, 64, 64 }, Dimensions{ 16, 128, 4 }, Dimensions{ 1, 2, 32 } })
  {
    SCOPED_TRACE(testing::Message() << dimensions[0] << " " << dimensions[1] << " " << dimensions[2]);
    vtkNew<vtkVoxelMeanResampler> resampler;
    expectLevelsAreDirect(resampler, cloud, dimensions, { 0, 0, 0 },
      { 1.0 / dimensions[0], 1.0 / dimensions[1], 1.0 / dimensions[2] });
  }
}

TEST(VoxelMeanLevels, StopAtOneVoxel)
{
  const auto cloud = scan(1000, 68);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
  resampler->SetDimensions(2, 1, 1);
  resampler->SetNumberOfLevels(3);
  resampler->Update();
  EXPECT_EQ(vtkPolyData::SafeDownCast(resampler->GetOutputDataObject(0))->GetNumberOfPoints(), 2);
  vtkPolyData* last = vtkPolyData::SafeDownCast(resampler->GetOutputDataObject(2));
  trial::expectValid(last);
  EXPECT_EQ(last->GetNumberOfPoints(), 1);
  trial::expectSame(vtkPolyData::SafeDownCast(resampler->GetOutputDataObject(1)), last);
}

TEST(VoxelMeanLevels, RoundOddDimensionsUp)
{
  // The points end before the workspace does, so that no coarse voxel reaches further than the fine ones.
  const auto cloud = scan(20000, 62);
  for (const Dimensions& dimensions :
    { Dimensions{ 33, 35, 37 }, Dimensions{ 65, 34, 36 }, Dimensions{ 99, 33, 47 } })
  {
    SCOPED_TRACE(testing::Message() << dimensions[0] << " " << dimensions[1] << " " << dimensions[2]);
    vtkNew<vtkVoxelMeanResampler> resampler;
    expectLevelsAreDirect(resampler, cloud, dimensions, { 0, 0, 0 }, { 1 / 32.0, 1 / 32.0, 1 / 32.0 });
  }
}

TEST(VoxelMeanLevels, DoNotTakeInPointsThatTheFineWorkspaceClips)
{
  // 3 voxels of 0.25: the coarse lattice reaches to 1, its second voxel holds only points below 0.75.
  vtkNew<vtkVoxelMeanResampler> resampler;
  const auto cloud = trial::cloudOf(trial::randomPoints(20000, 63));
  resampler->SetInputData(cloud);
  resampler->SetWorkspaceBounds(0, 0.75, 0, 0.75, 0, 0.75);
  resampler->SetDimensions(3, 3, 3);
  resampler->SetNumberOfLevels(3);
  resampler->Update();
  for (int level = 0; level < 3; ++level)
  {
    vtkPolyData* output = vtkPolyData::SafeDownCast(resampler->GetOutputDataObject(level));
    EXPECT_EQ(trial::sum(trial::countsOf(output)) + resampler->GetNumberOfClippedPoints(), 20000) << level;
    const int n[3] = { 3, 2, 1 };
    EXPECT_EQ(output->GetNumberOfPoints(), n[level] * n[level] * n[level]);
    for (vtkIdType v = 0; v < output->GetNumberOfPoints(); ++v)
    {
      const double* p = output->GetPoint(v);
      EXPECT_LT(*std::max_element(p, p + 3), 0.75);
    }
  }
}

TEST(VoxelMeanLevels, EqualResamplingDirectlyByVoxelSize)
{
  const auto cloud = scan(20000, 67);
  vtkNew<vtkVoxelMeanResampler> resampler;
  vtkNew<vtkVoxelMeanResampler> direct;
  for (vtkVoxelMeanResampler* one : { resampler.Get(), direct.Get() })
  {
    one->SetInputData(cloud);
    one->SetWorkspaceBounds(0.1, 0.95, 0, 0.875, -0.3, 0.7);
    one->ComputeCovarianceOn();
  }
  resampler->SetVoxelSize(0.1); // the workspace ends inside the last voxels
  resampler->SetNumberOfLevels(kLevels);
  resampler->Update();
  EXPECT_GT(resampler->GetNumberOfClippedPoints(), 1000);
  for (int level = 0; level < kLevels; ++level)
  {
    SCOPED_TRACE(testing::Message() << "level " << level);
    direct->SetVoxelSize(std::ldexp(0.1, level));
    direct->Update();
    EXPECT_EQ(direct->GetNumberOfClippedPoints(), resampler->GetNumberOfClippedPoints());
    trial::expectSame(vtkPolyData::SafeDownCast(resampler->GetOutputDataObject(level)), direct->GetOutput());
  }
}

TEST(VoxelMeanLevels, EqualResamplingDirectlyUnderATransform)
{
  vtkNew<vtkTransform> transform;
  transform->RotateWXYZ(30, 1, 2, 3);
  transform->Scale(1, -0.5, 0.7);
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    const auto cloud = scan(30000, 64, type);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetTransform(transform);
    expectLevelsAreDirect(
      resampler, cloud, { 64, 64, 64 }, { -0.5, -1, -0.25 }, { 1 / 32.0, 1 / 32.0, 1 / 64.0 });
    EXPECT_GT(resampler->GetNumberOfClippedPoints(), 100);
  }
}

TEST(VoxelMeanLevels, EqualResamplingDirectlyBelowLatticesOfMoreThan4096VoxelsAnAxis)
{
  const auto cloud = scan(20000, 69);
  vtkNew<vtkVoxelMeanResampler> resampler;
  expectLevelsAreDirect(resampler, cloud, { 12000, 5, 6 }, { 0, 0, 0 }, { 1 / 8192.0, 0.25, 0.25 });
  vtkNew<vtkTransform> transform;
  transform->RotateWXYZ(30, 1, 2, 3);
  transform->Scale(1, -0.5, 0.7);
  for (const int columns : { 1 << 14, 1 << 21 })
  {
    vtkNew<vtkVoxelMeanResampler> turned;
    turned->SetTransform(transform);
    expectLevelsAreDirect(
      turned, cloud, { columns, 64, 64 }, { -0.5, -1, -0.25 }, { 2.0 / columns, 1 / 32.0, 1 / 64.0 });
    EXPECT_GT(turned->GetNumberOfClippedPoints(), 100);
  }
}

TEST(VoxelMeanLevels, FollowTheirNumber)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(1000, 65)));
  trial::useUnitCube(resampler, 16);
  for (const int levels : { 3, 1, 2, 6 })
  {
    resampler->SetNumberOfLevels(levels);
    resampler->Update();
    ASSERT_EQ(resampler->GetNumberOfOutputPorts(), levels);
    for (int level = 0; level < levels; ++level)
    {
      vtkPolyData* output = vtkPolyData::SafeDownCast(resampler->GetOutputDataObject(level));
      ASSERT_NE(output, nullptr);
      EXPECT_EQ(trial::sum(trial::countsOf(output)), 1000);
      EXPECT_LE(output->GetNumberOfPoints(), 4096 >> (3 * std::min(level, 4)));
    }
  }
}

TEST(VoxelMeanLevels, AreEmptyTogether)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(100, 66)));
  resampler->SetNumberOfLevels(3);
  resampler->Update();
  resampler->SetDimensions(0, 1, 1);
  trial::expectError(resampler, "must be between 1 and 2097152");
  for (int level = 0; level < 3; ++level)
  {
    vtkPolyData* output = vtkPolyData::SafeDownCast(resampler->GetOutputDataObject(level));
    ASSERT_NE(output, nullptr);
    EXPECT_EQ(output->GetNumberOfPoints(), 0) << level;
    trial::expectValid(output);
  }
}
