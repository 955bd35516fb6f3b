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

/// Draws a line in front of the cloud, as wide on the screen from any distance. It is placed anew before each
/// render, so it stays in place when camera and model move. GUI thread only.
class POINTHAPTICSRENDERING_EXPORT DistanceMark
{
public:
  DistanceMark();
  /// Removes it from its renderer.
  ~DistanceMark();
  DistanceMark(const DistanceMark&) = delete;
  DistanceMark& operator=(const DistanceMark&) = delete;

  /// Adds it to one renderer, for good.
  void addTo(vtkRenderer* renderer);
  /// Sets the places in the frame of the cloud: two for a line, one for its first end, none hides all (the
  /// default).
  void setPlaces(std::vector<Vec3> places);
  /// Sets up to two lines of words beside the middle: above and below the line, or to its right where it is
  /// steep.
  void setWords(std::vector<std::string> words);
  /// Sets a function that returns, before each render, the boxes where no words may stand, pixels of the
  /// renderer: left, bottom, right, top of each. It may be empty.
  void setTaken(std::function<std::vector<std::array<double, 4>>()> taken);
  /// Sets the matrix from the frame of the cloud to that of the picture; copied. Default: the identity.
  void setModel(vtkMatrix4x4* model);

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace pointhaptics
