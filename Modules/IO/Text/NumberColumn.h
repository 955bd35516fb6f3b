/// @file
/// The value range of one column of a text, which determines the type of its array.
#pragma once

#include "IO/Text/TextScan.h"

#include "vtkType.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace pointhaptics::io
{

/// Summarises the numbers that were added; stores none. Integers beyond 2^53 lose their last digits.
class NumberColumn
{
public:
  void add(double value, NumberShape shape)
  {
    fitsFloat_ = fitsFloat_ && shape.fitsFloat;
    isInteger_ = isInteger_ && shape.isInteger;
    smallest_ = std::min(smallest_, value);
    largest_ = std::max(largest_, value);
  }
  /// A cell without a number reads as NaN.
  void addEmpty()
  {
    isInteger_ = false;
    ++empty_;
  }
  /// Adds all that were added to @p other.
  void add(const NumberColumn& other)
  {
    fitsFloat_ = fitsFloat_ && other.fitsFloat_;
    isInteger_ = isInteger_ && other.isInteger_;
    smallest_ = std::min(smallest_, other.smallest_);
    largest_ = std::max(largest_, other.largest_);
    empty_ += other.empty_;
  }
  /// True if all are integers in 0..@p most.
  bool isInteger(double most) const { return isInteger_ && smallest_ >= 0.0 && largest_ <= most; }
  /// True if all are written without a point.
  bool isWhole() const { return isInteger_; }
  /// True if whole numbers are so large that doubles cannot hold each of them.
  bool losesDigits() const { return isInteger_ && std::max(largest_, -smallest_) >= 0x1p53; }
  double smallest() const { return smallest_; }
  double largest() const { return largest_; }
  /// How often addEmpty() was called.
  std::int64_t empty() const { return empty_; }
  /// VTK_FLOAT when a float keeps every digit, else VTK_DOUBLE.
  int floatingType() const { return fitsFloat_ ? VTK_FLOAT : VTK_DOUBLE; }
  /// VTK_INT for integers that fit it, else floatingType().
  int type() const
  {
    const bool fitsInt =
      smallest_ >= std::numeric_limits<int>::min() && largest_ <= std::numeric_limits<int>::max();
    return isInteger_ && fitsInt ? VTK_INT : floatingType();
  }

private:
  bool fitsFloat_ = true;
  bool isInteger_ = true;
  double smallest_ = std::numeric_limits<double>::infinity();
  double largest_ = -std::numeric_limits<double>::infinity();
  std::int64_t empty_ = 0;
};

} // namespace pointhaptics::io
