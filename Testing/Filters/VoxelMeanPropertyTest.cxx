// Properties that hold for every cloud, lattice and transform.
#include "VoxelMeanCases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

constexpr std::uint64_t kCases = 150;
constexpr vtkIdType kDrawnPoints = 3000;

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
