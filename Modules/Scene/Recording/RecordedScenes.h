/// @file
/// The scenes of a recording, made again.
#pragma once

#include "Recording.h"

#include "Haptics/HapticScene.h"

#include "PointHapticsSceneModule.h" // For export macro

#include "vtkSmartPointer.h"

#include <map>
#include <memory>
#include <string>

class vtkPointSet;

namespace pointhaptics
{

/// Makes scene after scene as the events of a recording ask for them, and keeps what later ones need. One
/// thread.
class POINTHAPTICSSCENE_EXPORT RecordedScenes
{
public:
  /// @param recording must outlive this. @param cloud as its files were read; shared, not changed.
  RecordedScenes(const Recording& recording, vtkPointSet* cloud);
  ~RecordedScenes();

  /// Whether @p cloud is the one that was felt. False: @p message says what differs.
  static bool isOf(const Recording& recording, vtkPointSet* cloud, std::string& message);
  /// Of an event of the recording, and of each once, in their order; null where there was none. False: @p
  /// message says why it cannot be made.
  bool make(const RecordedEvent& event, std::shared_ptr<const HapticScene>& scene, std::string& message);

private:
  struct Maker;
  std::shared_ptr<const HapticScene> cloudOf(std::uint64_t number);
  void forgetBefore(const RecordedEvent& event);

  const Recording& recording_;
  std::unique_ptr<Maker> maker_;
  std::map<std::uint64_t, std::shared_ptr<const HapticScene>> clouds_; ///< As they were made.
  std::map<std::uint64_t, const RecordedEvent*> lastUse_;
};

} // namespace pointhaptics
