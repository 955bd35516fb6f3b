/// @file
/// Keys that are pressed before there is anything they could act on.
#pragma once

#include <string>
#include <vector>

class vtkRenderWindowInteractor;

namespace pointhaptics
{

/// Keeps the keys of a window that waits for its first file, and presses them again when it is there. GUI
/// thread only.
class WaitingKeys
{
public:
  /// Keeps the key that @p interactor has just received.
  void keep(vtkRenderWindowInteractor* interactor);
  /// Presses and lets go of all of them, in their order, and forgets them.
  void press(vtkRenderWindowInteractor* interactor);

private:
  struct Key
  {
    std::string symbol;
    char code;
    bool control;
    bool shift;
    bool alt;
  };
  std::vector<Key> keys_;
};

} // namespace pointhaptics
