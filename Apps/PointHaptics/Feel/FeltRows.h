/// @file
/// Keeps a touch: its rows, recording and sound in files, and the figures that commands print.
#pragma once

#include "Feel/FeelCommand.h"

#include "CsvWriter.h"
#include "VirtualTouch.h"

#include "Core/Base/Vector3.h"
#include "Devices/Sound/ContactTone.h"
#include "Devices/Sound/WavFile.h"
#include "Haptics/Proxy.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointhaptics
{

class HapticScene;

namespace app
{

/// A force as a figure: rounding leaves about 1e-14 N where a surface is met without depth, which is nothing.
inline double forceFigure(double newtons)
{
  constexpr double kSmallest = 1e-9;
  return newtons < kSmallest ? 0.0 : newtons;
}

/// Least distance to the cloud of a hand that touches nothing. Keeps at most kMostPlaces places of the hand,
/// evenly in time.
class ClosestApproach
{
public:
  static constexpr std::size_t kMostPlaces = 4096;

  void add(const Vec3& hip);
  /// Distance from the nearest kept place to a point of @p scene, metres; nothing: there is no place. 0.1 us
  /// per point, and some us per place.
  std::optional<double> distance(const HapticScene& scene) const;

private:
  std::vector<Vec3> places_;
  std::size_t stride_ = 1;
  std::size_t added_ = 0;
};

/// A WAV file as long as the touch: each tick is heard until the next one.
class FeltSound
{
public:
  /// False: @p message says why the file cannot be created.
  bool open(const std::string& fileName, std::string& message);
  /// Plays @p state from @p time on, seconds; a pause longer than a second is cut to one.
  void add(double time, const ProxyState& state);
  /// False: @p message says what is lost. True also where it was not opened.
  bool close(std::string& message);

private:
  void play(double seconds);

  WavFile file_;
  ContactTone tone_;
  std::vector<float> samples_;
  bool isOpen_ = false;
  bool hasBegun_ = false;
  HeardTouch touch_;
  double time_ = 0.0;   ///< Time of the newest tick.
  double step_ = 0.0;   ///< Time between the last two ticks.
  double wanted_ = 0.0; ///< Seconds of sound so far.
  std::string problem_;
};

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
  void add(double time, const ProxyState& state, double microseconds);
  FeltSummary summary();
  /// Nearest approach of a hand that has touched nothing.
  const ClosestApproach& approach() const { return approach_; }

  RecordingWriter recording; ///< May not be open.

private:
  CsvWriter table_;
  FeltSound sound_;
  ClosestApproach approach_;
  FeltSummary summary_;
  std::vector<float> durations_;
  std::uint64_t scene_ = 0;
};

} // namespace app
} // namespace pointhaptics
