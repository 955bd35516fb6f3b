// What holds for every cloud, lattice and transform.
#include "VoxelMeanCases.h"

#include <gtest/gtest.h>

TEST(VoxelMeanProperties, EveryPointIsInOneVoxelOrCountedAsLeftOut)
{
  for (std::uint64_t seed = 0; seed < 150; ++seed)
  {
    const trial::VoxelMeanCase drawn = trial::drawCase(seed, 3000);
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
