#include "SurfaceArrays.h"

#include "HapticSceneBuilder.h"
#include "MadeClouds.h"
#include "vtkVoxelMeanResampler.h"

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>

#include <cmath>

using namespace pointhaptics;

namespace
{

/// A square of 40 units, points 1 unit apart, at z = 0; the row at the middle is @p height above it, and one
/// point is far from all.
vtkSmartPointer<vtkPolyData> makeRidge(double height)
{
  std::vector<Vec3> points;
  for (int i = -20; i <= 20; ++i)
  {
    for (int j = -20; j <= 20; ++j)
    {
      points.emplace_back(i, j, i == 0 ? height : 0.0);
    }
  }
  points.emplace_back(0.0, 0.0, 40.0);
  return trial::cloudOf(points);
}

/// Its means, each of one point, after a scale of @p scale and a turn that takes z to x.
vtkSmartPointer<vtkPolyData> resampled(double height, double scale)
{
  vtkNew<vtkTransform> transform;
  transform->RotateY(90.0);
  transform->Scale(scale, scale, scale);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(makeRidge(height));
  resampler->SetTransform(transform);
  resampler->SetVoxelSize(0.5 * scale);
  resampler->ComputeCovarianceOn();
  resampler->Update();
  return resampler->GetOutput();
}

vtkSmartPointer<vtkPolyData> withArrays(double height, double scale, bool residuals, bool normals)
{
  const vtkSmartPointer<vtkPolyData> means = resampled(height, scale);
  Status status = Status::Empty;
  const auto scene = makeHapticScene(means, status);
  EXPECT_EQ(status, Status::Ok);
  addSurfaceArrays(means, *scene, residuals, normals);
  return means;
}

double largest(vtkDataArray* array)
{
  double most = 0.0;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    const double value = array->GetComponent(i, 0);
    most = std::isnan(value) ? most : std::max(most, value);
  }
  return most;
}

TEST(SurfaceArrays, AreThoseThatAreAskedFor)
{
  for (const bool residuals : { false, true })
  {
    for (const bool normals : { false, true })
    {
      const vtkSmartPointer<vtkPolyData> means = withArrays(0.0, 0.001, residuals, normals);
      vtkPointData* data = means->GetPointData();
      EXPECT_EQ(data->HasArray(kResidualArrayName) != 0, residuals);
      EXPECT_EQ(data->HasArray(kSurfaceNormalArrayName) != 0, normals);
    }
  }
}

TEST(SurfaceArrays, GiveResidualsInTheUnitsOfTheCloud)
{
  const vtkSmartPointer<vtkPolyData> flat = withArrays(0.0, 0.001, true, false);
  EXPECT_LT(largest(flat->GetPointData()->GetArray(kResidualArrayName)), 1e-6);
  const double small =
    largest(withArrays(0.2, 0.001, true, false)->GetPointData()->GetArray(kResidualArrayName));
  const double large =
    largest(withArrays(0.2, 0.002, true, false)->GetPointData()->GetArray(kResidualArrayName));
  EXPECT_GT(small, 0.05); // the fit gives way to the row in part
  EXPECT_LT(small, 0.2);
  EXPECT_NEAR(large, small, 1e-5);
}

TEST(SurfaceArrays, GiveNormalsInTheFrameOfTheMeansAndNothingForALonelyPoint)
{
  const vtkSmartPointer<vtkPolyData> means = withArrays(0.0, 0.001, true, true);
  vtkDataArray* residuals = means->GetPointData()->GetArray(kResidualArrayName);
  vtkDataArray* normals = means->GetPointData()->GetArray(kSurfaceNormalArrayName);
  ASSERT_EQ(normals->GetNumberOfTuples(), 41 * 41 + 1);
  int lonely = 0;
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    double normal[3];
    normals->GetTuple(i, normal);
    const bool isLonely = std::abs(means->GetPoint(i)[0]) > 0.01;
    lonely += isLonely ? 1 : 0;
    EXPECT_EQ(std::isnan(residuals->GetComponent(i, 0)), isLonely);
    EXPECT_NEAR(std::abs(normal[0]), isLonely ? 0.0 : 1.0, 1e-5);
  }
  EXPECT_EQ(lonely, 1);
}

TEST(SurfaceArrays, OfNoPointAreNone)
{
  vtkNew<vtkPolyData> empty;
  Status status = Status::Empty;
  const auto scene = makeHapticScene(resampled(0.0, 0.001), status);
  ASSERT_NE(scene, nullptr);
  addSurfaceArrays(empty, *scene, true, true);
  EXPECT_EQ(empty->GetPointData()->GetNumberOfArrays(), 0);
}

} // namespace
