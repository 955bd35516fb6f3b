/// @file
/// Whether a host's algorithm shall stop, for all versions of VTK.
#pragma once

namespace pointhaptics
{

/// True if @p algorithm, a vtkAlgorithm, shall stop. Versions from 9.2 on have CheckAbort(), whose answer the
/// filters downstream need. Their executive reports a progress of 1 after each run, stopped ones included:
/// the progress is held where it is, until the next run sets its shift and scale.
template <typename Algorithm>
auto shallStop(Algorithm* algorithm, int = 0) -> decltype(algorithm->CheckAbort())
{
  const bool stops = algorithm->CheckAbort();
  if (stops)
  {
    algorithm->SetProgressShiftScale(algorithm->GetProgress(), 0.0);
  }
  return stops;
}
template <typename Algorithm>
bool shallStop(Algorithm* algorithm, long = 0)
{
  return algorithm->GetAbortExecute() != 0;
}

} // namespace pointhaptics
