// How exact the means and second moments are, against the long double twin.
#include "VoxelMeanCases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

/// Largest error of a mean in voxels, and of a second moment in squared voxels.
struct Errors
{
  double mean = 0.0;
  double moment = 0.0;
};

Errors errorsOf(vtkVoxelMeanResampler* resampler, vtkPolyData* cloud)
{
  const trial::Oracle oracle = trial::oracleOf(resampler, cloud);
  vtkPolyData* output = resampler->GetOutput();
  EXPECT_EQ(output->GetNumberOfPoints(), vtkIdType(oracle.map.voxels.size()));
  vtkDataArray* moments = output->GetPointData()->GetArray("VoxelCovariance");
  const pointhaptics::Vec3 h = oracle.lattice.spacing;
  const double areas[6] = { h.x * h.x, h.y * h.y, h.z * h.z, h.x * h.y, h.y * h.z, h.x * h.z };
  Errors worst;
  vtkIdType v = 0;
  for (const auto& entry : oracle.map.voxels)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const long double error = output->GetPoint(v)[axis] - entry.second.mean[axis];
      worst.mean = std::max(worst.mean, double(std::fabs(error)) / h[axis]);
    }
    for (int m = 0; m < 6; ++m)
    {
      const long double error = moments->GetComponent(v, m) - entry.second.covariance[m];
      worst.moment = std::max(worst.moment, double(std::fabs(error)) / areas[m]);
    }
    ++v;
  }
  return worst;
}

void useDoubleWithMoments(vtkVoxelMeanResampler* resampler)
{
  resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  resampler->ComputeCovarianceOn();
}

}

TEST(VoxelMeanAccuracy, MeansAreExactTo31BitsOfAVoxel)
{
  // About the origin, so that the rounding of the output in double is far below 2^-31 voxel.
  for (const int n : { 1, 2, 7, 30, 300 })
  {
    for (const int type : { VTK_FLOAT, VTK_DOUBLE })
    {
      const auto cloud = trial::cloudOf(trial::randomPoints(100000, std::uint64_t(n), type));
      vtkNew<vtkVoxelMeanResampler> resampler;
      resampler->SetInputData(cloud);
      trial::useUnitCube(resampler, n);
      useDoubleWithMoments(resampler);
      resampler->Update();
      const Errors worst = errorsOf(resampler, cloud);
      EXPECT_LE(worst.mean, 0x1p-31) << n;
      EXPECT_LE(worst.moment, 0x1p-30) << n;
    }
  }
}

TEST(VoxelMeanAccuracy, FloatOutputIsWithinOneUnitInTheLastPlaceOfTheRoundedMean)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(100000, 6));
  for (const int n : { 1, 16, 128 })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    trial::useUnitCube(resampler, n);
    resampler->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
    resampler->Update();
    const trial::Oracle oracle = trial::oracleOf(resampler, cloud);
    vtkPolyData* output = resampler->GetOutput();
    ASSERT_EQ(output->GetNumberOfPoints(), vtkIdType(oracle.map.voxels.size()));
    vtkIdType v = 0;
    for (const auto& entry : oracle.map.voxels)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        const float rounded = float(entry.second.mean[axis]);
        const float got = float(output->GetPoint(v)[axis]);
        // Beside it where 2^-31 voxel is less than a unit in the last place.
        const double slack = 0x1p-31 / n;
        ASSERT_LE(double(got), double(std::nextafter(rounded, 2.0f)) + slack) << v;
        ASSERT_GE(double(got), double(std::nextafter(rounded, -1.0f)) - slack) << v;
      }
      ++v;
    }
  }
}
