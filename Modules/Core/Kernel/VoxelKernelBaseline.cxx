/// The loops for every machine: one point at a time, in plain C++.
#include "Core/Kernel/VoxelKernelBody.h"

namespace pointhaptics
{
namespace kernel
{
namespace
{

struct Scalar
{
  static constexpr int width = 1;
  static constexpr unsigned full = 1;
  using Doubles = double;
  using Bits = std::uint64_t;
  using Mask = bool;
  using Shift = int;

  static Doubles all(double value) { return value; }
  static Bits allBits(std::uint64_t value) { return value; }
  static Shift shift(int bits) { return bits; }
  static Mask allTrue() { return true; }
  template <typename Real>
  static void load(const Real* xyz, Doubles& x, Doubles& y, Doubles& z)
  {
    x = double(xyz[0]);
    y = double(xyz[1]);
    z = double(xyz[2]);
  }
  static Doubles add(Doubles a, Doubles b) { return a + b; }
  static Doubles subtract(Doubles a, Doubles b) { return a - b; }
  static Doubles multiply(Doubles a, Doubles b) { return a * b; }
  static Doubles divide(Doubles a, Doubles b, Doubles) { return a / b; }
  static Mask notNegative(Doubles a) { return a >= 0.0; }
  static Mask less(Doubles a, Doubles b) { return a < b; }
  static Mask finite(Doubles a) { return a - a == 0.0; }
  static Mask both(Mask a, Mask b) { return a & b; }
  static unsigned toUnsigned(Mask a) { return a; }
  static Bits floorBits(Doubles u, Doubles magic)
  {
    const double rounded = u + magic;
    std::uint64_t bits;
    __builtin_memcpy(&bits, &rounded, sizeof bits);
    return (bits - (rounded - magic > u)) & kPositionMask;
  }
  static Bits addBits(Bits a, Bits b) { return a + b; }
  static Bits multiply32(Bits a, Bits b) { return a * b; }
  static Bits either(Bits a, Bits b) { return a | b; }
  static Bits right(Bits a, Shift bits) { return a >> bits; }
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
  template <typename Integer>
  static Doubles fromInts(const Integer* from)
  {
    return double(*from);
  }
  template <typename Real>
  static void store(Real* to, Doubles a)
  {
    *to = Real(a);
  }
  static Doubles quotient(Doubles a, Doubles b) { return a / b; }
  static Doubles least(Doubles a, Doubles b) { return b < a ? b : a; }
  static Doubles most(Doubles a, Doubles b) { return b > a ? b : a; }
  static Doubles choose(Mask mask, Doubles a, Doubles b) { return mask ? a : b; }
  static void storeBits(std::uint64_t* to, Bits a) { *to = a; }
  static int slot(int i) { return i; }
  static void storeRecords(Record* to, Bits first, Bits second) { *to = { first, second }; }

  static void cells(const CellMap& map, const Record* records, int count, std::uint32_t* cells)
  {
    for (int i = 0; i < count; ++i)
    {
      cells[i] = cellOf(map, records[i]);
    }
  }

  static std::size_t listBits(std::uint64_t bits, std::uint32_t first, std::uint32_t* cells)
  {
    return kernel::listBits(bits, first, cells);
  }

  struct Adder
  {
    std::uint64_t fractionMask;
    std::uint64_t highMask;

    explicit Adder(int fractionBits)
      : fractionMask((std::uint64_t(1) << fractionBits) - 1)
      , highMask(fractionMask >> kLowBits)
    {
    }
    void add(PackedSums& sums, const Record& r) const
    {
      // Two lanes at once where the compiler knows how.
      const Pair low = { r.first & fractionMask, r.second & fractionMask };
      const Pair high = { r.first >> kPositionBits,
        ((r.second >> kPositionBits) & highMask) + (std::uint64_t(1) << kCountShift) };
      auto* lanes = reinterpret_cast<Pair*>(sums.lanes);
      lanes[0] += low;
      lanes[1] += high;
    }

  private:
    typedef std::uint64_t Pair __attribute__((vector_size(16), may_alias));
  };
};

}

const Kernels& baselineKernels()
{
  static const Kernels kernels = makeKernels<Scalar>();
  return kernels;
}

} // namespace kernel
} // namespace pointhaptics
