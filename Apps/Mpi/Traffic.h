/// @file
/// The option --traffic: bytes that the ranks read and sent.
#pragma once

#include "Forward.h"

#include <cstdint>

namespace pointhaptics::app
{

/// Bytes of this rank.
struct Traffic
{
  bool isWanted = false;
  std::int64_t read = 0; ///< Bytes of the input that were read.

  void addTo(CLI::App& command);
  /// Prints the bytes on stderr, if that is wanted. Collective. @p sent: bytes to other ranks, for the
  /// computation.
  void show(Job& job, std::int64_t sent) const;
};

} // namespace pointhaptics::app
