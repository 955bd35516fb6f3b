// Properties that hold for every cloud, lattice and transform.
#include "VoxelMeanCases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

constexpr std::uint64_t kCases = 150;
constexpr vtkIdType kDrawnPoints = 3000;

/// Voxel of a coordinate on one axis; NaN where the output's type cannot tell voxels apart.
double voxelOf(double coordinate, const pointhaptics::Lattice& lattice, int axis, int type)
{
  const double h = lattice.spacing[axis];
  return 8 * trial::unitInTheLastPlace(coordinate, type) < h
    ? std::floor((coordinate - lattice.origin[axis]) / h)
    : NAN;
}

/// A cloud whose coordinates are multiples of 2^-20 in [0, 1): sums and shifts by whole numbers are exact.
vtkSmartPointer<vtkPolyData> dyadicCloud(int n, std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  return trial::cloudBy(n,
    [&](int)
    {
      const auto draw = [&] { return double(engine() & 0xFFFFF) * 0x1p-20; };
      const double x = draw();
      const double y = draw();
      return pointhaptics::Vec3(x, y, draw());
    });
}

}

TEST(VoxelMeanProperties, EveryPointIsInOneVoxelOrCountedAsLeftOut)
{
  for (std::uint64_t seed = 0; seed < kCases; ++seed)
  {
    const trial::VoxelMeanCase drawn = trial::drawCase(seed, kDrawnPoints);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << drawn);
    vtkNew<vtkVoxelMeanResampler> resampler;
    drawn.applyTo(resampler);
    resampler->Update();
    trial::expectValid(resampler->GetOutput());
    trial::expectEveryPointOnce(resampler, drawn.cloud->GetNumberOfPoints());
    EXPECT_TRUE(!drawn.automatic || resampler->GetNumberOfClippedPoints() == 0);
    ASSERT_FALSE(HasFailure());
  }
}

TEST(VoxelMeanProperties, MeansLieInTheirVoxelsWhichAreOrderedXFastest)
{
  for (std::uint64_t seed = 0; seed < kCases; ++seed)
  {
    const trial::VoxelMeanCase drawn = trial::drawCase(seed, kDrawnPoints);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << drawn);
    vtkNew<vtkVoxelMeanResampler> resampler;
    drawn.applyTo(resampler);
    resampler->Update();
    vtkPolyData* output = resampler->GetOutput();
    const trial::Oracle oracle = trial::oracleOf(resampler, drawn.cloud);
    ASSERT_EQ(output->GetNumberOfPoints(), vtkIdType(oracle.map.voxels.size()));
    vtkIdType v = 0;
    for (const auto& entry : oracle.map.voxels)
    {
      const auto index = oracle.lattice.indexOf(entry.first);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double voxel =
          voxelOf(output->GetPoint(v)[axis], oracle.lattice, axis, output->GetPoints()->GetDataType());
        ASSERT_TRUE(std::isnan(voxel) || voxel == double(index[axis])) << "voxel " << v << ", axis " << axis;
      }
      ++v;
    }
  }
}

TEST(VoxelMeanProperties, MovingByWholeVoxelsMovesTheOutputByWholeVoxels)
{
  const auto cloud = dyadicCloud(5000, 3);
  for (const int n : { 1, 4, 16, 128 })
  {
    vtkNew<vtkVoxelMeanResampler> here;
    here->SetInputData(cloud);
    trial::useUnitCube(here, n);
    here->ComputeCovarianceOn();
    here->Update();
    const double shifts[4][3] = { { 1, 0, 0 }, { -3, 5, 2 }, { 64, -64, 1024 }, { 0.25, 0.5, -0.75 } };
    for (const auto& shift : shifts)
    {
      if (std::fmod(shift[0] * n, 1.0) != 0.0)
      {
        continue;
      }
      vtkNew<vtkTransform> transform;
      transform->Translate(shift);
      vtkNew<vtkVoxelMeanResampler> there;
      there->SetInputData(cloud);
      there->SetTransform(transform);
      there->SetWorkspaceBounds(shift[0], shift[0] + 1, shift[1], shift[1] + 1, shift[2], shift[2] + 1);
      there->SetDimensions(n, n, n);
      there->ComputeCovarianceOn();
      there->Update();
      ASSERT_EQ(there->GetOutput()->GetNumberOfPoints(), here->GetOutput()->GetNumberOfPoints());
      for (const char* name : { "VoxelPointCount", "VoxelCovariance" })
      {
        EXPECT_TRUE(trial::sameBits(there->GetOutput()->GetPointData()->GetArray(name),
          here->GetOutput()->GetPointData()->GetArray(name)))
          << name;
      }
      for (vtkIdType v = 0; v < here->GetOutput()->GetNumberOfPoints(); ++v)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          const double moved = here->GetOutput()->GetPoint(v)[axis] + shift[axis];
          ASSERT_NEAR(
            there->GetOutput()->GetPoint(v)[axis], moved, 0x1p-52 * std::max(1.0, std::fabs(moved)));
        }
      }
    }
  }
}

TEST(VoxelMeanProperties, MovingTheLatticeInsteadOfTheCloudIsTheSame)
{
  // Voxels of a larger workspace that also lie in the smaller one have the same means.
  const auto cloud = dyadicCloud(5000, 4);
  vtkNew<vtkVoxelMeanResampler> small;
  small->SetInputData(cloud);
  small->SetWorkspaceBounds(0.25, 0.75, 0.25, 0.75, 0.25, 0.75);
  small->SetDimensions(8, 8, 8);
  small->Update();
  vtkNew<vtkVoxelMeanResampler> large;
  large->SetInputData(cloud);
  trial::useUnitCube(large, 16);
  large->Update();
  vtkIdType s = 0;
  for (vtkIdType v = 0; v < large->GetOutput()->GetNumberOfPoints(); ++v)
  {
    double p[3];
    large->GetOutput()->GetPoint(v, p);
    if (*std::min_element(p, p + 3) >= 0.25 && *std::max_element(p, p + 3) < 0.75)
    {
      ASSERT_LT(s, small->GetOutput()->GetNumberOfPoints());
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(small->GetOutput()->GetPoint(s)[axis], p[axis], 0x1p-52);
      }
      ++s;
    }
  }
  EXPECT_EQ(s, small->GetOutput()->GetNumberOfPoints());
}

TEST(VoxelMeanProperties, ResamplingTwiceKeepsVoxelsAndMeans)
{
  for (std::uint64_t seed = 0; seed < kCases; ++seed)
  {
    trial::VoxelMeanCase drawn = trial::drawCase(seed, kDrawnPoints);
    drawn.automatic = false;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << drawn);
    vtkNew<vtkVoxelMeanResampler> first;
    drawn.applyTo(first);
    first->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    first->Update();
    vtkNew<vtkVoxelMeanResampler> second;
    drawn.applyTo(second);
    second->SetTransform(nullptr);
    second->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    second->SetInputConnection(first->GetOutputPort());
    second->Update();
    vtkPolyData* once = first->GetOutput();
    vtkPolyData* twice = second->GetOutput();
    ASSERT_EQ(twice->GetNumberOfPoints(), once->GetNumberOfPoints());
    EXPECT_EQ(second->GetNumberOfClippedPoints(), 0);
    const pointhaptics::Vec3 h = trial::latticeOf(second, twice).spacing;
    for (vtkIdType v = 0; v < once->GetNumberOfPoints(); ++v)
    {
      ASSERT_EQ(trial::countsOf(twice)->GetTuple1(v), 1.0);
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(twice->GetPoint(v)[axis], once->GetPoint(v)[axis], 0x1p-31 * h[axis] + 1e-15);
      }
    }
  }
}
