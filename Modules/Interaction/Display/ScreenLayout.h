/// @file
/// Places the words and controls over the picture, so that none lies over another.
#pragma once

#include "EventLink.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProgress.h"
#include "vtkHapticSliders.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace pointhaptics
{

/// A rectangle in pixels of the renderer, from its lower left corner.
struct ScreenRectangle
{
  double left = 0.0;
  double bottom = 0.0;
  double right = 0.0;
  double top = 0.0;

  double width() const { return right - left; }
  double height() const { return top - bottom; }
  bool empty() const { return !(left < right && bottom < top); }
  bool meets(const ScreenRectangle& other) const
  {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
};

/// A block that the layout knows only by its size, such as a scalar bar.
struct ScreenBlock
{
  /// Returns width and least height in pixels for a font of @p font points; false: it is not shown.
  std::function<bool(double font, double& width, double& height)> measure;
  /// Puts the block within @p box; an empty box hides it.
  std::function<void(const ScreenRectangle& box, double font)> place;
};

/// Places all blocks over a picture: status at the upper left, the panel beside it or below, a column at the
/// right with the scalar bar and the sliders, details at the lower left, progress in the middle of the free
/// room. The help covers all: the others are hidden while it is open. Where the window is too small the font
/// shrinks, then lines are left out, and at last the least wanted block is.
///
/// Lengths follow the window's dots per inch: at 72, the default of VTK, one point is one pixel. GUI thread
/// only.
class POINTHAPTICSINTERACTION_EXPORT ScreenLayout
{
public:
  ScreenLayout() = default;
  ScreenLayout(const ScreenLayout&) = delete;
  ScreenLayout& operator=(const ScreenLayout&) = delete;

  ///@{
  /// Set the blocks; null takes one away.
  void setOverlay(vtkHapticOverlay* overlay) { overlay_ = overlay; }
  void setSliders(vtkHapticSliders* sliders) { sliders_ = sliders; }
  void setProgress(vtkHapticProgress* progress) { progress_ = progress; }
  void setScalarBar(ScreenBlock bar) { bar_ = std::move(bar); }
  /// Size in pixels, at 72 dots per inch, of the lower right corner that is taken; 0: none.
  void setCorner(std::function<double()> corner) { corner_ = std::move(corner); }
  /// True if texts stand on opaque plates.
  void setOpaque(std::function<bool()> opaque) { opaque_ = std::move(opaque); }
  ///@}
  /// Arranges before each render of @p renderer, in which all blocks are drawn; null: stops that.
  void follow(vtkRenderer* renderer);
  /// Arranges now, if anything has changed.
  void arrange(vtkRenderer* renderer);

  /// A block and its part of the screen.
  struct Place
  {
    std::string name; ///< Name of the block: "status", "panel", "detail", "help", "progress", "sliders",
                      ///< "bar".
    ScreenRectangle box;
  };
  /// Shown blocks with their boxes, as they were arranged last.
  const std::vector<Place>& places() const { return places_; }
  /// Boxes of these blocks: left, bottom, right, top. Marks that follow the model give way to them.
  std::vector<std::array<double, 4>> boxes() const;

private:
  struct Room;
  std::vector<double> state(vtkRenderer* renderer) const;
  bool tryFont(vtkRenderer* renderer, double font, bool isLast);
  void placeTop(Room& room, bool isLast);
  void placeColumn(Room& room, bool isLast);
  ScreenRectangle takeColumn(Room& room, const double size[2], double bottom, double top);
  void placeProgress(Room& room);
  void leaveOut(const std::string& name);
  void placeDetail(Room& room, bool isLast);
  void placeHelp(vtkRenderer* renderer);
  void add(const char* name, const ScreenRectangle& box) { places_.push_back({ name, box }); }

  vtkSmartPointer<vtkHapticOverlay> overlay_;
  vtkSmartPointer<vtkHapticSliders> sliders_;
  vtkSmartPointer<vtkHapticProgress> progress_;
  ScreenBlock bar_;
  std::function<double()> corner_;
  std::function<bool()> opaque_;
  EventLink before_{ [this] { this->arrange(renderer_); } };
  vtkWeakPointer<vtkRenderer> renderer_;
  std::vector<double> arranged_; ///< Values on which the places depend, at the last arrangement.
  std::string arrangedTexts_;
  std::vector<Place> places_;
};

} // namespace pointhaptics
