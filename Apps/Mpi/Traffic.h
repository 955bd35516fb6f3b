/// @file
/// The option --traffic: what the ranks read and sent.
#pragma once

#include "Forward.h"

#include <cstdint>

namespace pointhaptics::app
{

/// Bytes of this rank.
struct Traffic
{
  bool isWanted = false;
  std::int64_t read = 0; ///< Of the input.

  void addTo(CLI::App& command);
  /// Collective: says it on stderr, where it is wanted. @p sent: to other ranks, for the computation.
  void show(Job& job, std::int64_t sent) const;
};

} // namespace pointhaptics::app
