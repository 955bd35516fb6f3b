// Averaged point arrays against the definition in long double, over random clouds, lattices and transforms.
#include "FuzzRuns.h"
#include "VoxelMeanAttributeOracle.h"
#include "VoxelMeanCases.h"

#include <gtest/gtest.h>

TEST(VoxelMeanAttributes, AgreeWithTheDefinitionOnRandomCases)
{
  const trial::FuzzRuns runs(150);
  vtkNew<vtkVoxelMeanResampler> resampler;
  for (std::uint64_t seed = runs.first; seed < runs.first + runs.count && !HasFailure(); ++seed)
  {
    const trial::VoxelMeanCase drawn = trial::drawCase(seed, 1500);
    SCOPED_TRACE(testing::Message() << "repeat with POINTHAPTICS_FUZZ_SEED=" << seed
                                    << " POINTHAPTICS_FUZZ_RUNS=1: " << drawn);
    trial::addScanAttributes(drawn.cloud, seed);
    drawn.applyTo(resampler);
    trial::Ear errors(resampler, vtkCommand::ErrorEvent);
    resampler->Update();
    if (errors.count > 0)
    {
      EXPECT_TRUE(drawn.voxelSize > 0.0) << errors.last;
      continue;
    }
    trial::expectValid(resampler->GetOutput());
    if (resampler->GetOutput()->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const trial::Oracle oracle = trial::oracleOf(resampler, drawn.cloud);
    vtkPointData* in = drawn.cloud->GetPointData();
    vtkPointData* out = resampler->GetOutput()->GetPointData();
    for (const char* name : { "Heat", "GpsTime", "Weight", "Features", "Angle", "Id", "RGB" })
    {
      trial::expectMeansAgree(in->GetArray(name), out->GetArray(name), oracle);
    }
    trial::expectMajorityAgrees(in->GetArray("Classification"), out->GetArray("Classification"), oracle);
  }
}
