// Extreme lattices and transforms: the right answer, or an error that names the cure.
#include "VoxelMeanFixtures.h"

#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkPerspectiveTransform.h"
#include "vtkThinPlateSplineTransform.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

/// A transform whose linear part is scaled and turned by @p linear (row by row), shifted to the unit cube's
/// centre.
vtkSmartPointer<vtkTransform> transformBy(const std::vector<double>& linear, double shift = 0.5)
{
  const double rows[16] = { linear[0], linear[1], linear[2], shift, linear[3], linear[4], linear[5], shift,
    linear[6], linear[7], linear[8], shift, 0, 0, 0, 1 };
  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->SetMatrix(rows);
  return transform;
}

}

TEST(VoxelMeanLattice, AVoxelLargerThanTheCloudGivesOneMean)
{
  const auto cloud = trial::cloudBy(1000, [](int i) { return pointhaptics::Vec3(i, -i, 2 * i) * 1e-6; });
  for (const double size : { 1.0, 1e6, 1e150 })
  {
    SCOPED_TRACE(size);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetVoxelSize(size);
    trial::expectRight(resampler, cloud);
    EXPECT_LE(resampler->GetOutput()->GetNumberOfPoints(), 8);
    EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
  }
}

TEST(VoxelMeanLattice, VoxelsTooSmallForTheKeysAreAnError)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(100, 15)));
  for (const double size : { 1e-30, 5e-324, 1e-12 })
  {
    SCOPED_TRACE(size);
    resampler->SetVoxelSize(size);
    trial::expectError(resampler, "use a larger voxel size");
  }
  resampler->SetDimensions(std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 2000000000);
  trial::expectError(resampler, "must be between 1 and 2097152");
  resampler->SetDimensions(300, 0, 300);
  trial::expectError(resampler, "must be between 1 and 2097152");
  resampler->SetDimensions(30, 30, 30);
  resampler->Update();
  EXPECT_EQ(trial::sum(trial::countsOf(resampler->GetOutput())), 100) << "it recovers";
}

TEST(VoxelMeanLattice, LargeLatticesWorkAtTheCostOfTheirActiveVoxels)
{
  const int dimensions[6][3] = { { 4096, 4096, 4096 }, { 1 << 21, 1 << 21, 1 << 21 }, { 100000, 3, 7 },
    { 3, 100000, 7 }, { 7, 3, 100000 }, { 1, 1, 1 << 21 } };
  const auto cloud = trial::cloudOf(trial::randomPoints(20000, 18));
  for (const auto& n : dimensions)
  {
    SCOPED_TRACE(testing::Message() << n[0] << " " << n[1] << " " << n[2]);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
    resampler->SetDimensions(n[0], n[1], n[2]);
    trial::expectRight(resampler, cloud);
  }
}

TEST(VoxelMeanLattice, AWorkspaceOfPartVoxelsClipsAtItsEnd)
{
  const auto cloud = trial::cloudAt(
    { { 0.95, 0.5, 0.5 }, { 1, 0.5, 0.5 }, { 1.1, 0.5, 0.5 }, { 0.5, 0.5, 0.99 }, { 0, 0, 0 } });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
  resampler->SetVoxelSize(0.3);
  trial::expectRight(resampler, cloud);
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 2);
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 3);
}

TEST(VoxelMeanLattice, AWorkspaceBesideTheCloudClipsEveryPoint)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetWorkspaceBounds(10, 11, 10, 11, 10, 11);
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 3));
  trial::addArray(cloud, "Heat", std::vector<double>(1000, 1.0));
  trial::expectRight(resampler, cloud);
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 1000);
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfCells(), 0);
}

TEST(VoxelMeanLattice, BoundsWithoutVolumeAreAnError)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(10, 3)));
  const double bounds[5][6] = { { 0, 0, 0, 1, 0, 1 }, { 0, 1, 1, 0, 0, 1 }, { 0, 1, 0, 1, trial::kNan, 1 },
    { -trial::kInfinity, 1, 0, 1, 0, 1 }, { -1.7e308, 1.7e308, 0, 1, 0, 1 } };
  for (const double* box : bounds)
  {
    resampler->SetWorkspaceBounds(box);
    trial::expectError(resampler, "must be finite with maximum above minimum");
  }
  for (const double size : { trial::kNan, trial::kInfinity, -0.1 })
  {
    resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
    resampler->SetVoxelSize(size);
    trial::expectError(resampler, "voxel size must be finite and above 0");
  }
}

TEST(VoxelMeanTransforms, AreDividedByTheirLastElement)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 16));
  vtkNew<vtkMatrix4x4> matrix;
  for (int i = 0; i < 16; ++i)
  {
    matrix->SetElement(i / 4, i % 4, i % 5 == 0 ? -4.0 : 0.0);
  }
  vtkNew<vtkMatrixToLinearTransform> same;
  same->SetInput(matrix);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 9);
  resampler->Update();
  const auto expected = trial::copyOf(resampler->GetOutput());
  resampler->SetTransform(same);
  resampler->Update();
  trial::expectSame(resampler->GetOutput(), expected);
  matrix->SetElement(3, 3, 0.0);
  trial::expectError(resampler, "last row 0, 0, 0, 1");
}

TEST(VoxelMeanTransforms, SingularAndNonFiniteOnesAreErrors)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(100, 15)));
  trial::useUnitCube(resampler, 4);
  const std::vector<std::vector<double>> linears = {
    { 0, 0, 0, 0, 0, 0, 0, 0, 0 },
    { 1, 0, 0, 0, 1, 0, 0, 0, 0 },
    { 1, 2, 3, 2, 4, 6, 0, 0, 1 },
    { 1, 2, 3, 4, 5, 6, 7, 8, 9 },
    { trial::kNan, 0, 0, 0, 1, 0, 0, 0, 1 },
    { 1, 0, trial::kInfinity, 0, 1, 0, 0, 0, 1 },
  };
  for (std::size_t t = 0; t < linears.size(); ++t)
  {
    SCOPED_TRACE(t);
    resampler->SetTransform(transformBy(linears[t]));
    trial::expectError(resampler, t < 4 ? "use scales other than 0" : "use finite numbers");
  }
  for (const double shift : { trial::kNan, -trial::kInfinity })
  {
    resampler->SetTransform(transformBy({ 1, 0, 0, 0, 1, 0, 0, 0, 1 }, shift));
    trial::expectError(resampler, "use finite numbers");
  }
  vtkNew<vtkPerspectiveTransform> perspective;
  perspective->Perspective(30, 1, 0.1, 10);
  resampler->SetTransform(perspective);
  trial::expectError(resampler, "last row 0, 0, 0, 1");
  resampler->SetTransform(vtkNew<vtkThinPlateSplineTransform>());
  trial::expectError(resampler, "use a vtkTransform");
  resampler->SetTransform(nullptr);
  resampler->Update();
  EXPECT_EQ(trial::sum(trial::countsOf(resampler->GetOutput())), 100) << "it recovers";
}
