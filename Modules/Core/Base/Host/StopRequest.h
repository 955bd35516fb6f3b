/// @file
/// Whether a host's algorithm shall stop, for all versions of VTK.
#pragma once

namespace pointhaptics
{

/// True if @p algorithm, a vtkAlgorithm, shall stop. Versions from 9.2 on have CheckAbort(), which tells the
/// executive too: it then leaves the progress where it is.
template <typename Algorithm>
auto shallStop(Algorithm* algorithm, int = 0) -> decltype(algorithm->CheckAbort())
{
  return algorithm->CheckAbort();
}
template <typename Algorithm>
bool shallStop(Algorithm* algorithm, long = 0)
{
  return algorithm->GetAbortExecute() != 0;
}

} // namespace pointhaptics
