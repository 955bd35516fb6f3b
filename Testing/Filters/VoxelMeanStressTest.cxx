#include "VoxelMeanFixtures.h"

#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <limits>
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

TEST(VoxelMeanStress, OneTwoAndElevenPointsComeThrough)
{
  for (const int n : { 1, 2, 11 })
  {
    for (const int type : { VTK_FLOAT, VTK_DOUBLE })
    {
      const auto cloud = trial::cloudOf(trial::randomPoints(n, 14, type));
      vtkNew<vtkVoxelMeanResampler> automatic;
      trial::expectRight(automatic, cloud);
      EXPECT_EQ(automatic->GetOutput()->GetNumberOfPoints(), n) << "300 voxels an edge keep them apart";
      vtkNew<vtkVoxelMeanResampler> fixed;
      trial::useUnitCube(fixed, 1);
      trial::expectRight(fixed, cloud);
      EXPECT_EQ(fixed->GetOutput()->GetNumberOfPoints(), 1);
    }
  }
}

TEST(VoxelMeanStress, IdenticalPointsGiveThatPointWithoutSpread)
{
  const pointhaptics::Vec3 place{ 0.1, -20.3, 3e5 };
  const auto cloud = trial::cloudBy(1000, [&](int) { return place; });
  vtkNew<vtkVoxelMeanResampler> resampler;
  trial::expectRight(resampler, cloud);
  vtkPolyData* output = resampler->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), 1);
  for (int m = 0; m < 6; ++m)
  {
    EXPECT_EQ(output->GetPointData()->GetArray("VoxelCovariance")->GetComponent(0, m), 0.0);
  }
}

TEST(VoxelMeanStress, CollinearPointsStayOnTheirLine)
{
  const auto cloud = trial::cloudBy(5000, [](int i) { return pointhaptics::Vec3(1, 2, -3) * (i / 5000.0); });
  vtkNew<vtkVoxelMeanResampler> resampler;
  trial::expectRight(resampler, cloud);
  vtkPolyData* output = resampler->GetOutput();
  EXPECT_GT(output->GetNumberOfPoints(), 300);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double* p = output->GetPoint(i);
    ASSERT_NEAR(p[1], 2 * p[0], 1e-11);
    ASSERT_NEAR(p[2], -3 * p[0], 1e-11);
  }
}

TEST(VoxelMeanStress, PointsOnFacesBelongToTheVoxelAbove)
{
  // 17^3 points on the corners of the 16^3 voxels: those on an upper face of the workspace are outside.
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    const auto cloud = trial::cloudBy(
      17 * 17 * 17, [](int i) { return pointhaptics::Vec3(i % 17, i / 17 % 17, i / 289) * (1 / 16.0); },
      type);
    vtkNew<vtkVoxelMeanResampler> resampler;
    trial::useUnitCube(resampler, 16);
    trial::expectRight(resampler, cloud);
    vtkPolyData* output = resampler->GetOutput();
    ASSERT_EQ(output->GetNumberOfPoints(), 16 * 16 * 16);
    EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 17 * 17 * 17 - 16 * 16 * 16);
    for (vtkIdType v = 0; v < output->GetNumberOfPoints(); ++v)
    {
      const double* p = output->GetPoint(v);
      ASSERT_EQ(p[0], double(v % 16) / 16);
      ASSERT_EQ(p[1], double(v / 16 % 16) / 16);
      ASSERT_EQ(p[2], double(v / 256) / 16);
    }
  }
}

TEST(VoxelMeanStress, CoplanarPointsOnAFaceFillOneLayer)
{
  std::mt19937_64 engine(5);
  const auto cloud = trial::cloudBy(20000,
    [&](int)
    {
      const double x = trial::uniform(engine);
      return pointhaptics::Vec3(x, trial::uniform(engine), 0.5);
    });
  vtkNew<vtkVoxelMeanResampler> resampler;
  trial::useUnitCube(resampler, 32);
  trial::expectRight(resampler, cloud);
  vtkPolyData* output = resampler->GetOutput();
  EXPECT_EQ(output->GetNumberOfPoints(), 32 * 32);
  for (vtkIdType v = 0; v < output->GetNumberOfPoints(); ++v)
  {
    ASSERT_EQ(output->GetPoint(v)[2], 0.5);
  }
}

TEST(VoxelMeanStress, NegativeCoordinatesAreFlooredNotTruncated)
{
  const double little = 0x1p-40;
  const auto cloud = trial::cloudAt({ { -little, 0, 0 }, { -0.0, 0, 0 }, { 0.25, 0, 0 }, { -0.25, 0, 0 },
    { -0.25 - little, 0, 0 }, { -1, 0, 0 }, { std::nextafter(-1.0, -2.0), 0, 0 } });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetWorkspaceBounds(-1, 1, -1, 1, -1, 1);
  resampler->SetDimensions(8, 8, 8);
  trial::expectRight(resampler, cloud);
  vtkPolyData* output = resampler->GetOutput();
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 1) << "only the one below -1";
  ASSERT_EQ(output->GetNumberOfPoints(), 5);
  const double counts[5] = { 1, 1, 2, 1, 1 }; // from -1, -0.5, -0.25, 0 and 0.25
  for (int v = 0; v < 5; ++v)
  {
    EXPECT_EQ(trial::countsOf(output)->GetTuple1(v), counts[v]) << v;
  }
}

TEST(VoxelMeanStress, UtmOffsetsKeepTheirPrecision)
{
  const pointhaptics::Vec3 corner{ 684766.39, 4617773.08, 312.5 };
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    // A voxel of 0.1 m is smaller than a float's unit in the last place there (0.5 m): still right.
    const auto cloud = randomCloud(100000, 2.0, corner, type);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetVoxelSize(0.1);
    resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    trial::expectRight(resampler, cloud);
    resampler->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
    trial::expectRight(resampler, cloud);
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

TEST(VoxelMeanStress, ScalesFromTinyToHuge)
{
  for (const double scale : { 1e-150, 1e-30, 1e-12, 1e-6, 1.0, 1e6, 1e12, 1e30, 1e150 })
  {
    SCOPED_TRACE(scale);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetDimensions(20, 20, 20);
    const auto cloud = randomCloud(5000, scale, {}, VTK_DOUBLE);
    trial::expectRight(resampler, cloud);
    EXPECT_GT(resampler->GetOutput()->GetNumberOfPoints(), 1000);
    EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
    vtkNew<vtkTransform> back;
    back->Scale(1 / scale, 1 / scale, 1 / scale);
    if (scale > 1e-100 && scale < 1e100) // beyond, the determinant leaves the range of double
    {
      resampler->SetTransform(back);
      trial::expectRight(resampler, cloud);
      EXPECT_GT(resampler->GetOutput()->GetNumberOfPoints(), 1000);
    }
  }
}

TEST(VoxelMeanStress, DenormalCoordinatesCountAsWhatTheyAre)
{
  const auto cloud =
    trial::cloudBy(1000, [](int i) { return pointhaptics::Vec3(i, 2 * i, 3 * i) * DBL_TRUE_MIN; });
  const auto floats = trial::cloudBy(
    1000, [](int i) { return pointhaptics::Vec3(i, i, i) * double(FLT_TRUE_MIN); }, VTK_FLOAT);
  for (vtkPolyData* input : { cloud.Get(), floats.Get() })
  {
    vtkNew<vtkVoxelMeanResampler> fixed;
    trial::useUnitCube(fixed, 10);
    trial::expectRight(fixed, input);
    EXPECT_EQ(fixed->GetOutput()->GetNumberOfPoints(), 1);
    EXPECT_EQ(fixed->GetNumberOfClippedPoints(), 0) << "0 and what is just above it are inside";
    vtkNew<vtkVoxelMeanResampler> automatic;
    trial::expectRightOrError(automatic, input);
  }
  // Below 0, however little, is outside.
  vtkNew<vtkVoxelMeanResampler> fixed;
  trial::useUnitCube(fixed, 10);
  trial::expectRight(
    fixed, trial::cloudBy(10, [](int i) { return pointhaptics::Vec3(-DBL_TRUE_MIN, 0, 0) * double(i); }));
  EXPECT_EQ(fixed->GetNumberOfClippedPoints(), 9);
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

TEST(VoxelMeanStress, TenMillionPointsInOneVoxelAreAveragedExactly)
{
  constexpr int kPoints = 10000000;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(kPoints);
  float* p = static_cast<float*>(points->GetVoidPointer(0));
  std::int64_t sums[3] = { 0, 0, 0 };
  for (std::int64_t i = 0; i < kPoints; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t part = (i * (7 + 2 * axis)) & 1023;
      sums[axis] += part;
      *p++ = float(part) / 1024;
    }
  }
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(points));
  trial::useUnitCube(resampler, 1);
  resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  resampler->Update();
  ASSERT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 1);
  EXPECT_EQ(trial::countsOf(resampler->GetOutput())->GetTuple1(0), kPoints);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(resampler->GetOutput()->GetPoint(0)[axis], double(sums[axis]) / 1024 / kPoints, 0x1p-31);
  }
}
