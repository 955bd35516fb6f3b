/// @file
/// Bytes of an accumulator that were cut or changed on their way.
#pragma once

#include "Core/Resample/VoxelAccumulator.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <string>

namespace pointhaptics
{
namespace trial
{

/// Expects that cut and longer bytes are refused, and that changed ones are or can be finished. @return how
/// many of @p trials changed ones were refused.
inline int refusedOfChanged(const std::string& bytes, int trials)
{
  VoxelAccumulator read{ Lattice() };
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50)
  {
    EXPECT_EQ(VoxelAccumulator::deserialize(bytes.substr(0, size), read), Status::InvalidParameter) << size;
  }
  EXPECT_EQ(VoxelAccumulator::deserialize(bytes + "x", read), Status::InvalidParameter);
  EXPECT_EQ(VoxelAccumulator::deserialize(bytes + "12345678", read), Status::InvalidParameter);
  Random random(9);
  int refused = 0;
  for (int i = 0; i < trials; ++i)
  {
    std::string changed = bytes;
    for (int n = 0; n < 1 + i % 4; ++n)
    {
      // Every third time in the header, every other one by a small number.
      changed[random.below(i % 3 == 0 ? 200 : changed.size())] = char(random.below(i % 2 ? 4 : 256));
    }
    VoxelResampler result;
    const bool isRight = VoxelAccumulator::deserialize(changed, read) == Status::Ok;
    EXPECT_TRUE(!isRight || read.finish({}, result) == Status::Ok);
    refused += !isRight;
  }
  return refused;
}

} // namespace trial
} // namespace pointhaptics
