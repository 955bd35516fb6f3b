/// @file
/// A window over the whole screen, without its border.
#pragma once

class vtkRenderWindow;

namespace pointhaptics
{

/// Asks the window manager; without one it moves and sizes the window itself. VTK's own way makes another
/// window, which loses its events. X servers only. GUI thread only.
class FullScreen
{
public:
  /// @p window must outlive this.
  explicit FullScreen(vtkRenderWindow* window)
    : window_(window)
  {
  }

  /// True if the window covers the screen, whoever made it so.
  bool isFull() const;
  /// Covers the whole screen, or restores the window. False: this window system does not offer it, or the
  /// window is not open.
  bool set(bool full);

private:
  bool setByHand(bool full);

  vtkRenderWindow* window_;
  int place_[4] = { 0, 0, 0, 0 }; ///< Former x, y, width and height, where there is no window manager.
};

} // namespace pointhaptics
