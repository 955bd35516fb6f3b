/// @file
/// Progress of an algorithm, told to its observers without losing a signal.
#pragma once

namespace pointhaptics
{

/// Runs the handlers of signals that came (runSignalHandlers()). While it lives in the main thread without
/// the interpreter's lock, signals whose handlers are the interpreter's wait: a handler that ran in an
/// observer would raise there, where VTK prints what is raised, or ends the process.
class SignalsAroundObservers
{
public:
  /// @param areThere False: there are no observers, and nothing waits.
  explicit SignalsAroundObservers(bool areThere) noexcept;
  ~SignalsAroundObservers();
  SignalsAroundObservers(const SignalsAroundObservers&) = delete;
  SignalsAroundObservers& operator=(const SignalsAroundObservers&) = delete;

private:
  bool holds_ = false;
};

/// UpdateProgress() of @p algorithm, a vtkAlgorithm. Work asks for an abort behind it: a handler may have
/// raised.
template <typename Algorithm>
void updateProgress(Algorithm* algorithm, double fraction)
{
  const SignalsAroundObservers signals(algorithm->HasObserver("ProgressEvent") != 0);
  algorithm->UpdateProgress(fraction);
}

} // namespace pointhaptics
