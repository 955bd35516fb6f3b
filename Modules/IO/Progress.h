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

/// While this lives, the progress of one of VTK's own algorithms is that of @p outer from @p begin to @p end,
/// never falling, and AbortExecute of @p outer becomes that of @p inner. Both must outlive it. One thread.
class RelayedProgress
{
public:
  RelayedProgress(vtkAlgorithm* inner, vtkAlgorithm* outer, double begin, double end);
  ~RelayedProgress();
  RelayedProgress(const RelayedProgress&) = delete;
  RelayedProgress& operator=(const RelayedProgress&) = delete;

  /// Call it when @p inner is done, before its faults are looked at. @throws StoppedOnRequest.
  void finish();

private:
  void relay(double fraction);

  vtkAlgorithm* inner_;
  vtkAlgorithm* outer_;
  double begin_;
  double end_;
  double reached_;
  unsigned long observer_ = 0;
};

} // namespace pointhaptics::io
