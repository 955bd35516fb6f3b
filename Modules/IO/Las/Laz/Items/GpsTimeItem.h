/// @file
/// LAZ's coding of gps times, versions 2 and 3: differences of the 64 bits, each as a multiple of the one
/// before, along up to four interleaved sequences. Source: LASzip's published format (M. Isenburg, 2013).
#pragma once

#include "IO/Las/Laz/IntegerModels.h"
#include "IO/Las/Laz/Items/Layer.h"

#include <array>
#include <cstdint>

namespace pointhaptics::io
{

/// The gps times of one stream, or of one scanner channel of it. Times are the bits of their doubles. Version
/// 2 codes each time (@p kEachTime); version 3 only those that differ from the one before.
template <bool kEachTime>
class GpsTimeItem : public NumberItem<std::uint64_t>
{
public:
  void start(Value first) { sequences_[0].time = first; }
  template <typename Coder>
  Value code(Coder& coder, const PointLabel& label, Value last, Value time)
  {
    if (!kEachTime && !label.hasNewTime)
    {
      return last;
    }
    if (!codeInSequence(coder, time) && !codeInSequence(coder, time))
    {
      coder.markDamaged(); // an encoder changes sequences once at most
    }
    return sequences_[current_].time;
  }

private:
  static constexpr int kMostMultiple = 500;
  static constexpr int kLeastMultiple = 10; ///< its negative
  static constexpr int kUnchanged = kEachTime ? 1 : 0;
  struct Sequence
  {
    std::uint64_t time = 0;
    std::int32_t difference = 0;
    int extremes = 0; ///< multiples beyond the ends, one after the other
  };

  static bool fits(std::uint64_t difference)
  {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(static_cast<std::int32_t>(difference))) ==
      difference;
  }
  /// For an encoder, where the difference needs more than 32 bits: the sequence to change to, or 0: the time
  /// is stored.
  int otherSequence(std::uint64_t time) const
  {
    for (int i = 1; i < 4; ++i)
    {
      if (fits(time - sequences_[(current_ + static_cast<unsigned>(i)) & 3].time))
      {
        return i;
      }
    }
    return 0;
  }

  /// @return false where the time is coded in another sequence, which is now the current one.
  template <typename Coder>
  bool codeInSequence(Coder& coder, std::uint64_t time)
  {
    return sequences_[current_].difference == 0 ? codeAfterZero(coder, time) : codeMultiple(coder, time);
  }
  template <typename Coder>
  bool codeAfterZero(Coder& coder, std::uint64_t time)
  {
    Sequence& sequence = sequences_[current_];
    const std::uint64_t wanted = time - sequence.time;
    int choice = 0;
    if constexpr (Coder::kEncodes)
    {
      choice = wanted == 0 && kEachTime ? -1 : fits(wanted) ? 0 : 1 + otherSequence(time);
    }
    choice =
      static_cast<int>(coder.symbol(zeroCases_, static_cast<unsigned>(choice + kUnchanged))) - kUnchanged;
    if (choice == 0)
    {
      sequence.difference = differences_.code(coder, 0, static_cast<std::int32_t>(wanted), 0);
      advance(sequence, sequence.difference);
      sequence.extremes = 0;
    }
    return choice < 1 || changeSequence(coder, time, choice - 1);
  }
  template <typename Coder>
  bool codeMultiple(Coder& coder, std::uint64_t time)
  {
    Sequence& sequence = sequences_[current_];
    const std::uint64_t wanted = time - sequence.time;
    constexpr int kAllMultiples = kMostMultiple + kLeastMultiple + 1;
    int choice = 0;
    if constexpr (Coder::kEncodes)
    {
      choice = wanted == 0 && kEachTime ? kAllMultiples
        : fits(wanted)                  ? multipleFor(sequence, static_cast<std::int32_t>(wanted))
                                        : kAllMultiples + kUnchanged + otherSequence(time);
    }
    choice = static_cast<int>(coder.symbol(multiples_, static_cast<unsigned>(choice)));
    if (choice < kAllMultiples)
    {
      codeDifference(coder, sequence, choice, static_cast<std::int32_t>(wanted));
      return true;
    }
    choice -= kAllMultiples + kUnchanged;
    return choice < 0 || changeSequence(coder, time, choice);
  }
  /// The symbol for the multiple of the difference before that is nearest to @p wanted.
  static int multipleFor(const Sequence& sequence, std::int32_t wanted)
  {
    const float ratio = static_cast<float>(wanted) / static_cast<float>(sequence.difference);
    const float rounded = ratio >= 0.0f ? ratio + 0.5f : ratio - 0.5f;
    const int multiple = rounded >= static_cast<float>(kMostMultiple) ? kMostMultiple
      : rounded <= -static_cast<float>(kLeastMultiple)                ? -kLeastMultiple
                                                                      : static_cast<int>(rounded);
    return multiple >= 0 ? multiple : kMostMultiple - multiple;
  }
  template <typename Coder>
  void codeDifference(Coder& coder, Sequence& sequence, int symbol, std::int32_t wanted)
  {
    const int multiple = symbol <= kMostMultiple ? symbol : kMostMultiple - symbol;
    const unsigned context = multiple == 1 ? 1u
      : multiple == 0                      ? 7u
      : multiple == kMostMultiple          ? 4u
      : multiple == -kLeastMultiple        ? 6u
      : multiple < 0                       ? 5u
      : multiple < 10                      ? 2u
                                           : 3u;
    const std::int32_t predicted = static_cast<std::int32_t>(
      static_cast<std::uint32_t>(multiple) * static_cast<std::uint32_t>(sequence.difference));
    const std::int32_t difference = differences_.code(coder, predicted, wanted, context);
    advance(sequence, difference);
    if (multiple == 1)
    {
      sequence.extremes = 0;
    }
    else if ((context == 7 || context == 4 || context == 6) && ++sequence.extremes > 3)
    {
      sequence.difference = difference;
      sequence.extremes = 0;
    }
  }
  static void advance(Sequence& sequence, std::int32_t difference)
  {
    sequence.time += static_cast<std::uint64_t>(static_cast<std::int64_t>(difference));
  }
  /// @p choice 0: begins a new sequence with the time, @return true; 1..3: goes that many sequences on,
  /// @return false.
  template <typename Coder>
  bool changeSequence(Coder& coder, std::uint64_t time, int choice)
  {
    if (choice > 0)
    {
      current_ = (current_ + static_cast<unsigned>(choice)) & 3;
      return false;
    }
    const std::int32_t predicted = static_cast<std::int32_t>(sequences_[current_].time >> 32);
    newest_ = (newest_ + 1) & 3;
    const std::uint32_t high = static_cast<std::uint32_t>(
      differences_.code(coder, predicted, static_cast<std::int32_t>(time >> 32), 8));
    const std::uint32_t low = coder.bits(32, static_cast<std::uint32_t>(time));
    current_ = newest_;
    sequences_[current_] = {};
    sequences_[current_].time = std::uint64_t{ high } << 32 | low;
    return true;
  }

  SymbolModel zeroCases_{ 5 + kUnchanged };
  SymbolModel multiples_{ kMostMultiple + kLeastMultiple + 5 + kUnchanged };
  IntegerModels differences_{ 32, 9 };
  std::array<Sequence, 4> sequences_{};
  unsigned current_ = 0;
  unsigned newest_ = 0;
};

} // namespace pointhaptics::io
