/// @file
/// Draw calls in steps, for renderers that store what they have not drawn yet.
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkWeakPointer.h"

#include <cstdint>
#include <deque>

struct __GLsync;
class vtkOpenGLRenderWindow;
class vtkRenderWindow;

namespace pointhaptics
{

/// Mesa's software renderer makes about 500 bytes of each point before it draws it, and keeps the memory: 200
/// MB for a frame with all of 543,652 points, until the window closes. A few points at a time reuse the same
/// megabytes, which lie in the cache: such a frame takes two thirds of the time. No effect on graphics cards.
/// GUI thread only.
class POINTHAPTICSRENDERING_EXPORT DrawPace
{
public:
  /// Points of a step.
  static constexpr std::int64_t kStep = 4096;
  /// Steps that are drawn while the next one is made.
  static constexpr std::size_t kAhead = 2;

  /// The pace of @p window, whose context is current.
  static DrawPace& of(vtkOpenGLRenderWindow* window);

  /// Most points that the next draw call may have; above 0.
  std::int64_t room() const;
  /// Counts points that were drawn. Ends a step that is full and waits until no more than kAhead are under
  /// way.
  void add(std::int64_t points);
  /// True if the window's renderer works in steps.
  bool isNeeded() const { return isNeeded_; }
  /// Number of steps that were ended; and of those that may be under way.
  std::int64_t steps() const { return steps_; }
  std::size_t underWay() const { return underWay_.size(); }

private:
  void follow(vtkOpenGLRenderWindow* window);

  vtkWeakPointer<vtkRenderWindow> window_;
  bool isNeeded_ = false;
  std::int64_t drawn_ = 0; ///< Points drawn in the present step.
  std::int64_t steps_ = 0;
  std::deque<__GLsync*> underWay_;
};

} // namespace pointhaptics
