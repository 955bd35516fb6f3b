#include "VoxelMeanFixtures.h"

#include "vtkStructuredGrid.h"
#include "vtkTransform.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <array>

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
