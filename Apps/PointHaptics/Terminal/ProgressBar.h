/// @file
/// A bar on stderr for work that takes long, where stderr is a terminal.
#pragma once

#include <chrono>
#include <string>

class vtkAlgorithm;
class vtkObject;

namespace pointhaptics::app
{

/// Shows nothing in the first half second, nor where stderr is no terminal; wipes itself when it goes.
class ProgressBar
{
public:
  explicit ProgressBar(std::string label);
  /// Follows the progress events of @p algorithm, which must outlive the bar, and stops it (AbortExecute) at
  /// the first one after a remembered signal (StopSignals.h).
  ProgressBar(std::string label, vtkAlgorithm* algorithm);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param fraction 0 to 1. Cheap: draws at most ten times a second.
  void show(double fraction);

private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  vtkAlgorithm* algorithm_ = nullptr;
  unsigned long observer_ = 0;
  bool onTerminal_ = false;
  bool drawn_ = false;
  Clock::time_point next_;
};

} // namespace pointhaptics::app
