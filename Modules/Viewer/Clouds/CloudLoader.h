/// @file
/// Clouds read in a thread of their own, so that a window answers meanwhile.
#pragma once

#include "LoadedCloud.h"

#include "PointHapticsViewerModule.h" // For export macro

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <string>

namespace pointhaptics
{

/// One load counts at a time: start() and cancel() give up the one before, whose reader ends at its next
/// report of progress, and whose result nobody gets. The cloud is made in the loader's thread, which keeps no
/// reference to one that was taken. All functions belong to one thread, the GUI's.
class POINTHAPTICSVIEWER_EXPORT CloudLoader
{
public:
  CloudLoader();
  /// Gives up the present load and waits for the reader.
  ~CloudLoader();
  CloudLoader(const CloudLoader&) = delete;
  CloudLoader& operator=(const CloudLoader&) = delete;

  void start(CloudRequest request);
  /// Gives up the present load without waiting. A result that was not taken is lost, too.
  void cancel();
  /// True if a load was started and neither taken nor cancelled.
  bool busy() const { return present_ != nullptr; }
  /// Step of the present load, for people, and its progress, 0 to 1; that of "reading" ascends.
  struct Step
  {
    const char* name = "reading"; ///< Or "preparing", "measuring", "resampling".
    double part = 0.0;
  };
  Step step() const;
  /// Seconds since start().
  double seconds() const;
  /// Waits for the present load, @p seconds at most. True: take() has a result.
  bool waitFor(double seconds) const;
  /// True: the present load has ended and is handed over; busy() is false from now on. An empty @p message:
  /// @p loaded is what it made; otherwise @p message says which file cannot be read and why, and @p loaded is
  /// as it was.
  bool take(LoadedCloud& loaded, std::string& message);

private:
  using Clock = std::chrono::steady_clock;
  struct Load;

  std::shared_ptr<Load> present_;
  std::future<void> ended_; ///< End of the newest load, which begins when the one before has ended.
};

/// Seconds in which most files are read: a bar for them would only flicker.
constexpr double kProgressDelay = 0.2;
/// Largest progress before the end: HapticViewerObserver::progress() gets 1 once.
constexpr double kAlmostDone = 0.999;

} // namespace pointhaptics
