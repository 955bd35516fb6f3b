/// @file
/// LAZ's coding of the 29 bytes that point to a waveform, versions 1 (point formats 4 and 5) and 3 (9 and
/// 10). Source: LASzip's published format (M. Isenburg, 2013).
#pragma once

#include "IO/Las/Laz/IntegerModels.h"
#include "IO/Las/Laz/Items/Layer.h"

#include <cstdint>

namespace pointhaptics::io
{

/// Index of the descriptor, offset and size of the packet, place of the return in it, direction.
class WavePacketItem : public NumbersItem<char, 29>
{
public:
  template <typename Coder>
  Value code(Coder& coder, const PointLabel&, const Value& last, Value value)
  {
    value[0] = static_cast<char>(coder.symbol(index_, byteAt(value.data(), 0)));
    storeLittle(
      codeOffset(coder, last.data(), loadLittle<std::uint64_t>(value.data() + 1)), value.data() + 1);
    codeNumber(coder, sizes_, 9, 0, last, value);
    codeNumber(coder, places_, 13, 0, last, value);
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      codeNumber(coder, directions_, 17 + 4 * axis, axis, last, value);
    }
    return value;
  }

private:
  enum OffsetCase : unsigned
  {
    kSame,
    kBehind, ///< directly behind the packet before
    kNear,   ///< a difference of 32 bits
    kFar
  };

  template <typename Coder>
  std::uint64_t codeOffset(Coder& coder, const char* last, std::uint64_t wanted)
  {
    const std::uint64_t before = loadLittle<std::uint64_t>(last + 1);
    const std::uint64_t behind = before + loadLittle<std::uint32_t>(last + 9);
    const std::int32_t difference = static_cast<std::int32_t>(wanted - before);
    const bool isNear = before + static_cast<std::uint64_t>(std::int64_t{ difference }) == wanted;
    const unsigned choice = wanted == before ? kSame : wanted == behind ? kBehind : isNear ? kNear : kFar;
    lastCase_ = coder.symbol(offsetCases_[lastCase_], choice);
    switch (lastCase_)
    {
      case kSame:
        return before;
      case kBehind:
        return behind;
      case kNear:
        lastDifference_ = offsets_.code(coder, lastDifference_, difference);
        return before + static_cast<std::uint64_t>(std::int64_t{ lastDifference_ });
      default:
        return codeInt64(coder, wanted);
    }
  }
  template <typename Coder>
  static void codeNumber(
    Coder& coder, IntegerModels& models, std::size_t at, unsigned context, const Value& last, Value& value)
  {
    storeLittle(models.code(coder, loadLittle<std::int32_t>(last.data() + at),
                  loadLittle<std::int32_t>(value.data() + at), context),
      value.data() + at);
  }

  SymbolModel index_{ 256 };
  ModelBank offsetCases_{ 4, 4 };
  IntegerModels offsets_{ 32, 1 };
  IntegerModels sizes_{ 32, 1 };
  IntegerModels places_{ 32, 1 };
  IntegerModels directions_{ 32, 3 };
  unsigned lastCase_ = 0;
  std::int32_t lastDifference_ = 0;
};

} // namespace pointhaptics::io
