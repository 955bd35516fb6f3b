/// @file
/// A watcher that remembers what it was told, and what all watchers must be told.
#pragma once

#include "Core/Base/Watcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// Keeps the fractions it hears and ends the work at one of them.
class CountingWatcher : public Watcher
{
public:
  explicit CountingWatcher(std::size_t last = ~std::size_t(0))
    : last_(last)
  {
  }
  bool proceed(double fraction) override
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
