/// @file
/// Coding of integers as the difference from a prediction: first its number of bits, then its place among the
/// differences of as many bits; of large ones the lower bits as they are. Source: LASzip's published format
/// (M. Isenburg, LASzip: lossless compression of LiDAR data, 2013).
#pragma once

#include "IO/Las/Laz/SymbolModel.h"

#include <cstdint>
#include <vector>

namespace pointhaptics::io
{

/// Codes a number of 64 equally likely bits.
template <typename Coder>
std::uint64_t codeInt64(Coder& coder, std::uint64_t value)
{
  const std::uint64_t low = coder.bits(32, static_cast<std::uint32_t>(value));
  return std::uint64_t{ coder.bits(32, static_cast<std::uint32_t>(value >> 32)) } << 32 | low;
}

/// Integers of @p bits bits (8, 16 or 32) with models for each of @p contexts contexts. One thread.
class IntegerModels
{
public:
  IntegerModels(unsigned bits, unsigned contexts)
    : bits_(bits)
    , lengths_(contexts, bits + 1)
  {
    for (unsigned i = 1; i <= bits; ++i)
    {
      places_.emplace_back(1u << (i < kModelledBits ? i : kModelledBits));
    }
  }
  /// Number of bits of the difference that was coded last, 0..32: a context for what comes next.
  unsigned lengthOfLast() const { return length_; }

  /// Codes @p value, of which @p predicted is known; returns the value. Numbers of fewer than 32 bits are
  /// 0..2^bits-1 where predicted is.
  template <typename Coder>
  std::int32_t code(Coder& coder, std::int32_t predicted, std::int32_t value, unsigned context = 0)
  {
    const std::uint32_t start = static_cast<std::uint32_t>(predicted);
    std::uint32_t difference = 0;
    if constexpr (Coder::kEncodes)
    {
      difference = folded(static_cast<std::uint32_t>(value) - start);
    }
    const std::int32_t result =
      static_cast<std::int32_t>(start + codeDifference(coder, difference, lengths_[context]));
    if (bits_ == 32)
    {
      return result;
    }
    const std::int32_t range = std::int32_t{ 1 } << bits_;
    return result < 0 ? result + range : result >= range ? result - range : result;
  }

private:
  static constexpr unsigned kModelledBits = 8;

  /// The difference modulo 2^bits that is nearest to 0.
  std::uint32_t folded(std::uint32_t difference) const
  {
    const unsigned unused = 32 - bits_;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(difference << unused) >> unused);
  }
  static unsigned lengthOf(std::uint32_t difference)
  {
    // k bits are for -(2^k - 1) .. 2^k, less those of fewer bits.
    std::uint32_t size = (difference >> 31) != 0 || difference == 0 ? 0u - difference : difference - 1;
    unsigned length = 0;
    for (; size != 0; size >>= 1)
    {
      ++length;
    }
    return length;
  }

  template <typename Coder>
  std::uint32_t codeDifference(Coder& coder, std::uint32_t difference, SymbolModel& lengths)
  {
    length_ = coder.symbol(lengths, Coder::kEncodes ? lengthOf(difference) : 0);
    if (length_ == 0)
    {
      return coder.bit(zeroOrOne_, difference);
    }
    if (length_ == 32)
    {
      return 0x80000000u;
    }
    // Negative ones first: -(2^k - 1) is place 0.
    const std::uint32_t shift = (1u << length_) - 1;
    std::uint32_t place = (difference >> 31) != 0 ? difference + shift : difference - 1;
    SymbolModel& places = places_[length_ - 1];
    if (length_ <= kModelledBits)
    {
      place = coder.symbol(places, place);
    }
    else
    {
      const unsigned low = length_ - kModelledBits;
      const std::uint32_t high = coder.symbol(places, place >> low);
      place = high << low | coder.bits(low, place & ((1u << low) - 1));
    }
    return place >> (length_ - 1) != 0 ? place + 1 : place - shift;
  }

  unsigned bits_;
  unsigned length_ = 0;
  ModelBank lengths_;
  BitModel zeroOrOne_;
  std::vector<SymbolModel> places_;
};

} // namespace pointhaptics::io
