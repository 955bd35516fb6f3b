/// @file
/// The encoding half of LAZ's arithmetic coder: see ArithmeticDecoder.h.
#pragma once

#include "IO/Las/Laz/SymbolModel.h"

#include <string>
#include <utility>

namespace pointhaptics::io
{

/// Collects the stream in memory. One thread.
class ArithmeticEncoder
{
public:
  static constexpr bool kEncodes = true;

  unsigned symbol(SymbolModel& model, unsigned value)
  {
    model.startIfNew();
    const std::uint32_t step = length_ >> SymbolModel::kProbabilityBits;
    const std::uint32_t low = model.below(value) * step;
    length_ = (value == model.lastSymbol() ? length_ : model.below(value + 1) * step) - low;
    raise(low);
    model.count(value);
    return value;
  }
  unsigned bit(BitModel& model, unsigned value)
  {
    const std::uint32_t zero = model.zeroProbability() * (length_ >> BitModel::kProbabilityBits);
    length_ = value != 0 ? length_ - zero : zero;
    raise(value != 0 ? zero : 0);
    model.count(value);
    return value;
  }
  std::uint32_t bits(unsigned count, std::uint32_t value)
  {
    constexpr unsigned kMostAtOnce = 19;
    if (count > kMostAtOnce)
    {
      bits(16, value & 0xffff);
      bits(count - 16, value >> 16);
      return value;
    }
    length_ >>= count;
    raise(value * length_);
    return value;
  }
  void markDamaged() {}

  /// Ends the stream and hands it over: a decoder that reads it to its end has then read all its bytes.
  std::string finish()
  {
    const bool isLong = length_ > 2 * kShortest;
    length_ = isLong ? kShortest >> 1 : kShortest >> 9;
    raise(isLong ? kShortest : kShortest >> 1);
    bytes_.append(isLong ? 3 : 2, '\0');
    return std::move(bytes_);
  }

private:
  /// Moves the lower end of the interval; a carry goes into the bytes that are written.
  void raise(std::uint32_t by)
  {
    base_ += by;
    if (base_ < by)
    {
      std::size_t at = bytes_.size() - 1;
      for (; bytes_[at] == '\xff'; --at)
      {
        bytes_[at] = '\0';
      }
      ++bytes_[at];
    }
    while (length_ < kShortest)
    {
      bytes_ += static_cast<char>(base_ >> 24);
      base_ <<= 8;
      length_ <<= 8;
    }
  }

  static constexpr std::uint32_t kShortest = 1u << 24;

  std::uint32_t base_ = 0;
  std::uint32_t length_ = 0xffffffffu;
  std::string bytes_;
};

} // namespace pointhaptics::io
