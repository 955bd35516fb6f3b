/// @file
/// A column of decimal numbers from a text, which remembers what type they need.
#pragma once

#include "TextScan.h"

#include "vtkType.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

/// Integers beyond 2^53 lose their last digits.
class DecimalColumn
{
public:
  /// Appends the number @p value, written as @p word.
  void add(std::string_view word, double value)
  {
    fitsFloat_ = fitsFloat_ && fitsFloat(word, value);
    isInteger_ = isInteger_ && word.find_first_of(".eEnN") == std::string_view::npos;
    if (isInteger_)
    {
      smallest_ = std::min(smallest_, value);
      largest_ = std::max(largest_, value);
    }
    values_.push_back(value);
  }
  const std::vector<double>& values() const { return values_; }
  bool isInteger() const { return isInteger_; }
  /// Whether all are integers in 0..255.
  bool isByte() const { return isInteger_ && smallest_ >= 0.0 && largest_ <= 255.0; }
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
  std::vector<double> values_;
  bool fitsFloat_ = true;
  bool isInteger_ = true;
  double smallest_ = std::numeric_limits<double>::infinity();
  double largest_ = -std::numeric_limits<double>::infinity();
};

} // namespace pointhaptics::io
