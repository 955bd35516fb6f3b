/// The loops for every machine: two points at a time, in vectors that the compiler knows everywhere.
#include "Core/Resample/Kernel/VoxelKernelBody.h"

#include <cmath>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace pointhaptics
{
namespace simd
{
namespace
{

typedef double DoublePair __attribute__((vector_size(16)));
typedef std::int64_t IntPair __attribute__((vector_size(16)));
typedef std::uint64_t BitPair __attribute__((vector_size(16)));

struct Pairs
{
  static constexpr int width = 2;
  static constexpr unsigned full = 3;
  using Doubles = DoublePair;
  using Bits = BitPair;
  using Mask = IntPair;
  using Shift = int;
  static constexpr bool hasFusedMultiply = false;
  static constexpr bool countsOnes = false;
  static constexpr int groupsTogether = 1;
  static constexpr int quantizedAtOnce = 256;
  static constexpr int binnedPerTurn = 16;
  static constexpr bool binsMeanwhile = false;

  static Doubles all(double value) { return Doubles{ value, value }; }
  static Bits allBits(std::uint64_t value) { return Bits{ value, value }; }
  static Shift shift(int bits) { return bits; }
  static Mask allTrue() { return Mask{ -1, -1 }; }
  template <typename Real>
  static void load(const Real* xyz, Doubles& x, Doubles& y, Doubles& z)
  {
    x = Doubles{ double(xyz[0]), double(xyz[3]) };
    y = Doubles{ double(xyz[1]), double(xyz[4]) };
    z = Doubles{ double(xyz[2]), double(xyz[5]) };
  }
  static Doubles add(Doubles a, Doubles b) { return a + b; }
  static Doubles subtract(Doubles a, Doubles b) { return a - b; }
  static Doubles multiply(Doubles a, Doubles b) { return a * b; }
  static Doubles multiplyAdd(Doubles a, Doubles b, Doubles c) { return a * b + c; }
  /// a b - product, rounded once.
  static Doubles multiplyRest(Doubles a, Doubles b, Doubles product)
  {
    return Doubles{ std::fma(a[0], b[0], -product[0]), std::fma(a[1], b[1], -product[1]) };
  }
  /// 0 <= a < limit, a not -0: what that is the quotient of is below 0. Only the signs of a mask count. GCC
  /// takes the plain form for a number of each, and apart.
  static Mask below(Mask given, Doubles a, Doubles limit)
  {
#if defined(__SSE2__)
    return given & reinterpret_cast<Mask>(_mm_andnot_pd(a, _mm_cmplt_pd(a, limit)));
#else
    return given & ~reinterpret_cast<Mask>(a) & (a < limit);
#endif
  }
  static Mask finite(Doubles a)
  {
    return a - a == 0.0;
  }
  static Mask both(Mask a, Mask b)
  {
    return a & b;
  }
  static unsigned toUnsigned(Mask a)
  {
#if defined(__SSE2__)
    return unsigned(_mm_movemask_pd(reinterpret_cast<__m128d>(a)));
#else
    return unsigned(a[0] < 0) | unsigned(a[1] < 0) << 1;
#endif
  }
  static Bits floorBits(Doubles u)
  {
    const Doubles rounded = u + kToBits;
    // A true comparison is -1.
    const Mask above = rounded - kToBits > u;
    return reinterpret_cast<Bits>(rounded) + reinterpret_cast<Bits>(above);
  }
  static Bits addBits(Bits a, Bits b)
  {
    return a + b;
  }
  static Bits multiply32(Bits a, Bits b)
  {
    return Bits{ a[0] * b[0], a[1] * b[1] };
  }
  static Bits onlyPosition(Bits a)
  {
    return a & kPositionMask;
  }
  static Bits withLowBits(Bits high, Bits a)
  {
    return high | (a & kLowMask);
  }
  static Bits right(Bits a, Shift bits)
  {
    return a >> bits;
  }
  template <int bits>
  static Bits rightBy(Bits a)
  {
    return a >> bits;
  }
  template <int bits>
  static Bits left(Bits a)
  {
    return a << bits;
  }
  /// Not negative. The halves are put below and above 2^52 and 2^84; only their sum is rounded.
  static Doubles toDoubles(Bits value)
  {
    const Bits low = (value & 0xFFFFFFFFu) | std::uint64_t(0x4330000000000000);
    const Bits high = (value >> 32) | std::uint64_t(0x4530000000000000);
    return (reinterpret_cast<Doubles>(high) - (0x1p84 + 0x1p52)) + reinterpret_cast<Doubles>(low);
  }
  static Doubles smallToDoubles(Bits value)
  {
    return reinterpret_cast<Doubles>(value | std::uint64_t(0x4330000000000000)) - kToBits;
  }
  static constexpr bool areSmall(const Bits*)
  {
    return false; // To ask is not worth it.
  }
  static Doubles fromInts(const std::int64_t* from)
  {
    return toDoubles(Bits{ std::uint64_t(from[0]), std::uint64_t(from[1]) });
  }
  static Doubles fromInts(const std::int32_t* from)
  {
    return Doubles{ double(from[0]), double(from[1]) };
  }
  static void store(double* to, Doubles a)
  {
    to[0] = a[0];
    to[1] = a[1];
  }
  template <typename Real>
  static void storeInterleaved(Real* to, const Doubles xyz[3])
  {
    for (int i = 0; i < 3 * width; ++i)
    {
      to[i] = Real(xyz[i % 3][i / 3]);
    }
  }
  static Doubles quotient(Doubles a, Doubles b)
  {
    return a / b;
  }
  /// Of what is far below 2^51: adding so much leaves no room for a fraction.
  static Doubles nearest(Doubles a)
  {
    return (a + 0x1.8p52) - 0x1.8p52;
  }
  static Doubles least(Doubles a, Doubles b)
  {
    return b < a ? b : a;
  }
  static Doubles most(Doubles a, Doubles b)
  {
    return b > a ? b : a;
  }
  static Doubles choose(Mask mask, Doubles a, Doubles b)
  {
    return mask ? a : b;
  }
  static void store(std::uint64_t* to, Bits a)
  {
    to[0] = a[0];
    to[1] = a[1];
  }
  static void storeRecords(PointRecord* to, Bits first, Bits second)
  {
    to[0] = { first[0], second[0] };
    to[1] = { first[1], second[1] };
  }
  static void storeCounts(std::int64_t* to, Bits counts)
  {
    to[0] = std::int64_t(counts[0]);
    to[1] = std::int64_t(counts[1]);
  }
  static void loadPacked(const PackedSums* from, Bits lanes[4])
  {
    for (int lane = 0; lane < 4; ++lane)
    {
      lanes[lane] = Bits{ from[0].lanes[lane], from[1].lanes[lane] };
    }
  }
  static std::uint32_t rankWords(const CellRanks& ranks)
  {
    constexpr std::size_t kGroup = 8;
    static_assert(kOccupancyGroup % kGroup == 0, "there are no words past the last group");
    std::uint32_t sum = 0;
    for (std::size_t group = 0; group < ranks.words; group += kGroup)
    {
      std::uint64_t upToBytes[kGroup]; // In a loop of its own, which the compiler makes one of vectors.
      for (std::size_t w = 0; w < kGroup; ++w)
      {
        upToBytes[w] = onesUpToBytes(ranks.occupancy[group + w]);
      }
      for (std::size_t w = 0; w < kGroup; ++w)
      {
        ranks.rankTable[group + w] = sum;
        ranks.byteRankTable[group + w] = upToBytes[w] << 8;
        sum += std::uint32_t(upToBytes[w] >> 56);
      }
    }
    return sum;
  }

  template <bool inLayer>
  static void cells(const CellMap& given, const PointRecord* records, int count, std::uint32_t* cells)
  {
    const CellMap map = given; // A copy, which no store can change.
    for (int i = 0; i < count; ++i)
    {
      cells[i] = cellOf<inLayer>(map, records[i]);
    }
  }

  static int covariances(const CovarianceMap& map, const PackedSums* sums,
    const SplitSecondMoments* secondMoments, int count, double* covariances, int* full)
  {
    for (int i = 0; i < count; ++i)
    {
      covariance(map, sums[i], secondMoments[i], covariances + 6 * i);
    }
    return listFull(map, sums, count, full);
  }

  using ProductAdder = ScalarProductAdder;
  /// Two lanes at once where the compiler knows how.
  struct Adder
  {
    typedef std::uint64_t Pair __attribute__((vector_size(16), may_alias));
    Pair fractions;
    Pair partsOfZ;

    explicit Adder(int fractionBits)
    {
      const std::uint64_t fraction = (std::uint64_t(1) << fractionBits) - 1;
      fractions = Pair{ fraction, fraction };
      partsOfZ = Pair{ kLowMask, fraction >> kLowBits };
    }
    void add(PackedSums& sums, const PointRecord& r) const
    {
      const Pair words = reinterpret_cast<const Pair&>(r);
      auto* lanes = reinterpret_cast<Pair*>(sums.lanes);
      lanes[0] += (words >> kLowBits) & fractions;
      lanes[1] += (words & partsOfZ) + Pair{ 0, std::uint64_t(1) << kCountShift };
    }
  };
};

}

const Kernels& baselineKernels()
{
  static const Kernels kernels = makeKernels<Pairs>();
  return kernels;
}

const Kernels& kernelsFor(InstructionSet wanted)
{
  switch (usableInstructionSet(wanted))
  {
    case InstructionSet::Avx512:
      return *avx512Kernels();
    case InstructionSet::Avx2:
      return *avx2Kernels();
    default:
      return baselineKernels();
  }
}

} // namespace simd
} // namespace pointhaptics
