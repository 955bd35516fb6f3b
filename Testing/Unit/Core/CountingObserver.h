/// @file
/// An observer that records the reported progress, and what every sequence of reports must satisfy.
#pragma once

#include "Core/Base/ProgressObserver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// Records the reported fractions and aborts the work at the report of the given number.
class CountingObserver : public ProgressObserver
{
public:
  explicit CountingObserver(std::size_t last = ~std::size_t(0))
    : last_(last)
  {
  }
  bool report(double fraction) override
  {
    fractions.push_back(fraction);
    return fractions.size() < last_;
  }
  std::vector<double> fractions;

private:
  std::size_t last_;
};

inline void expectAscendToOne(const std::vector<double>& fractions, std::size_t atLeast)
{
  ASSERT_GE(fractions.size(), atLeast);
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
}

} // namespace trial
} // namespace pointhaptics
