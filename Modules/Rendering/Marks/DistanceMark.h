/// @file
/// A line between two places of a cloud, with words beside it.
#pragma once

#include "Core/Base/Vector3.h"
#include "EventLink.h"
#include "ScreenMarks.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

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
  void setWords(std::vector<std::string> words) { words_ = std::move(words); }
  /// Sets a function that returns, before each render, the boxes where no words may stand, pixels of the
  /// renderer: left, bottom, right, top of each. It may be empty.
  void setTaken(std::function<std::vector<std::array<double, 4>>()> taken) { taken_ = std::move(taken); }
  /// Sets the matrix from the frame of the cloud to that of the picture; copied. Default: the identity.
  void setModel(vtkMatrix4x4* model) { model_->DeepCopy(model); }

private:
  void place();
  void draw(const Pixel& a, const Pixel& b);
  void write(const Pixel& a, const Pixel& b);

  std::vector<Vec3> places_;
  std::vector<std::string> words_;
  vtkNew<vtkMatrix4x4> model_;
  ScreenLines rim_{ 5.0F };
  ScreenLines line_{ 2.0F };
  ScreenTexts texts_;
  EventLink onStart_{ [this] { this->place(); } };
  vtkWeakPointer<vtkRenderer> renderer_;
  std::function<std::vector<std::array<double, 4>>()> taken_;
};

} // namespace pointhaptics
