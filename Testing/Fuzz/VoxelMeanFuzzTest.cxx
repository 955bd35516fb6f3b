// vtkVoxelMeanResampler against the definition in long double, over random clouds, lattices and transforms.
#include "FuzzRuns.h"
#include "VoxelMeanCases.h"

#include <gtest/gtest.h>

namespace
{

/// Points on the corners, faces and edges of dyadic voxels, where one wrong rounding changes the voxel.
trial::VoxelMeanCase drawCaseOnFaces(std::uint64_t seed)
{
  std::mt19937_64 engine(seed * 0x9E3779B97F4A7C15u + 2);
  trial::VoxelMeanCase drawn;
  const double grain = std::ldexp(1.0, -int(engine() % 6));
  const int n = int(engine() % 800);
  drawn.cloud = trial::cloudBy(
    n,
    [&](int)
    {
      pointhaptics::Vec3 p;
      for (int axis = 0; axis < 3; ++axis)
      {
        p[axis] = (double(engine() % 33) - 16) * grain;
      }
      return p;
    },
    engine() % 2 ? VTK_FLOAT : VTK_DOUBLE);
  for (int axis = 0; axis < 3; ++axis)
  {
    drawn.dimensions[axis] = 1 << (engine() % 7);
    drawn.bounds[2 * axis] = -grain * double(engine() % 17);
    drawn.bounds[2 * axis + 1] = drawn.bounds[2 * axis] + grain * double(1 << (engine() % 6));
  }
  if (engine() % 3 == 0)
  {
    drawn.voxelSize = grain * std::ldexp(1.0, int(engine() % 4) - 2);
  }
  drawn.precision = int(engine() % 3);
  if (engine() % 2)
  {
    // Exchange and mirror axes, scale by powers of two: exact.
    const int first = int(engine() % 3);
    const int second = (first + 1 + int(engine() % 2)) % 3;
    const int axes[3] = { first, second, 3 - first - second };
    double rows[16] = { 0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      rows[4 * axis + axes[axis]] = (engine() % 2 ? -1 : 1) * std::ldexp(1.0, int(engine() % 3) - 1);
      rows[4 * axis + 3] = grain * (double(engine() % 9) - 4);
    }
    rows[15] = 1;
    drawn.transform = vtkSmartPointer<vtkTransform>::New();
    drawn.transform->SetMatrix(rows);
  }
  return drawn;
}

/// False where the case is an error, or no point is inside.
bool expectAgrees(vtkVoxelMeanResampler* resampler, const trial::VoxelMeanCase& drawn, std::uint64_t seed)
{
  SCOPED_TRACE(testing::Message() << "repeat with POINTHAPTICS_FUZZ_SEED=" << seed
                                  << " POINTHAPTICS_FUZZ_RUNS=1: " << drawn);
  drawn.applyTo(resampler);
  resampler->SetComputeCovariance(seed % 2 == 0);
  trial::Ear errors(resampler, vtkCommand::ErrorEvent);
  resampler->Update();
  if (errors.count > 0)
  {
    // Voxels too small to be addressed are the one mistake these cases can make.
    EXPECT_TRUE(drawn.voxelSize > 0.0) << errors.last;
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
    return false;
  }
  trial::expectAgrees(resampler, drawn.cloud);
  return resampler->GetOutput()->GetNumberOfPoints() > 0;
}

}

// One resampler works through all cases, as in a program: what it keeps between updates must not show.
// Another one is new each time.

TEST(VoxelMean, AgreesWithTheDefinitionOnRandomCases)
{
  const trial::FuzzRuns runs(2000);
  std::uint64_t filled = 0;
  vtkNew<vtkVoxelMeanResampler> used;
  for (std::uint64_t seed = runs.first; seed < runs.first + runs.count && !HasFailure(); ++seed)
  {
    const trial::VoxelMeanCase drawn = trial::drawCase(seed, 2000);
    filled += expectAgrees(used, drawn, seed) ? 1 : 0;
    vtkNew<vtkVoxelMeanResampler> fresh;
    expectAgrees(fresh, drawn, seed);
  }
  EXPECT_TRUE(runs.count < 10 || filled > runs.count / 2) << "most cases are empty: " << filled;
}

TEST(VoxelMean, AgreesWithTheDefinitionOnFacesAndCorners)
{
  const trial::FuzzRuns runs(4000);
  std::uint64_t filled = 0;
  vtkNew<vtkVoxelMeanResampler> used;
  for (std::uint64_t seed = runs.first; seed < runs.first + runs.count && !HasFailure(); ++seed)
  {
    filled += expectAgrees(used, drawCaseOnFaces(seed), seed) ? 1 : 0;
  }
  EXPECT_TRUE(runs.count < 10 || filled > runs.count / 2) << "most cases are empty: " << filled;
}
