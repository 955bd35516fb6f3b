/// @file
/// A program run from its start to its end, as a user waits for it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics::bench::render
{

struct ProcessRun
{
  double seconds = 0.0;       ///< From before the fork until it has ended.
  std::int64_t peakBytes = 0; ///< Highest resident memory, libraries included.
  int exitCode = -1;          ///< -1: it could not be started, or ended by a signal.
};

/// Runs @p words[0], searched in PATH where it has no slash, with the other words as arguments. What it
/// prints goes nowhere. @pre words is not empty.
ProcessRun runProcess(const std::vector<std::string>& words);

/// Whether a program of that name is in PATH.
bool programExists(const std::string& name);

/// The program pointhaptics: beside the one that runs, or wherever PATH leads.
std::string viewerProgram();

} // namespace pointhaptics::bench::render
