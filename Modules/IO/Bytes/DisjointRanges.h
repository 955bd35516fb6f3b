/// @file
/// Parts of a file of which no two may share a byte.
#pragma once

#include <cstdint>
#include <iterator>
#include <map>

namespace pointhaptics::io
{

/// Reading shared bytes again and again would cost more time than a file has bytes for.
class DisjointRanges
{
public:
  /// @return false where the range meets one that was added before, or begins where it does.
  bool add(std::uint64_t begin, std::uint64_t end)
  {
    const auto [at, isNew] = ends_.emplace(begin, end);
    const auto next = std::next(at);
    return isNew && (at == ends_.begin() || std::prev(at)->second <= begin) &&
      (next == ends_.end() || next->first >= end);
  }

private:
  std::map<std::uint64_t, std::uint64_t> ends_; ///< By where they begin.
};

} // namespace pointhaptics::io
