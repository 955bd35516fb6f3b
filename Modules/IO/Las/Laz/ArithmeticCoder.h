/// @file
/// LAZ's arithmetic coder. Source: A. Said, Introduction to Arithmetic Coding
/// (HPL-2004-76): 32-bit interval, renormalised by bytes, as LASzip uses it.
///
/// Decoder and encoder have the same functions, so that what is coded is described once, by a template over
/// the coder: each function takes the value to encode, and gives back the value of this place of the stream.
#pragma once

#include "IO/Las/Laz/SymbolModel.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace pointhaptics::io
{

/// Reads beyond its bytes give zeros and are counted; no stream, however damaged, makes it leave them or the
/// tables of a model. One thread.
class ArithmeticDecoder
{
public:
  static constexpr bool kEncodes = false;

  ArithmeticDecoder() = default;
  /// @p bytes must outlive this object.
  explicit ArithmeticDecoder(std::string_view bytes)
    : at_(reinterpret_cast<const unsigned char*>(bytes.data()))
    , end_(at_ + bytes.size())
    , begin_(at_)
  {
    for (int i = 0; i < 4; ++i)
    {
      value_ = value_ << 8 | nextByte();
    }
    value_ -= value_ == length_ ? 1 : 0; // no encoder writes it; below, value < length always
  }

  unsigned symbol(SymbolModel& model, unsigned = 0)
  {
    model.startIfNew();
    const std::uint32_t step = length_ >> SymbolModel::kProbabilityBits;
    const unsigned last = model.lastSymbol();
    unsigned found;
    if (model.hasTable())
    {
      found = model.find(value_ / step);
    }
    else
    {
      found = 0;
      for (unsigned end = last + 1; end > found + 1;)
      {
        const unsigned middle = (found + end) >> 1;
        (model.below(middle) * step > value_ ? end : found) = middle;
      }
    }
    const std::uint32_t low = model.below(found) * step;
    value_ -= low;
    length_ = (found == last ? length_ : model.below(found + 1) * step) - low;
    renormalise();
    model.count(found);
    return found;
  }

  unsigned bit(BitModel& model, unsigned = 0)
  {
    const std::uint32_t zero = model.zeroProbability() * (length_ >> BitModel::kProbabilityBits);
    const unsigned found = value_ >= zero ? 1 : 0;
    value_ -= found != 0 ? zero : 0;
    length_ = found != 0 ? length_ - zero : zero;
    renormalise();
    model.count(found);
    return found;
  }

  /// @p count equally likely bits, 1..32.
  std::uint32_t bits(unsigned count, std::uint32_t = 0)
  {
    constexpr unsigned kMostAtOnce = 19;
    if (count > kMostAtOnce)
    {
      const std::uint32_t low = bits(16);
      return bits(count - 16) << 16 | low;
    }
    length_ >>= count;
    const std::uint32_t found = value_ / length_;
    value_ -= found * length_;
    renormalise();
    return found & ((1u << count) - 1); // more than that in damaged streams only
  }

  /// Marks the stream as one that no encoder writes.
  void markDamaged() { isDamaged_ = true; }
  /// True if more bytes were asked for than there are, or markDamaged() was called.
  bool isDamaged() const { return isDamaged_ || missing_ > 0; }
  /// Bytes read so far: where a stream that is read to its end has its end.
  std::size_t position() const { return static_cast<std::size_t>(at_ - begin_); }

private:
  std::uint32_t nextByte()
  {
    if (at_ != end_)
    {
      return *at_++;
    }
    ++missing_;
    return 0;
  }
  void renormalise()
  {
    while (length_ < kShortest)
    {
      value_ = value_ << 8 | nextByte();
      length_ <<= 8;
    }
  }

  static constexpr std::uint32_t kShortest = 1u << 24;

  const unsigned char* at_ = nullptr;
  const unsigned char* end_ = nullptr;
  const unsigned char* begin_ = nullptr;
  std::uint32_t value_ = 0;
  std::uint32_t length_ = 0xffffffffu;
  std::uint64_t missing_ = 0;
  bool isDamaged_ = false;
};

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
