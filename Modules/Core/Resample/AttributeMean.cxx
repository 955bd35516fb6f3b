#include "Core/Resample/AttributeMean.h"

#include "Core/Resample/Kernel/VoxelKernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <type_traits>

namespace pointhaptics
{
namespace
{

/// With more parts than this the scale alone would push a small value below the smallest double.
constexpr int kMostScaledLanes = 8;
/// Adding and subtracting it rounds to an integer.
constexpr double kRounder = 0x1.8p52;

int bitsOf(std::int64_t count)
{
  int bits = 0;
  while (count >> bits != 0)
  {
    ++bits;
  }
  return bits;
}

/// Calls body(values, count) for the tuples from @p begin to before @p end of a strided array, copied
/// together in pieces that stay in the first cache.
template <typename Real, typename Body>
void forPackedTuples(const AttributeView& view, std::int64_t begin, std::int64_t end, Body&& body)
{
  constexpr std::int64_t kBlock = 2048;
  Real block[kBlock];
  std::int64_t filled = 0;
  const char* from = static_cast<const char*>(view.values) + view.stride * begin;
  for (std::int64_t i = begin; i < end; ++i, from += view.stride)
  {
    for (int component = 0; component < view.components; ++component)
    {
      std::memcpy(block + filled, from + std::size_t(component) * sizeof(Real), sizeof(Real));
      if (++filled == kBlock)
      {
        body(static_cast<const Real*>(block), filled);
        filled = 0;
      }
    }
  }
  if (filled > 0)
  {
    body(static_cast<const Real*>(block), filled);
  }
}

template <typename Real>
AttributeRange rangeOfReals(
  const simd::AttributeKernels& kernels, const AttributeView& view, const Executor& executor)
{
  const auto* values = static_cast<const Real*>(view.values);
  AttributeRange range;
  double largest = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  std::mutex mutex;
  const auto look = [&](const Real* first, std::int64_t count)
  {
    const simd::Magnitudes found = kernels.magnitudes[sizeof(Real) == sizeof(double)](first, count);
    const std::lock_guard<std::mutex> lock(mutex);
    largest = std::max(largest, found.largest);
    smallest = std::min(smallest, found.smallest);
    range.hasNonFinite = range.hasNonFinite || !found.allFinite;
  };
  if (view.stride == 0)
  {
    forRange(executor, view.tuples * view.components,
      [&](std::int64_t begin, std::int64_t end) { look(values + begin, end - begin); });
  }
  else
  {
    forRange(executor, view.tuples,
      [&](std::int64_t begin, std::int64_t end) { forPackedTuples<Real>(view, begin, end, look); });
  }
  if (largest > 0.0)
  {
    int exponent;
    std::frexp(largest, &range.exponent);
    std::frexp(smallest, &exponent);
    range.lastBit = exponent - std::numeric_limits<Real>::digits;
  }
  return range;
}

}

AttributeRange rangeOf(const AttributeView& view, const Executor& executor, InstructionSet instructions)
{
  const simd::AttributeKernels& kernels = simd::kernelsFor(instructions).attributes;
  return view.type == ScalarType::Float ? rangeOfReals<float>(kernels, view, executor)
    : view.type == ScalarType::Double   ? rangeOfReals<double>(kernels, view, executor)
                                        : AttributeRange();
}

AttributeMean::AttributeMean(
  const AttributeView& view, const AttributeRange& range, InstructionSet instructions)
  : view_(view)
  , kernels_(&simd::kernelsFor(instructions).attributes)
  , lanes_(view.type == ScalarType::Int64 || view.type == ScalarType::UInt64 ? 2 : 1)
  , range_(range)
{
}

/// How to cut floating-point numbers.
void AttributeMean::chooseParts()
{
  const int bits = range_.exponent - range_.lastBit;
  const int sumBits = bitsOf(mostPoints_);
  const bool inOne = bits + sumBits <= 63;
  partBits_ = inOne ? bits : std::min(kMostPartBits, 62 - sumBits);
  lanes_ = inOne ? 1 : std::min((bits + partBits_ - 1) / partBits_, kMostLanes);
  // In two factors: for tiny arrays one would overflow.
  const int shift = partBits_ - range_.exponent;
  scale_[0] = std::ldexp(1.0, std::min(shift, 1000));
  scale_[1] = std::ldexp(1.0, std::max(shift - 1000, 0));
}

void AttributeMean::prepare(
  const std::int64_t*, std::int64_t voxels, std::int64_t mostPoints, const Executor& executor)
{
  mostPoints_ = mostPoints;
  if (isFloating())
  {
    chooseParts();
  }
  clear(voxels, executor);
}

void AttributeMean::clear(std::int64_t voxels, const Executor& executor)
{
  voxels_ = voxels;
  const std::size_t size = std::size_t(voxels) * std::size_t(view_.components);
  sums_.reserve(size * std::size_t(lanes_), Pages::Huge);
  forRange(executor, std::int64_t(size) * lanes_,
    [this](std::int64_t begin, std::int64_t end) { std::fill(sums_.data() + begin, sums_.data() + end, 0); });
  if (range_.hasNonFinite)
  {
    nonFinite_.reserve(size);
    std::fill(nonFinite_.data(), nonFinite_.data() + size, NonFiniteCount());
  }
}

namespace
{

/// The integer a number was rounded to by adding kRounder, read from the bits of the sum.
inline std::int64_t roundedInteger(double sum)
{
  std::int64_t bits;
  std::int64_t rounder;
  const double zero = kRounder;
  std::memcpy(&bits, &sum, sizeof bits);
  std::memcpy(&rounder, &zero, sizeof rounder);
  return bits - rounder;
}

/// Adds the parts of a number that is in units of the first.
inline void addParts(double scaled, double partScale, int parts, std::int64_t* sums)
{
  for (int part = 0; part < parts; ++part)
  {
    const double shifted = scaled + kRounder;
    sums[part] += roundedInteger(shifted);
    scaled = (scaled - (shifted - kRounder)) * partScale;
  }
}

/// Tuples of points, and the voxels they are added to.
struct Terms
{
  const AttributeView& view;
  const std::int64_t* points;
  const std::int64_t* voxels;
  int count;
};

/// Fields of a packed record are not aligned.
template <typename T>
T numberOf(const char* tuple, int component)
{
  T number;
  std::memcpy(&number, tuple + std::size_t(component) * sizeof(T), sizeof number);
  return number;
}

/// Calls add(sum, value) for each number: the sums have @p Lanes words for each of @p Components components,
/// or of the view's where the compiler is not to know.
template <int Lanes, int Components, typename T, typename Add>
void forNumbers(const Terms& terms, std::int64_t* sums, const Add& add)
{
  const int width = Components > 0 ? Components : terms.view.components;
  const auto* const first = static_cast<const char*>(terms.view.values);
  const std::int64_t step = terms.view.step();
  for (int i = 0; i < terms.count; ++i)
  {
    const char* const tuple = first + step * terms.points[i];
    std::int64_t* sum = sums + Lanes * width * terms.voxels[i];
    for (int c = 0; c < width; ++c)
    {
      add(sum + Lanes * c, numberOf<T>(tuple, c));
    }
  }
}
template <int Lanes, typename T, typename Add>
void forNumbers(const Terms& terms, std::int64_t* sums, const Add& add)
{
  terms.view.components == 3     ? forNumbers<Lanes, 3, T>(terms, sums, add)
    : terms.view.components == 1 ? forNumbers<Lanes, 1, T>(terms, sums, add)
                                 : forNumbers<Lanes, 0, T>(terms, sums, add);
}

}

template <typename Integer>
void AttributeMean::addIntegers(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  constexpr int kLanes = sizeof(Integer) == 8 ? 2 : 1;
  forNumbers<kLanes, Integer>({ view_, points, voxels, count }, sums_.data(),
    [](std::int64_t* sum, Integer value)
    {
      if constexpr (kLanes == 2)
      {
        // High and low halves: the low one is not negative.
        sum[0] += std::int64_t(value >> 32);
        sum[1] += std::int64_t(value & Integer(0xffffffff));
      }
      else
      {
        sum[0] += value;
      }
    });
}

/// Adds a number in as many parts as there are, and if it is not finite. @p place: of its component.
template <typename Real>
void AttributeMean::addInParts(Real value, std::int64_t place)
{
  const double partScale = std::ldexp(1.0, partBits_);
  std::int64_t* const sum = sums_.data() + lanes_ * place;
  if (range_.hasNonFinite && !std::isfinite(value))
  {
    NonFiniteCount& seen = nonFinite_[std::size_t(place)];
    ++(std::isnan(value) ? seen.nans : value > Real(0) ? seen.plus : seen.minus);
  }
  else if (lanes_ == 1)
  {
    *sum += std::int64_t(double(value) * scale_[0] * scale_[1]);
  }
  else if (lanes_ <= kMostScaledLanes)
  {
    addParts(double(value) * scale_[0] * scale_[1], partScale, lanes_, sum);
  }
  else if (value != Real(0))
  {
    // From the part before the one its first bit is in.
    int exponent;
    std::frexp(double(value), &exponent);
    const int part = std::max(0, (range_.exponent - exponent) / partBits_ - 1);
    const double scaled = std::ldexp(double(value), partBits_ * (part + 1) - range_.exponent);
    addParts(scaled, partScale, lanes_ - part, sum + part);
  }
}

template <typename Real>
void AttributeMean::addReals(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  const Terms terms = { view_, points, voxels, count };
  const double scale = scale_[0];
  const bool isPlain = !range_.hasNonFinite && scale_[1] == 1.0;
  if (lanes_ == 1 && isPlain)
  {
    forNumbers<1, Real>(terms, sums_.data(),
      [=](std::int64_t* sum, Real value) { sum[0] += std::int64_t(double(value) * scale); });
  }
  else if (lanes_ == 2 && isPlain)
  {
    const double partScale = std::ldexp(1.0, partBits_);
    forNumbers<2, Real>(terms, sums_.data(),
      [=](std::int64_t* sum, Real value) { addParts(double(value) * scale, partScale, 2, sum); });
  }
  else
  {
    for (int i = 0; i < count; ++i)
    {
      const char* const tuple = view_.tuple(points[i]);
      for (int c = 0; c < view_.components; ++c)
      {
        addInParts(numberOf<Real>(tuple, c), view_.components * voxels[i] + c);
      }
    }
  }
}

void AttributeMean::add(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  withType(view_.type,
    [&](auto example)
    {
      using T = decltype(example);
      if constexpr (std::is_floating_point_v<T>)
      {
        addReals<T>(points, voxels, count);
      }
      else
      {
        addIntegers<T>(points, voxels, count);
      }
    });
}

void AttributeMean::regroup(const std::vector<std::int64_t>& parents, std::int64_t voxels)
{
  const Buffer<std::int64_t> fine = std::move(sums_);
  const Buffer<NonFiniteCount> fineNonFinite = std::move(nonFinite_);
  clear(voxels, Executor());
  const auto components = std::size_t(view_.components);
  const std::size_t width = components * std::size_t(lanes_);
  for (std::size_t v = 0; v < parents.size(); ++v)
  {
    const auto parent = std::size_t(parents[v]);
    for (std::size_t c = 0; c < width; ++c)
    {
      sums_[parent * width + c] += fine[v * width + c];
    }
    for (std::size_t c = 0; range_.hasNonFinite && c < components; ++c)
    {
      NonFiniteCount& seen = nonFinite_[parent * components + c];
      const NonFiniteCount& more = fineNonFinite[v * components + c];
      seen = { seen.nans + more.nans, seen.plus + more.plus, seen.minus + more.minus };
    }
  }
}

} // namespace pointhaptics
