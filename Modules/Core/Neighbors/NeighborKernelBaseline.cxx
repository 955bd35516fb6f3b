/// The loops for every machine: one number at a time.
#include "Core/Neighbors/NeighborKernelBody.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

struct Scalar
{
  static constexpr int width = 1;
  using Doubles = double;
  using Counts = std::int64_t;
  using Mask = bool;

  static Doubles all(double value) { return value; }
  static Doubles load(const double* from) { return *from; }
  static void store(double* to, Doubles values) { *to = values; }
  static Doubles add(Doubles a, Doubles b) { return a + b; }
  static Doubles subtract(Doubles a, Doubles b) { return a - b; }
  static Doubles multiply(Doubles a, Doubles b) { return a * b; }
  static Doubles maximum(Doubles a, Doubles b) { return a > b ? a : b; }
  static Mask atMost(Doubles a, Doubles b) { return a <= b; }
  static unsigned bits(Mask mask) { return mask; }
  static void compress(double* to, unsigned, Doubles values) { *to = values; }
  static void lanes(std::uint32_t* to, unsigned, std::uint32_t first) { *to = first; }
  static Counts none() { return 0; }
  static Counts countLess(Counts counts, Doubles a, Doubles b) { return counts + (a < b); }
  static void store(std::int64_t* to, Counts counts) { *to = counts; }
};

}

const NeighborKernels& baselineNeighborKernels()
{
  static const NeighborKernels kernels = makeNeighborKernels<Scalar>();
  return kernels;
}

const NeighborKernels& neighborKernels(InstructionSet wanted) noexcept
{
  return loopsFor(wanted, baselineNeighborKernels, avx2NeighborKernels, avx512NeighborKernels);
}

} // namespace simd
} // namespace pointhaptics
