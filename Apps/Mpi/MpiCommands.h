/// @file
/// The commands of pointhaptics-mpi.
#pragma once

#include "Forward.h"

#include <functional>

namespace pointhaptics::app
{

/// Work of a command line, run after it was parsed on all ranks. @throws EndOfJob
using MpiWork = std::function<void(Job&)>;

/// Each adds its command to @p program; its callback stores what @p ranks processes run in @p work.
void addMpiResample(CLI::App& program, int ranks, MpiWork& work);
void addMpiBandwidth(CLI::App& program, int ranks, MpiWork& work);

} // namespace pointhaptics::app
