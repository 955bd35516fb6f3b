/// @file
/// Marks the voxel mean under the mouse in the picture, and describes it in the overlay.
#pragma once

#include "PickMarker.h"

#include "Core/Base/Vector3.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <optional>
#include <set>
#include <string>

class vtkActor;
class vtkHapticOverlay;

namespace pointhaptics
{

struct PickedOfFile;
class ScenePipeline;
class ScreenView;
class StatusText;

/// GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT PointPicker
{
public:
  /// All must outlive this. The overlay is that of @p status.
  PointPicker(const ScreenView& screen, const ScenePipeline& scenes, const StatusText& status)
    : screen_(screen)
    , scenes_(scenes)
    , status_(status)
  {
  }
  PointPicker(const PointPicker&) = delete;
  PointPicker& operator=(const PointPicker&) = delete;

  /// Texts show the values of the picked point of the file, which @p actor draws in whatever frame, without
  /// the arrays @p leftOut. Null, or while the actor is hidden: the values of the mean alone. The actor must
  /// outlive this, or be taken back.
  void setPointsOfFile(vtkActor* actor, const std::set<std::string>& leftOut)
  {
    fileActor_ = actor;
    leftOut_ = leftOut;
  }
  /// Shows position, voxel, bandwidth and arrays of the voxel mean at a display position, until the model
  /// moves. False: no mean is drawn within 8 pixels of it; none is shown then.
  bool pickAt(int x, int y);
  /// Removes the marks, as voxel and bandwidth belong to one resampling. True: something was shown.
  bool forget();

  /// Finds the place at a display position that is as deep as what the picture shows there or beside it, or
  /// as the nearest mean where there is no picture; workspace. Marks and shows nothing.
  std::optional<Vec3> surfaceAt(int x, int y) const;

private:
  PickedOfFile pickOfFile(int x, int y) const;

  const ScreenView& screen_;
  const ScenePipeline& scenes_;
  const StatusText& status_;
  PickMarker marker_;
  vtkActor* fileActor_ = nullptr;
  std::set<std::string> leftOut_;
};

} // namespace pointhaptics
