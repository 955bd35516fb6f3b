#include "ScreenLayout.h"

#include "ScreenMarks.h"

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

using Overlay = vtkHapticOverlay;

/// Sizes in points.
constexpr double kLargestFont = 15.0;
constexpr double kSmallestFont = 8.0;
constexpr double kMargin = 8.0;
constexpr double kGap = 8.0;
/// Begin and end of the column at the right if nothing is in its way, over the renderer's height.
constexpr double kColumnBottom = 0.28;
constexpr double kColumnTop = 0.78;
constexpr int kAllLines = 1000;
/// Part of the height that a text may take in a window too small for all.
constexpr double kTextPart = 0.3;
constexpr double kMostOfTexts = 0.4; ///< Part that the texts at the left may take before their font shrinks.
/// Part of the width that the status may take beside the panel.
constexpr double kStatusPart = 0.62;
/// Priority after every other observer of the render, which may change the blocks.
constexpr float kLast = -1.0F;

} // namespace

/// Free space of the renderer, and the font that is tried.
struct ScreenLayout::Room
{
  vtkRenderer* renderer = nullptr;
  double font = kLargestFont;
  double pixels = 1.0; ///< Pixels per point.
  ScreenRectangle free;
  double leftTop = 0.0; ///< Lower ends of the texts at the upper left, and at the upper right.
  double rightTop = 0.0;
  double columnLeft = 0.0; ///< Left edge of the column at the right.
  double bottom = 0.0;     ///< Upper end of the block at the lower left.
  bool fits = true;

  double gap() const { return kGap * pixels; }
};

void ScreenLayout::follow(vtkRenderer* renderer)
{
  renderer_ = renderer;
  arranged_.clear();
  before_.follow(renderer, vtkCommand::StartEvent, kLast);
}

std::vector<std::array<double, 4>> ScreenLayout::boxes() const
{
  std::vector<std::array<double, 4>> boxes;
  for (const Place& place : places_)
  {
    boxes.push_back({ place.box.left, place.box.bottom, place.box.right, place.box.top });
  }
  return boxes;
}

std::vector<double> ScreenLayout::state(vtkRenderer* renderer) const
{
  const int* size = renderer->GetSize();
  const int* origin = renderer->GetOrigin();
  std::vector<double> state{ double(size[0]), double(size[1]), double(origin[0]), double(origin[1]),
    double(renderer->GetRenderWindow()->GetDPI()), corner_ ? corner_() : 0.0,
    double(overlay_ ? overlay_->GetHelpPage() : 0), double(sliders_ && sliders_->GetVisibility()),
    double(progress_ && !progress_->GetText().empty()) };
  for (int block = 0; overlay_ && block < Overlay::NumberOfBlocks; ++block)
  {
    state.push_back(double(overlay_->IsBlockShown(block)));
  }
  double bar[2] = { 0.0, 0.0 };
  const bool hasBar = bar_.measure && bar_.measure(kLargestFont, bar[0], bar[1]);
  state.insert(state.end(), { double(hasBar), bar[0], bar[1] });
  return state;
}

void ScreenLayout::arrange(vtkRenderer* renderer)
{
  if (!renderer || !renderer->GetRenderWindow() || renderer->GetSize()[0] < 1 || renderer->GetSize()[1] < 1)
  {
    return;
  }
  if (overlay_ && opaque_ && overlay_->GetOpaque() != opaque_())
  {
    overlay_->SetOpaque(opaque_());
    sliders_ ? sliders_->SetOpaque(opaque_()) : void();
  }
  std::vector<double> wanted = this->state(renderer);
  const std::string texts = overlay_ ? overlay_->GetStatus() + '\f' + overlay_->GetPanel() + '\f' +
      overlay_->GetDetail() + '\f' + overlay_->GetHelp()
                                     : std::string();
  if (wanted == arranged_ && texts == arrangedTexts_)
  {
    return;
  }
  arranged_ = std::move(wanted);
  arrangedTexts_ = texts;
  const bool isHelp = overlay_ && overlay_->GetHelpVisibility();
  if (sliders_)
  {
    sliders_->SetCovered(isHelp);
  }
  if (isHelp)
  {
    this->placeHelp(renderer);
    return;
  }
  for (double font = kLargestFont; !this->tryFont(renderer, font, font <= kSmallestFont); --font)
  {
  }
}

/// Places the help, which stands alone.
void ScreenLayout::placeHelp(vtkRenderer* renderer)
{
  places_.clear();
  for (int block : { Overlay::StatusBlock, Overlay::PanelBlock, Overlay::DetailBlock })
  {
    overlay_->HideBlock(block);
  }
  if (bar_.place)
  {
    bar_.place({}, kLargestFont);
  }
  double size[2];
  overlay_->MeasureBlock(Overlay::HelpBlock, 0, 0.0, kAllLines, size);
  const int* all = renderer->GetSize();
  const double left = std::round(0.5 * (all[0] - size[0]));
  const double bottom = std::round(0.5 * (all[1] - size[1]));
  overlay_->PlaceBlock(Overlay::HelpBlock, left, bottom);
  this->add("help", { left, bottom, left + size[0], bottom + size[1] });
}

bool ScreenLayout::tryFont(vtkRenderer* renderer, double font, bool isLast)
{
  places_.clear();
  Room room;
  room.renderer = renderer;
  room.font = font;
  room.pixels = pixelsPerPoint(renderer);
  const double margin = kMargin * room.pixels;
  room.free = { margin, margin, renderer->GetSize()[0] - margin, renderer->GetSize()[1] - margin };
  room.leftTop = room.rightTop = room.free.top;
  room.columnLeft = room.free.right;
  room.bottom = room.free.bottom;
  this->placeTop(room, isLast);
  this->placeColumn(room, isLast);
  this->placeDetail(room, isLast);
  this->placeProgress(room);
  return room.fits || isLast;
}

/// Places the status at the left and the panel at the right, or below it where both do not fit side by side.
void ScreenLayout::placeTop(Room& room, bool isLast)
{
  const double width = room.free.width();
  const bool hasPanel = overlay_ && overlay_->IsBlockShown(Overlay::PanelBlock);
  const int lines =
    isLast ? std::max(1, int(kTextPart * room.free.height() / (1.4 * room.font * room.pixels))) : kAllLines;
  double status[2] = { 0.0, 0.0 };
  if (overlay_ && overlay_->IsBlockShown(Overlay::StatusBlock))
  {
    overlay_->MeasureBlock(
      Overlay::StatusBlock, int(room.font), hasPanel ? kStatusPart * width : width, lines, status);
    const ScreenRectangle box{ room.free.left, room.free.top - status[1], room.free.left + status[0],
      room.free.top };
    overlay_->PlaceBlock(Overlay::StatusBlock, box.left, box.bottom);
    this->add("status", box);
    room.leftTop = box.bottom - room.gap();
  }
  if (hasPanel)
  {
    double panel[2];
    overlay_->MeasureBlock(Overlay::PanelBlock, int(room.font), width, lines, panel);
    const bool isBeside = status[0] + room.gap() + panel[0] <= width;
    const bool makesRoom = isLast && !isBeside && progress_ && !progress_->GetText().empty();
    if (makesRoom)
    {
      overlay_->HideBlock(Overlay::PanelBlock);
      return;
    }
    const double top = isBeside ? room.free.top : room.leftTop;
    const ScreenRectangle box{ room.free.right - panel[0], top - panel[1], room.free.right, top };
    overlay_->PlaceBlock(Overlay::PanelBlock, box.left, box.bottom);
    this->add("panel", box);
    room.rightTop = box.bottom - room.gap();
    room.leftTop = isBeside ? room.leftTop : room.rightTop;
  }
  // The picture comes first, and the column must not run into a status that is as wide as the window.
  room.fits = room.fits && room.free.top - room.leftTop < kMostOfTexts * room.free.height() &&
    std::min(room.leftTop, room.rightTop) > 0.4 * room.free.height();
}

/// Places the sliders at the right edge and the scalar bar beside them.
void ScreenLayout::placeColumn(Room& room, bool isLast)
{
  double size[2] = { 0.0, 0.0 };
  if (sliders_ && sliders_->GetVisibility())
  {
    sliders_->Measure(int(room.font), size);
    double wished[4];
    sliders_->PreferredPlace(size, wished);
    const int* origin = room.renderer->GetOrigin();
    const ScreenRectangle box = this->takeColumn(room, size, wished[1] - origin[1], wished[3] - origin[1]);
    sliders_->SetCovered(isLast && box.empty());
    if (!box.empty())
    {
      sliders_->Place(
        box.left + origin[0], box.bottom + origin[1], box.right + origin[0], box.top + origin[1]);
      this->add("sliders", box);
    }
  }
  if (bar_.measure && bar_.measure(room.font, size[0], size[1]))
  {
    const double height = room.renderer->GetSize()[1];
    const ScreenRectangle box = this->takeColumn(room, size, kColumnBottom * height, kColumnTop * height);
    bar_.place(box, room.font);
    if (!box.empty())
    {
      this->add("bar", box);
    }
  }
}

/// Takes a box of at least @p size beside the blocks at the right edge, from @p bottom to @p top where that
/// is free; empty: there is no room.
ScreenRectangle ScreenLayout::takeColumn(Room& room, const double size[2], double bottom, double top)
{
  const double floor = std::max(room.free.bottom, (corner_ ? corner_() : 0.0) * room.pixels);
  const double ceiling = std::min(room.leftTop, room.rightTop);
  ScreenRectangle box{ room.columnLeft - size[0], 0.0, room.columnLeft, std::min(top, ceiling) };
  box.bottom = std::max(floor, std::min(bottom, box.top - size[1]));
  box.top = std::min(ceiling, std::max(box.top, box.bottom + size[1]));
  const bool hasRoom = size[1] <= box.height() + 1.0 && box.left >= room.free.left;
  room.fits = room.fits && hasRoom;
  if (!hasRoom)
  {
    return {};
  }
  room.columnLeft = box.left - room.gap();
  return box;
}

void ScreenLayout::placeDetail(Room& room, bool isLast)
{
  if (!overlay_ || !overlay_->IsBlockShown(Overlay::DetailBlock))
  {
    return;
  }
  const double width = room.columnLeft - room.free.left;
  const double height = room.leftTop - room.free.bottom;
  double size[2];
  overlay_->MeasureBlock(Overlay::DetailBlock, int(room.font), std::max(width, 1.0), kAllLines, size);
  for (int lines = 60; isLast && lines > 0 && size[1] > height; --lines)
  {
    overlay_->MeasureBlock(Overlay::DetailBlock, int(room.font), std::max(width, 1.0), lines, size);
  }
  const bool hasRoom = size[0] <= width && size[1] <= height;
  room.fits = room.fits && hasRoom;
  if (isLast && !hasRoom)
  {
    overlay_->HideBlock(Overlay::DetailBlock);
    return;
  }
  overlay_->PlaceBlock(Overlay::DetailBlock, room.free.left, room.free.bottom);
  this->add(
    "detail", { room.free.left, room.free.bottom, room.free.left + size[0], room.free.bottom + size[1] });
  room.bottom = room.free.bottom + size[1] + room.gap();
}

/// Places the progress in the middle of the free room, smaller where that is small; blocks in its way are
/// hidden until the file is read.
void ScreenLayout::placeProgress(Room& room)
{
  if (!progress_ || progress_->GetText().empty())
  {
    return;
  }
  double size[2];
  progress_->Measure(room.renderer, 1.0, size);
  if (room.leftTop - room.bottom < size[1])
  {
    this->leaveOut("detail");
    room.bottom = room.free.bottom;
  }
  const double part =
    std::min({ 1.0, room.free.width() / size[0], std::max(0.1, (room.leftTop - room.bottom) / size[1]) });
  progress_->Measure(room.renderer, part, size);
  const double x = std::max(0.5 * (room.free.left + room.columnLeft), room.free.left + 0.5 * size[0]);
  const double y = 0.5 * (room.leftTop + room.bottom);
  const ScreenRectangle box{ x - 0.5 * size[0], y - 0.5 * size[1], x + 0.5 * size[0], y + 0.5 * size[1] };
  for (const char* name : { "bar", "sliders", "panel" })
  {
    const auto place =
      std::find_if(places_.begin(), places_.end(), [name](const Place& each) { return each.name == name; });
    if (place != places_.end() && place->box.meets(box))
    {
      this->leaveOut(name);
    }
  }
  progress_->Place(room.renderer, x, y);
  this->add("progress", box);
}

void ScreenLayout::leaveOut(const std::string& name)
{
  const auto isIt = [&name](const Place& place) { return place.name == name; };
  if (std::none_of(places_.begin(), places_.end(), isIt))
  {
    return;
  }
  if (name == "bar")
  {
    bar_.place({}, kLargestFont);
  }
  else if (name == "sliders")
  {
    sliders_->SetCovered(true);
  }
  else
  {
    overlay_->HideBlock(name == "panel" ? Overlay::PanelBlock : Overlay::DetailBlock);
  }
  places_.erase(std::remove_if(places_.begin(), places_.end(), isIt), places_.end());
}

} // namespace pointhaptics
