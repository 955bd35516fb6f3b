/// @file
/// Keeps a touch: its rows, recording and sound in files, and the figures that commands print.
#pragma once

#include "Feel/FeelCommand.h"

#include "ClosestApproach.h"
#include "CsvWriter.h"
#include "VirtualTouch.h"

#include "Devices/Sound/TouchSoundFile.h"
#include "Haptics/Proxy.h"

#include <cstdint>
#include <vector>

namespace pointhaptics::app
{

/// A force as a figure: rounding leaves about 1e-14 N where a surface is met without depth, which is nothing.
inline double forceFigure(double newtons)
{
  constexpr double kSmallest = 1e-9;
  return newtons < kSmallest ? 0.0 : newtons;
}

struct FeltSummary
{
  std::int64_t ticks = 0;
  std::int64_t contactTicks = 0;
  double maximumForce = 0.0;
  double p50Microseconds = 0.0;
  double p99Microseconds = 0.0;
  double maximumMicroseconds = 0.0;
};

/// Writes a row, a sample of the recording and the sound of each tick, and keeps their summary.
class FeltRows
{
public:
  FeltRows(const FeelCommand& options, Files& files);
  /// Ends all files, and gives them their names.
  void commit(Files& files);
  /// Adds a row with another time than the sample's, which counts from the first tick.
  void add(double time, const VirtualTouch& touch);
  void add(double time, const ServoSample& sample);
  FeltSummary summary();
  /// Nearest approach of a hand that has touched nothing.
  const ClosestApproach& approach() const { return approach_; }

  RecordingWriter recording; ///< May not be open.

private:
  CsvWriter table_;
  TouchSoundFile sound_;
  ClosestApproach approach_;
  FeltSummary summary_;
  std::vector<float> durations_;
  std::uint64_t scene_ = 0;
};

} // namespace pointhaptics::app
