/// @file
/// Which chunks of a cloud optimised point cloud hold the points of a box, down to a resolution. Source: COPC
/// Specification 1.0 (copc.io): the chunks are the nodes of an octree; pages list them.
#pragma once

#include "IO/Las/Laz/LazChunks.h"

namespace pointhaptics::io
{

struct LasHeader;
struct ReadTask;

/// The chunks of the nodes that touch the box of task.wanted and whose level is needed for its resolution, in
/// the order of the file, numbered from 0. Reads only the pages of the hierarchy that list such nodes
/// (ReadTask::load). The root has the points of the coarsest level; each level halves the distance between
/// points, and the points of all levels down to one make up the cloud at its resolution. Where they are more
/// than task.wanted.mostPoints, the finest levels are left out; the coarsest one that has points stays.
/// @throws FileProblem with byte offset and value where pages or nodes lie outside the file, in one another,
/// or lead in a circle, and where there are more points than @p header counts.
LazChunks findCopcChunks(const ReadTask& task, const LasHeader& header);

} // namespace pointhaptics::io
