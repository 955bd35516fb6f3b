/// @file
/// The colour bar under the mouse.
#pragma once

#include "LeftButton.h"
#include "ToolContext.h"

#include <array>

namespace pointhaptics
{

class PictureControls;

/// A drag that begins on the colour bar moves the value under the pointer; nothing else moves. A press on a
/// class or file in its list hides or shows that. GUI thread only.
class ColorBarDrag
{
public:
  /// Both must outlive this.
  ColorBarDrag(const ToolContext& context, PictureControls& controls);

private:
  /// True if no other observer may see the event.
  bool takes(const LeftButton::Event& event);

  const ToolContext& context_;
  PictureControls& controls_;
  bool drags_ = false;
  // The bar when the drag began: words that come and go may move it.
  double from_ = 0.0; ///< ViewScene::ColorBarPlace::along.
  double pixels_ = 1.0;
  int fromY_ = 0;
  std::array<double, 2> range_{};
  LeftButton button_; ///< Last member, as it calls this object.
};

} // namespace pointhaptics
