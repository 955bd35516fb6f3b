#include "VoxelMeanFixtures.h"

#include "vtkMatrix4x4.h"
#include "vtkStructuredGrid.h"
#include "vtkThinPlateSplineTransform.h"
#include "vtkTransform.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

TEST(VoxelMeanResampler, AgreesWithTheDefinition)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    const auto cloud = trial::cloudOf(trial::randomPoints(5000, 1, type));
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    trial::useUnitCube(resampler, 9);
    resampler->ComputeCovarianceOn();
    resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    resampler->Update();
    trial::expectAgrees(resampler, cloud);
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 9 * 9 * 9);
    EXPECT_EQ(trial::sum(trial::countsOf(resampler->GetOutput())), 5000);
  }
}

TEST(VoxelMeanResampler, FieldDataStateLatticeAndTransform)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(0.5, 0, 0);
  transform->Scale(2, 3, -4);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(50, 1)));
  resampler->SetTransform(transform);
  resampler->SetWorkspaceBounds(-1, 3, 0, 3, -4, 0);
  resampler->SetDimensions(8, 3, 2);
  resampler->Update();
  pointhaptics::Lattice lattice = trial::latticeOf(resampler, resampler->GetOutput());
  const auto matrix = trial::transformOf(resampler->GetOutput());
  for (int axis = 0; axis < 3; ++axis)
  {
    const double origin[3] = { -1, 0, -4 };
    const double spacing[3] = { 0.5, 1, 2 };
    const int dimensions[3] = { 8, 3, 2 };
    EXPECT_EQ(lattice.origin[axis], origin[axis]);
    EXPECT_EQ(lattice.spacing[axis], spacing[axis]);
    EXPECT_EQ(lattice.dimensions[axis], dimensions[axis]);
    for (int column = 0; column < 4; ++column)
    {
      EXPECT_EQ(matrix.m[axis][column], transform->GetMatrix()->GetElement(axis, column));
    }
  }
  resampler->SetVoxelSize(0.8);
  resampler->Update();
  lattice = trial::latticeOf(resampler, resampler->GetOutput());
  EXPECT_EQ(lattice.dimensions, (std::array<std::int64_t, 3>{ 5, 4, 5 })) << "rounded up";
}

TEST(VoxelMeanResampler, TakesAnyPointSet)
{
  const auto points = trial::randomPoints(1000, 2);
  vtkNew<vtkUnstructuredGrid> unstructured;
  unstructured->SetPoints(points);
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(10, 10, 10);
  structured->SetPoints(points);
  vtkNew<vtkVoxelMeanResampler> resampler;
  trial::useUnitCube(resampler, 5);
  resampler->SetInputData(trial::cloudOf(points));
  resampler->Update();
  vtkNew<vtkPolyData> expected;
  expected->DeepCopy(resampler->GetOutput());
  EXPECT_EQ(expected->GetNumberOfPoints(), 125);
  for (vtkPointSet* input :
    { static_cast<vtkPointSet*>(unstructured.Get()), static_cast<vtkPointSet*>(structured.Get()) })
  {
    resampler->SetInputData(input);
    resampler->Update();
    trial::expectSame(resampler->GetOutput(), expected);
  }
}

TEST(VoxelMeanResampler, OrdersItsOutputByVoxelXFastest)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(4000, 8));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 6);
  resampler->Update();
  vtkPolyData* output = resampler->GetOutput();
  int last = -1;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double* p = output->GetPoint(i);
    const int key = int(p[0] * 6) + 6 * (int(p[1] * 6) + 6 * int(p[2] * 6));
    EXPECT_GT(key, last);
    last = key;
  }
}

TEST(VoxelMeanResampler, OutputPrecisionFollowsVtksConvention)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(trial::cloudOf(trial::randomPoints(50, 9, type)));
    const int precisions[3][2] = { { vtkAlgorithm::SINGLE_PRECISION, VTK_FLOAT },
      { vtkAlgorithm::DOUBLE_PRECISION, VTK_DOUBLE }, { vtkAlgorithm::DEFAULT_PRECISION, type } };
    for (const auto& precision : precisions)
    {
      resampler->SetOutputPointsPrecision(precision[0]);
      resampler->Update();
      EXPECT_EQ(resampler->GetOutput()->GetPoints()->GetDataType(), precision[1]);
    }
  }
}

TEST(VoxelMeanResampler, OfDimensionsAndVoxelSizeTheOneSetLastRules)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  EXPECT_EQ(resampler->GetDimensions()[0], 300);
  EXPECT_EQ(resampler->GetVoxelSize(), 0.0);
  EXPECT_TRUE(resampler->GetAutomaticWorkspace());
  EXPECT_FALSE(resampler->GetComputeCovariance());
  EXPECT_TRUE(resampler->GetPassAttributes());
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(20000, 10)));
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
  EXPECT_FALSE(resampler->GetAutomaticWorkspace()) << "bounds turn the automatic workspace off";
  resampler->SetVoxelSize(0.25);
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 64);
  resampler->SetDimensions(2, 2, 2);
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 8);
  EXPECT_EQ(resampler->GetVoxelSize(), 0.0);
  resampler->SetVoxelSize(0.5000001);
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 8);
  resampler->SetVoxelSize(0.3);
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 64) << "rounded up, never truncated";
}

TEST(VoxelMeanResampler, AutomaticWorkspaceClipsNothing)
{
  for (const double scale : { 1e-9, 1.0, 1e9 })
  {
    vtkNew<vtkTransform> transform;
    transform->RotateWXYZ(30, 1, 2, 3);
    transform->Scale(scale, scale, scale);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(trial::cloudOf(trial::randomPoints(2000, 11)));
    resampler->SetTransform(transform);
    resampler->Update();
    EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
    EXPECT_EQ(trial::sum(trial::countsOf(resampler->GetOutput())), 2000);
  }
}

TEST(VoxelMeanResampler, CountsClippedAndInvalidPoints)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto cloud = trial::cloudAt(
    { { 0.5, 0.5, 0.5 }, { 2, 0, 0 }, { nan, 0, 0 }, { 0, HUGE_VAL, 0 }, { 1, 0, 0 }, { 0, 0, 0 } });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 4);
  resampler->Update();
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 2);
  EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 2);
  EXPECT_EQ(trial::sum(trial::countsOf(resampler->GetOutput())), 2);
}

TEST(VoxelMeanResampler, RunsAgainWhenSomethingChangedAndOnlyThen)
{
  vtkNew<vtkTransform> transform;
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 12));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 4);
  resampler->SetTransform(transform);
  resampler->Update();
  trial::Ear runs(resampler, vtkCommand::StartEvent);
  const auto runsOnce = [&](const char* change)
  {
    runs.count = 0;
    resampler->Update();
    resampler->Update();
    EXPECT_EQ(runs.count, 1) << change;
  };
  const auto staysStill = [&](const char* change)
  {
    runs.count = 0;
    resampler->Update();
    EXPECT_EQ(runs.count, 0) << change;
  };
  staysStill("nothing");
  transform->Translate(0.1, 0, 0);
  runsOnce("transform edited");
  EXPECT_GT(resampler->GetNumberOfClippedPoints(), 0);
  resampler->SetTransform(nullptr);
  runsOnce("transform removed");
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
  transform->Translate(0.1, 0, 0);
  staysStill("a transform that is no longer used");
  resampler->SetDimensions(5, 5, 5);
  runsOnce("dimensions");
  resampler->SetDimensions(5, 5, 5);
  staysStill("the same dimensions");
  resampler->SetVoxelSize(0.2);
  runsOnce("voxel size");
  resampler->SetVoxelSize(0.2);
  staysStill("the same voxel size");
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 2);
  runsOnce("bounds");
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 2);
  staysStill("the same bounds");
  resampler->AddCategoricalArray("x");
  runsOnce("a categorical array");
  resampler->AddCategoricalArray("x");
  staysStill("the same categorical array");
  resampler->RemoveCategoricalArray("x");
  runsOnce("a categorical array removed");
  resampler->ComputeCovarianceOn();
  runsOnce("covariance");
  resampler->ComputeCovarianceOn();
  staysStill("the same covariance");
  cloud->GetPoints()->SetPoint(0, 0.5, 0.5, 0.5);
  cloud->GetPoints()->Modified();
  runsOnce("the input");
}

TEST(VoxelMeanResampler, LeavesItsInputAlone)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 13));
  trial::addArray(cloud, "Heat", std::vector<double>(1000, 1.0));
  vtkNew<vtkPolyData> before;
  before->DeepCopy(cloud);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->Update();
  trial::expectSame(cloud, before);
  EXPECT_EQ(cloud->GetPointData()->GetNumberOfArrays(), 1);
}

TEST(VoxelMeanResampler, ErrorsNameTheCureAndGiveAValidEmptyOutput)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(100, 15)));
  resampler->Update();
  ASSERT_GT(resampler->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkTransform> singular;
  singular->Scale(1, 1, 1);
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(2, 2, 0.0);
  singular->SetMatrix(matrix);
  resampler->SetTransform(singular);
  trial::expectError(resampler, "use scales other than 0");
  matrix->SetElement(2, 2, std::numeric_limits<double>::quiet_NaN());
  singular->SetMatrix(matrix);
  trial::expectError(resampler, "use finite numbers");
  vtkNew<vtkThinPlateSplineTransform> bent;
  resampler->SetTransform(bent);
  trial::expectError(resampler, "use a vtkTransform");
  resampler->SetTransform(nullptr);
  resampler->SetWorkspaceBounds(1, 0, 0, 1, 0, 1);
  trial::expectError(resampler, "must be finite with maximum above minimum");
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, std::numeric_limits<double>::infinity());
  trial::expectError(resampler, "must be finite with maximum above minimum");
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
  resampler->SetVoxelSize(1e-9);
  trial::expectError(resampler, "use a larger voxel size");
  resampler->SetVoxelSize(-1);
  trial::expectError(resampler, "voxel size must be finite and above 0");
  resampler->SetDimensions(0, 10, 10);
  trial::expectError(resampler, "must be between 1 and 2097152");
  resampler->SetDimensions(10, 10, 10);
  resampler->Update();
  EXPECT_GT(resampler->GetOutput()->GetNumberOfPoints(), 0) << "it recovers";
}
