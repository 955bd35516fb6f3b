/// @file
/// The commands of pointhaptics-mpi.
#pragma once

#include <functional>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

class Job;

/// Work of a command line, run after it was parsed on all ranks. @throws EndOfJob
using MpiWork = std::function<void(Job&)>;

/// Adds resample and bandwidth to @p program; their callbacks store what @p ranks processes run in @p work.
void addMpiCommands(CLI::App& program, int ranks, MpiWork& work);

} // namespace pointhaptics::app
