/// @file
/// A window over the whole screen, without its border.
#pragma once

class vtkRenderWindow;

namespace pointhaptics
{

/// Asks the window manager; without one it moves and sizes the window itself. (VTK's own way makes another
/// window, which has lost its events.) X servers only. GUI thread only.
class FullScreen
{
public:
  /// @p window must outlive this.
  explicit FullScreen(vtkRenderWindow* window)
    : window_(window)
  {
  }

  /// True if the window is there, whoever put it there.
  bool isFull() const;
  /// To the whole screen, or back to where the window was. False: this window system does not offer it, or
  /// the window is not open.
  bool set(bool full);

private:
  bool setByHand(bool full);

  vtkRenderWindow* window_;
  int place_[4] = { 0, 0, 0, 0 }; ///< x, y, width, height before, where there is no window manager.
};

} // namespace pointhaptics
