#include "VoxelMeanFixtures.h"

#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <vector>

namespace
{

/// Random points of the unit cube, scaled, then shifted.
vtkSmartPointer<vtkPolyData> randomCloud(int n, double scale, const pointhaptics::Vec3& shift, int type)
{
  std::mt19937_64 engine(77);
  return trial::cloudBy(
    n,
    [&](int)
    {
      const double x = trial::uniform(engine);
      const double y = trial::uniform(engine);
      return shift + scale * pointhaptics::Vec3(x, y, trial::uniform(engine));
    },
    type);
}

/// Expects all named arrays, without tuples: later filters find them.
void expectEveryArrayWithoutTuples(vtkVoxelMeanResampler* resampler, const std::vector<const char*>& names)
{
  vtkPolyData* output = resampler->GetOutput();
  ASSERT_NE(output->GetPoints(), nullptr);
  EXPECT_EQ(output->GetPointData()->GetNumberOfArrays(), int(names.size()));
  for (const char* name : names)
  {
    ASSERT_NE(output->GetPointData()->GetArray(name), nullptr) << name;
    EXPECT_EQ(output->GetPointData()->GetArray(name)->GetNumberOfTuples(), 0) << name;
  }
  EXPECT_NE(output->GetFieldData()->GetArray("LatticeSpacing"), nullptr);
}

}

TEST(VoxelMeanStress, NoPointsGiveAnEmptyOutput)
{
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkPoints> noPoints;
  const auto noPlaces = trial::cloudOf(noPoints);
  for (vtkPolyData* input : { nothing.Get(), noPlaces.Get() })
  {
    trial::addArray(input, "Heat", {});
    trial::addArray(input, "Classification", {});
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(input);
    resampler->ComputeCovarianceOn();
    trial::Ear errors(resampler, vtkCommand::ErrorEvent);
    for (const bool automatic : { true, false })
    {
      resampler->SetAutomaticWorkspace(automatic);
      resampler->Update();
      EXPECT_EQ(errors.count, 0) << errors.last;
      EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
      EXPECT_EQ(resampler->GetOutput()->GetNumberOfCells(), 0);
      EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
      EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 0);
      expectEveryArrayWithoutTuples(
        resampler, { "VoxelPointCount", "VoxelCovariance", "Heat", "Classification" });
    }
  }
}

TEST(VoxelMeanStress, UtmCloudsMovedToTheOriginKeepTheirPrecision)
{
  const pointhaptics::Vec3 corner{ 684766.39, 4617773.08, 312.5 };
  vtkNew<vtkTransform> transform;
  transform->RotateWXYZ(40, 1, -2, 3);
  transform->Scale(0.01, 0.01, 0.02);
  transform->Translate(-corner.x, -corner.y, -corner.z);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetTransform(transform);
  resampler->SetDimensions(50, 50, 50);
  trial::expectRight(resampler, randomCloud(50000, 10.0, corner, VTK_DOUBLE));
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
}

TEST(VoxelMeanStress, NanAndInfinityAreDroppedAndCounted)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    std::mt19937_64 engine(6);
    const double bad[3] = { trial::kNan, trial::kInfinity, -trial::kInfinity };
    const auto cloud = trial::cloudBy(
      3000,
      [&](int i)
      {
        pointhaptics::Vec3 p{ trial::uniform(engine), trial::uniform(engine), trial::uniform(engine) };
        if (i % 10 == 0)
        {
          p[i / 10 % 3] = bad[i / 30 % 3];
        }
        return p;
      },
      type);
    vtkNew<vtkVoxelMeanResampler> resampler;
    trial::useUnitCube(resampler, 8);
    trial::expectRight(resampler, cloud);
    EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 300);
    EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
    resampler->AutomaticWorkspaceOn();
    trial::expectRight(resampler, cloud);
    EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 300) << "they do not stretch the workspace either";
    EXPECT_GT(resampler->GetOutput()->GetNumberOfPoints(), 300);
    vtkNew<vtkTransform> turn;
    turn->RotateX(20);
    resampler->SetTransform(turn);
    trial::expectRight(resampler, cloud);
    EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 300);
  }
}

TEST(VoxelMeanStress, NothingButInvalidPointsGiveAnEmptyOutput)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudBy(100, [](int i) { return pointhaptics::Vec3(i, trial::kNan, 0); }));
  trial::Ear errors(resampler, vtkCommand::ErrorEvent);
  resampler->Update();
  EXPECT_EQ(errors.count, 0) << errors.last;
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 100);
  expectEveryArrayWithoutTuples(resampler, { "VoxelPointCount" });
}

TEST(VoxelMeanStress, BoxesNearTheLargestNumbers)
{
  // The extent is no number: an error. Half of it is one.
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudAt({ { -DBL_MAX, 0, 0 }, { DBL_MAX, 0, 0 } }));
  trial::expectError(resampler, "must be finite with maximum above minimum");
  for (const double largest : { 1e300, 0.4 * DBL_MAX, DBL_MAX })
  {
    SCOPED_TRACE(largest);
    vtkNew<vtkVoxelMeanResampler> one;
    trial::expectRightOrError(one, randomCloud(1000, largest, {}, VTK_DOUBLE));
    vtkNew<vtkVoxelMeanResampler> small;
    trial::useUnitCube(small, 4);
    trial::expectRight(small, trial::cloudAt({ { largest, 0, 0 }, { 0.5, -largest, 0 }, { 0.5, 0.5, 0.5 } }));
    EXPECT_EQ(small->GetNumberOfClippedPoints(), 2);
  }
  vtkNew<vtkVoxelMeanResampler> floats;
  trial::expectRight(floats, randomCloud(1000, FLT_MAX, {}, VTK_FLOAT));
}

TEST(VoxelMeanStress, PointsThatATransformThrowsOutOfTheNumbersAreDropped)
{
  vtkNew<vtkTransform> transform;
  transform->Scale(1e10, 1e-10, 1);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetTransform(transform);
  trial::useUnitCube(resampler, 4);
  resampler->SetInputData(trial::cloudAt({ { 1e300, 0, 0 }, { 5e-11, 5e9, 0.5 }, { 1e-3, 0.5, 0.5 } }));
  resampler->Update();
  ASSERT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 1);
  EXPECT_NEAR(resampler->GetOutput()->GetPoint(0)[0], 0.5, 1e-12);
  trial::expectEveryPointOnce(resampler, 3);
}
