/// @file
/// One file that several ranks read together, each its part of the points.
#pragma once

#include "Core/Distributed/Ranks.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

namespace pointhaptics::io
{

/// Consecutive ones, from 0.
struct RowRange
{
  std::uint64_t first = 0;
  std::uint64_t last = 0; ///< One past the end.

  std::uint64_t count() const { return last - first; }
  bool meets(std::uint64_t from, std::uint64_t to) const { return from < last && first < to; }
};

/// Another rank could not go on, and says why; this one had no fault.
class OtherRankFailed : public std::exception
{
};

/// The ranks that read a file together. Each says with every message whether it can go on, so that a fault of
/// one ends the reading of all, and none waits for it. Each exchange @throws OtherRankFailed; FileProblem
/// where ranks see files of different sizes.
class SharedReading : public Ranks
{
public:
  /// @p ranks must outlive this object. @p bytes: of the file; all ranks must see the same.
  SharedReading(Ranks& ranks, std::uint64_t bytes)
    : ranks_(ranks)
    , bytes_(bytes)
  {
  }

  int rank() const override { return ranks_.rank(); }
  int size() const override { return ranks_.size(); }
  std::vector<std::string> exchange(std::vector<std::string> messages) override;

  /// This rank's of @p all rows: as many on each.
  RowRange rowsOf(std::uint64_t all) const;

  /// This rank cannot go on: tells the others in the place of the next exchange, unless they know.
  void fail();

private:
  Ranks& ranks_;
  std::uint64_t bytes_;
  bool isOver_ = false; ///< The ranks have given up.
};

} // namespace pointhaptics::io
