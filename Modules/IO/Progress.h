/// @file
/// Progress of reading and writing, and stopping on request: vtkAlgorithm's UpdateProgress and AbortExecute.
#pragma once

#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Base/Host/StopRequest.h"
#include "FileProblem.h"

#include "vtkAlgorithm.h"

namespace pointhaptics::io
{

/// Rows between two progress reports: a few reports per 100,000 points.
constexpr vtkIdType kProgressRows = 32768;

/// Reports to the observers of @p algorithm that @p fraction of its work, 0..1, is done.
/// @throws StoppedOnRequest when AbortExecute is set. Call it from the thread that runs the algorithm.
inline void reportProgress(vtkAlgorithm* algorithm, double fraction)
{
  algorithm->UpdateProgress(fraction);
  runSignalHandlers();
  if (shallStop(algorithm, 0))
  {
    throw StoppedOnRequest();
  }
}

} // namespace pointhaptics::io
