/// @file
/// Progress of reading and writing, and stopping on request: vtkAlgorithm's UpdateProgress and AbortExecute.
#pragma once

#include "vtkType.h"

class vtkAlgorithm;

namespace pointhaptics::io
{

/// Rows between two progress reports: a few reports per 100,000 points.
constexpr vtkIdType kProgressRows = 32768;

/// Reports to the observers of @p algorithm that @p fraction of its work, 0..1, is done.
/// @throws StoppedOnRequest when AbortExecute is set. Call it from the thread that runs the algorithm.
void reportProgress(vtkAlgorithm* algorithm, double fraction);

} // namespace pointhaptics::io
