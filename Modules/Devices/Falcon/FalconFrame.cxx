#include "Devices/Falcon/FalconFrame.h"

namespace pointhaptics
{
namespace
{
constexpr std::uint8_t kBegin = '<';
constexpr std::uint8_t kEnd = '>';
/// Added to each value, so that no value looks like one of the two marks.
constexpr std::uint8_t kOffset = 'A';
constexpr int kNibbles = 4;
constexpr int kFlags = 13;
constexpr int kUnknown = 14;
constexpr int kLast = kFalconFrameSize - 1;
constexpr std::uint8_t kLargestNibble = 15;
constexpr std::uint8_t kLargestFlags = 127;

void putWord(FalconFrame& frame, int leg, std::int16_t word) noexcept
{
  for (int nibble = 0; nibble < kNibbles; ++nibble)
  {
    const unsigned value = (unsigned(std::uint16_t(word)) >> (4 * nibble)) & kLargestNibble;
    frame[std::size_t(1 + kNibbles * leg + nibble)] = std::uint8_t(value + kOffset);
  }
}

std::int16_t word(const FalconFrame& frame, int leg) noexcept
{
  unsigned value = 0;
  for (int nibble = 0; nibble < kNibbles; ++nibble)
  {
    value |= unsigned(frame[std::size_t(1 + kNibbles * leg + nibble)] - kOffset) << (4 * nibble);
  }
  return std::int16_t(std::uint16_t(value));
}

bool fits(std::uint8_t byte, int place) noexcept
{
  if (place == 0 || place == kLast)
  {
    return byte == (place == 0 ? kBegin : kEnd);
  }
  if (place == kUnknown)
  {
    return byte != kBegin;
  }
  const std::uint8_t largest = place == kFlags ? kLargestFlags : kLargestNibble;
  return byte >= kOffset && byte <= kOffset + largest;
}

bool fits(const FalconFrame& frame) noexcept
{
  bool result = true;
  for (int place = 0; place < kFalconFrameSize; ++place)
  {
    result = result && fits(frame[std::size_t(place)], place);
  }
  return result;
}
}

FalconFrame encode(const FalconCommand& command) noexcept
{
  FalconFrame frame;
  frame[0] = kBegin;
  for (int leg = 0; leg < kFalconLegs; ++leg)
  {
    putWord(frame, leg, command.motors[std::size_t(leg)]);
  }
  frame[kFlags] = std::uint8_t((command.leds & kLargestNibble) + kOffset);
  frame[kUnknown] = kOffset;
  frame[kLast] = kEnd;
  return frame;
}

bool decode(const FalconFrame& frame, FalconReply& reply) noexcept
{
  if (!fits(frame))
  {
    return false;
  }
  const std::uint8_t flags = std::uint8_t(frame[kFlags] - kOffset);
  reply.encoders = { word(frame, 0), word(frame, 1), word(frame, 2) };
  reply.buttons = flags & 15;
  reply.homed = (flags >> 4) & 7;
  return true;
}

bool FalconFrameFinder::take(std::uint8_t byte) noexcept
{
  if (size_ == kFalconFrameSize)
  {
    size_ = 0;
  }
  if (!fits(byte, size_))
  {
    dropped_ += std::uint64_t(size_);
    size_ = 0;
    if (byte != kBegin)
    {
      ++dropped_;
      return false;
    }
  }
  frame_[std::size_t(size_++)] = byte;
  return size_ == kFalconFrameSize;
}

} // namespace pointhaptics
