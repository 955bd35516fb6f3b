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
  switch (view.type)
  {
    case ScalarType::Float:
      return rangeOfReals<float>(kernels, view, executor);
    case ScalarType::Double:
      return rangeOfReals<double>(kernels, view, executor);
    default:
      return {};
  }
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
void AttributeMean::chooseParts(std::int64_t mostPoints)
{
  const int bits = range_.exponent - range_.lastBit;
  const int sumBits = bitsOf(mostPoints);
  const bool inOne = bits + sumBits <= 63;
  // In several parts there is room for all points of the array: more voxels' points may be added.
  partBits_ = inOne ? bits : std::min(kMostPartBits, 62 - std::max(sumBits, bitsOf(view_.tuples)));
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
    chooseParts(mostPoints);
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
    special_.reserve(size);
    std::fill(special_.data(), special_.data() + size, std::uint8_t(0));
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

/// Copies of tuples, and the voxels they are added to.
struct Terms
{
  const char* first;
  std::size_t stride;
  const std::int64_t* voxels;
  int count;
};

/// Calls add(sum, value) for each number: the sums have @p Lanes words for each of @p Components components,
/// or of @p components where the compiler is not to know.
template <int Lanes, int Components, typename T, typename Add>
void forNumbers(const Terms& terms, int components, std::int64_t* sums, const Add& add)
{
  const int width = Components > 0 ? Components : components;
  for (int i = 0; i < terms.count; ++i)
  {
    const T* value = reinterpret_cast<const T*>(terms.first + terms.stride * std::size_t(i));
    std::int64_t* sum = sums + Lanes * width * terms.voxels[i];
    for (int c = 0; c < width; ++c)
    {
      add(sum + Lanes * c, value[c]);
    }
  }
}
template <int Lanes, typename T, typename Add>
void forNumbers(const Terms& terms, int components, std::int64_t* sums, const Add& add)
{
  components == 3     ? forNumbers<Lanes, 3, T>(terms, components, sums, add)
    : components == 1 ? forNumbers<Lanes, 1, T>(terms, components, sums, add)
                      : forNumbers<Lanes, 0, T>(terms, components, sums, add);
}

}

template <typename Integer>
void AttributeMean::addIntegers(const char* tuples, std::size_t stride, const std::int64_t* voxels, int count)
{
  constexpr int kLanes = sizeof(Integer) == 8 ? 2 : 1;
  forNumbers<kLanes, Integer>({ tuples, stride, voxels, count }, view_.components, sums_.data(),
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

template <typename Real>
void AttributeMean::addReals(const char* first, std::size_t stride, const std::int64_t* voxels, int count)
{
  const int components = view_.components;
  const double scale = scale_[0];
  const double partScale = std::ldexp(1.0, partBits_);
  const bool isPlain = !range_.hasNonFinite && scale_[1] == 1.0;
  if (lanes_ == 1 && isPlain)
  {
    forNumbers<1, Real>({ first, stride, voxels, count }, components, sums_.data(),
      [=](std::int64_t* sum, Real value) { sum[0] += std::int64_t(double(value) * scale); });
    return;
  }
  if (lanes_ == 2 && isPlain)
  {
    forNumbers<2, Real>({ first, stride, voxels, count }, components, sums_.data(),
      [=](std::int64_t* sum, Real value) { addParts(double(value) * scale, partScale, 2, sum); });
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    const Real* value = reinterpret_cast<const Real*>(first + stride * std::size_t(i));
    std::int64_t* sum = sums_.data() + std::int64_t(lanes_) * components * voxels[i];
    for (int c = 0; c < components; ++c)
    {
      if (range_.hasNonFinite && !std::isfinite(value[c]))
      {
        special_[std::size_t(components * voxels[i] + c)] |= std::isnan(value[c]) ? kSawNaN
          : value[c] > Real(0)                                                    ? kSawPlus
                                                                                  : kSawMinus;
      }
      else if (lanes_ == 1)
      {
        sum[c] += std::int64_t(double(value[c]) * scale_[0] * scale_[1]);
      }
      else if (lanes_ <= kMostScaledLanes)
      {
        addParts(double(value[c]) * scale_[0] * scale_[1], partScale, lanes_, sum + lanes_ * c);
      }
      else if (value[c] != Real(0))
      {
        // From the part before the one its first bit is in.
        int exponent;
        std::frexp(double(value[c]), &exponent);
        const int part = std::max(0, (range_.exponent - exponent) / partBits_ - 1);
        const double scaled = std::ldexp(double(value[c]), partBits_ * (part + 1) - range_.exponent);
        addParts(scaled, partScale, lanes_ - part, sum + lanes_ * c + part);
      }
    }
  }
}

void AttributeMean::add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count)
{
  withType(view_.type,
    [&](auto example)
    {
      using T = decltype(example);
      const auto* first = static_cast<const char*>(tuples);
      if constexpr (std::is_floating_point_v<T>)
      {
        addReals<T>(first, stride, voxels, count);
      }
      else
      {
        addIntegers<T>(first, stride, voxels, count);
      }
    });
}

/// Cuts a sum in one part, in units of 2^-bits, into parts.
void AttributeMean::split(std::int64_t sum, int bits, int partBits, std::int64_t* parts)
{
  for (; bits > partBits; bits -= partBits)
  {
    const std::int64_t part = sum >> (bits - partBits);
    *parts++ += part;
    sum -= part * (std::int64_t(1) << (bits - partBits));
  }
  *parts += sum * (std::int64_t(1) << (partBits - bits));
}

void AttributeMean::regroup(
  const std::vector<std::int64_t>& places, std::int64_t voxels, std::int64_t mostPoints)
{
  const Buffer<std::int64_t> fine = std::move(sums_);
  const Buffer<std::uint8_t> fineSpecial = std::move(special_);
  const int bits = partBits_;
  const auto fineLanes = std::size_t(lanes_);
  mostPoints_ = std::max(mostPoints, mostPoints_);
  if (isFloating())
  {
    chooseParts(mostPoints_);
  }
  clear(voxels, Executor());
  const auto components = std::size_t(view_.components);
  const std::size_t width = components * fineLanes;
  const bool splits = fineLanes != std::size_t(lanes_);
  for (std::size_t v = 0; v < places.size(); ++v)
  {
    const auto place = std::size_t(places[v]);
    for (std::size_t c = 0; !splits && c < width; ++c)
    {
      sums_[place * width + c] += fine[v * width + c];
    }
    for (std::size_t c = 0; splits && c < components; ++c)
    {
      split(fine[v * components + c], bits, partBits_,
        sums_.data() + (place * components + c) * std::size_t(lanes_));
    }
    for (std::size_t c = 0; range_.hasNonFinite && c < components; ++c)
    {
      special_[place * components + c] |= fineSpecial[v * components + c];
    }
  }
}

} // namespace pointhaptics
