/// @file
/// A line between two places of a cloud, with words beside it.
#pragma once

#include "Core/Base/Vector3.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkMatrix4x4;
class vtkRenderer;

namespace pointhaptics
{

/// In front of the cloud, as wide on the screen from any distance, and placed anew before each render: it
/// stays on its places however camera and model move. GUI thread only.
class POINTHAPTICSRENDERING_EXPORT DistanceMark
{
public:
  DistanceMark();
  /// Takes it out of its renderer.
  ~DistanceMark();
  DistanceMark(const DistanceMark&) = delete;
  DistanceMark& operator=(const DistanceMark&) = delete;

  /// To one renderer, for good.
  void addTo(vtkRenderer* renderer);
  /// In the frame of the cloud: two for a line, one for its first end, none hides all (the default).
  void setPlaces(std::vector<Vec3> places);
  /// Up to two lines beside the middle: above and below it, or to its right where the line is steep.
  void setWords(std::vector<std::string> words);
  /// Asked before each render: where no words may stand, pixels of the renderer: left, bottom, right, top of
  /// each. It may be empty.
  void setTaken(std::function<std::vector<std::array<double, 4>>()> taken);
  /// From the frame of the cloud to that of the picture; copied. Default: the identity.
  void setModel(vtkMatrix4x4* model);

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace pointhaptics
