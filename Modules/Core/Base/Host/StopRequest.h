/// @file
/// Whether a host's algorithm shall stop, for all versions of VTK.
#pragma once

#include <atomic>
#include <functional>

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

/// Stops an algorithm for the host, and takes that back behind the run: from version 9.3 on VTK would stop
/// the next run, too. The flag is an int or an atomic one.
template <typename Flag>
class HostStop
{
public:
  /// @param abortExecute of the algorithm.
  explicit HostStop(Flag& abortExecute)
    : abortExecute_(abortExecute)
  {
  }
  ~HostStop()
  {
    if (isRequested_)
    {
      abortExecute_ = 0;
    }
  }
  HostStop(const HostStop&) = delete;
  HostStop& operator=(const HostStop&) = delete;
  /// For WithoutInterpreterLock, which must end before this object does.
  std::function<void()> request()
  {
    return [this]
    {
      isRequested_ = true;
      abortExecute_ = 1;
    };
  }

private:
  Flag& abortExecute_;
  std::atomic<bool> isRequested_{ false };
};

} // namespace pointhaptics
