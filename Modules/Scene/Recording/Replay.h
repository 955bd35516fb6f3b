/// @file
/// A recording felt again, tick by tick: `feel --replay`, `view --replay` and `compare`.
#pragma once

#include "RecordedScenes.h"
#include "Recording.h"

#include "Haptics/Servo/ServoStep.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace pointhaptics
{

/// Does what the servo thread did (ServoStep) with the same scenes, parameters and hand: its samples have the
/// bits of the recorded ones, updateSeconds aside. One thread.
class POINTHAPTICSSCENE_EXPORT Replay
{
public:
  /// Both must outlive this. @param method felt instead of the recorded one, if given.
  Replay(const Recording& recording, RecordedScenes& scenes, std::optional<ProxyMethod> method = {});

  bool isAtEnd() const { return next_ == recording_.ticks.size(); }
  /// The row that the next step is of.
  const RecordedTick& row() const { return recording_.ticks[next_]; }
  /// Feels the next tick. @pre not isAtEnd(). False: @p message says which scene cannot be made.
  bool step(ServoSample& sample, std::string& message);
  /// The scene in use; may be null.
  const std::shared_ptr<const HapticScene>& scene() const { return scene_; }

private:
  bool apply(const RecordedEvent& event, TickInput& input, std::string& message);

  const Recording& recording_;
  RecordedScenes& scenes_;
  std::optional<ProxyMethod> method_;
  ServoStep step_;
  ServoSample sample_;
  std::shared_ptr<const HapticScene> scene_;
  std::shared_ptr<const HapticScene> former_; ///< The proxy is in it until the next step.
  std::size_t next_ = 0;
  std::size_t nextEvent_ = 0;
  bool clutched_ = false;
  bool gateIsOpen_ = true;
  bool reading_ = true;
  bool writing_ = true;
};

/// How a replay compares with what was recorded.
struct ReplayDifference
{
  std::uint64_t ticks = 0;
  std::uint64_t sameTicks = 0; ///< All columns of the hand, the contact and the force have the same bits.
  double largest = 0.0;        ///< Newtons, of the forces.
  std::uint64_t firstTick = 0; ///< First tick that differs; 0: none does.

  POINTHAPTICSSCENE_EXPORT void add(const RecordedTick& row, const ServoSample& sample);
  /// In words, in one line.
  POINTHAPTICSSCENE_EXPORT std::string text() const;
};

} // namespace pointhaptics
