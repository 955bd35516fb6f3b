/// @file
/// The left mouse button, for tools that take it before the style does.
#pragma once

#include "EventLink.h"

#include <vtkWeakPointer.h>

#include <functional>

class vtkRenderWindowInteractor;

namespace pointhaptics
{

/// Observes the button and the pointer of an interactor as long as it lives. GUI thread only.
class LeftButton
{
public:
  enum class Kind
  {
    Press,
    Move, ///< The pointer moves, whether the button is pressed or not.
    Release,
  };
  struct Event
  {
    Kind kind = Kind::Press;
    int x = 0; ///< Pixels of the window, from the left and from below.
    int y = 0;
    bool isPlain = true; ///< Neither Shift nor Ctrl is held: with them a drag is the model's or the hand's.
  };

  /// @p takes returns true if no other observer may see the event. Tools with a higher @p priority come
  /// first; the style's is 0.
  LeftButton(vtkRenderWindowInteractor* interactor, float priority, std::function<bool(const Event&)> takes);

  /// Renders the window, where there still is one.
  void render();

private:
  void onEvent(unsigned long event);

  vtkWeakPointer<vtkRenderWindowInteractor> interactor_;
  std::function<bool(const Event&)> takes_;
  EventLink events_{ [this](unsigned long event, void*) { this->onEvent(event); } };
};

} // namespace pointhaptics
