#include "IO/Pcd/LzfStream.h"

#include <algorithm>
#include <cstring>

namespace pointhaptics::io
{

bool LzfStream::unpackOne()
{
  const std::size_t left = packed_.size() - at_;
  const auto byteAt = [&](std::size_t i) { return static_cast<std::uint8_t>(packed_[at_ + i]); };
  const std::size_t control = byteAt(0);
  if (control < 32)
  {
    const std::size_t length = control + 1;
    if (length >= left)
    {
      return false;
    }
    std::memcpy(window_.get() + end_, packed_.data() + at_ + 1, length);
    at_ += 1 + length;
    end_ += length;
    return true;
  }
  const bool isLong = control >> 5 == 7;
  const std::size_t used = isLong ? 3 : 2;
  if (used > left)
  {
    return false;
  }
  const std::size_t length = (control >> 5) + 2 + (isLong ? byteAt(1) : 0);
  const std::size_t distance = ((control & 31) << 8 | byteAt(used - 1)) + 1;
  if (distance > end_)
  {
    return false;
  }
  // A reference may reach into what it writes: byte by byte.
  const std::uint8_t* from = window_.get() + end_ - distance;
  std::uint8_t* to = window_.get() + end_;
  for (std::size_t i = 0; i < length; ++i)
  {
    to[i] = from[i];
  }
  at_ += used;
  end_ += length;
  return true;
}

bool LzfStream::fill()
{
  if (end_ > kFarthest)
  {
    const std::size_t dropped = end_ - kFarthest;
    std::memmove(window_.get(), window_.get() + dropped, kFarthest);
    end_ = kFarthest;
  }
  begin_ = end_;
  while (end_ < kFarthest + kBlock && at_ < packed_.size())
  {
    if (!this->unpackOne())
    {
      return false;
    }
  }
  return end_ > begin_;
}

bool LzfStream::read(char* to, std::size_t size)
{
  while (size > 0)
  {
    if (begin_ == end_ && !this->fill())
    {
      return false;
    }
    const std::size_t piece = std::min(size, end_ - begin_);
    std::memcpy(to, window_.get() + begin_, piece);
    begin_ += piece;
    to += piece;
    size -= piece;
  }
  return true;
}

} // namespace pointhaptics::io
