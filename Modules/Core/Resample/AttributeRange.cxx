#include "Core/Resample/AttributeView.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>

namespace pointhaptics
{
namespace
{

/// Bits without the sign ascend with the magnitude, infinities and NaN above all.
template <typename Real, typename Bits>
AttributeRange rangeOfReals(const AttributeView& view, const Executor& executor)
{
  constexpr Bits kMagnitude = ~(Bits(1) << (8 * sizeof(Bits) - 1));
  const auto numberOf = [](Bits bits)
  {
    Real value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  Bits infinite;
  const Real infinity = std::numeric_limits<Real>::infinity();
  std::memcpy(&infinite, &infinity, sizeof infinite);
  std::mutex mutex;
  Bits largest = 0;
  Bits leastLessOne = infinite - 1; // Zero becomes the largest of all.
  Bits above = 0;
  forRange(executor, view.tuples,
    [&](std::int64_t begin, std::int64_t end)
    {
      Bits ends[3] = { 0, infinite - 1, 0 };
      const std::int64_t together = view.stride == 0 ? end - begin : 1;
      for (std::int64_t i = begin; i < end; i += together)
      {
        const char* from = view.tuple(i);
        const char* const last = from + together * view.tupleBytes();
        for (; from != last; from += sizeof(Bits))
        {
          Bits bits;
          std::memcpy(&bits, from, sizeof bits);
          bits &= kMagnitude;
          ends[0] = std::max(ends[0], bits < infinite ? bits : Bits(0));
          ends[1] = std::min(ends[1], Bits(bits - 1));
          ends[2] = std::max(ends[2], bits);
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      largest = std::max(largest, ends[0]);
      leastLessOne = std::min(leastLessOne, ends[1]);
      above = std::max(above, ends[2]);
    });
  AttributeRange range;
  range.hasNonFinite = above >= infinite;
  if (largest > 0)
  {
    int exponent;
    std::frexp(numberOf(largest), &range.exponent);
    std::frexp(numberOf(leastLessOne + 1), &exponent);
    range.lastBit = exponent - std::numeric_limits<Real>::digits;
  }
  return range;
}

}

AttributeRange rangeOf(const AttributeView& view, const Executor& executor)
{
  return view.type == ScalarType::Float ? rangeOfReals<float, std::uint32_t>(view, executor)
    : view.type == ScalarType::Double   ? rangeOfReals<double, std::uint64_t>(view, executor)
                                        : AttributeRange();
}

} // namespace pointhaptics
