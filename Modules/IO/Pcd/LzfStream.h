/// @file
/// Unpacks LZF, the compression of binary_compressed PCD files, piece by piece: memory does not grow with the
/// data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace pointhaptics::io
{

/// Format: a control byte below 32 stands before that many and one literal bytes; others hold 3 bits of
/// length (7: one more byte adds to it) and, with the byte after, 13 bits of distance back.
class LzfStream
{
public:
  /// @p packed must outlive this object.
  explicit LzfStream(std::string_view packed)
    : packed_(packed)
    , window_(new std::uint8_t[kCapacity])
  {
  }
  /// Fills all of @p to. @return false when the packed bytes are damaged or end before.
  bool read(char* to, std::size_t size);
  /// True if everything was unpacked and handed out.
  bool isAtEnd() const { return at_ == packed_.size() && begin_ == end_; }
  /// How many packed bytes were used, up to the fault where there is one.
  std::size_t position() const { return at_; }

private:
  bool fill();
  bool unpackOne();

  static constexpr std::size_t kFarthest = 8192; ///< 13 bits of distance
  static constexpr std::size_t kLongest = 264;   ///< of one control byte
  static constexpr std::size_t kBlock = 65536;
  static constexpr std::size_t kCapacity = kFarthest + kBlock + kLongest;

  std::string_view packed_;
  std::size_t at_ = 0;
  std::unique_ptr<std::uint8_t[]> window_; ///< what references may reach, then what was not handed out yet
  std::size_t begin_ = 0;                  ///< the first byte that was not handed out
  std::size_t end_ = 0;
};

} // namespace pointhaptics::io
