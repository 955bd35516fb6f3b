#include "DistanceMark.h"

#include "EventLink.h"
#include "ScreenMarks.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr unsigned char kInk[3] = { 25, 25, 30 };
constexpr float kWidth = 2.0F;
constexpr float kRimWidth = 5.0F;
/// Sizes in points: pixels at 72 dots per inch.
constexpr int kFont = 15;
constexpr double kArm = 7.0;
constexpr double kGap = 8.0;
constexpr double kLine = 22.0;
/// Steps of the search for a free place, kLine apart; words farther away belong to nothing, and are left out.
constexpr int kMostSteps = 6;
/// Priority after ScreenLayout, which knows the taken places.
constexpr float kLast = -2.0F;
/// A line steeper than this has its words to the right.
constexpr double kSteep = 0.25;

} // namespace

struct DistanceMark::Parts
{
  std::vector<Vec3> places;
  std::vector<std::string> words;
  vtkNew<vtkMatrix4x4> model;
  ScreenLines rim{ kRimWidth };
  ScreenLines line{ kWidth };
  ScreenTexts texts;
  EventLink onStart{ [this]
    {
      if (!this->places.empty())
      {
        this->place();
      }
    } };
  vtkWeakPointer<vtkRenderer> renderer;
  std::function<std::vector<std::array<double, 4>>()> taken;

  Vec3 inPicture(const Vec3& place) { return transformed(this->model, place); }
  void draw(const Pixel& a, const Pixel& b)
  {
    this->rim.add(a.x, a.y, b.x, b.y, kMarkRim);
    this->line.add(a.x, a.y, b.x, b.y, kMarkColor);
  }
  void drawCross(const Pixel& p, double arm)
  {
    this->draw({ p.x - arm, p.y - arm, true }, { p.x + arm, p.y + arm, true });
    this->draw({ p.x - arm, p.y + arm, true }, { p.x + arm, p.y - arm, true });
  }
  void place();
  void write(const Pixel& a, const Pixel& b);
};

/// Writes beside the middle of the visible line, within the viewport, where nothing else is written.
void DistanceMark::Parts::write(const Pixel& a, const Pixel& b)
{
  const double pixels = this->texts.pixelsPerPoint();
  const int* size = this->renderer->GetSize();
  const auto within = [](double value, double edge) { return std::clamp(value, 0.0, edge); };
  const double x = 0.5 * (within(a.x, size[0]) + within(b.x, size[0]));
  const double y = 0.5 * (within(a.y, size[1]) + within(b.y, size[1]));
  // Words stand above and below a flat line, and beside a steep one, on the side that it leaves free.
  const bool isSteep = std::abs(b.y - a.y) > kSteep * std::abs(b.x - a.x);
  const double first = isSteep ? ((b.y - a.y) * (b.x - a.x) > 0.0 ? -0.5 : 1.5) * kLine : kGap + 0.5 * kLine;
  const double step = isSteep ? kLine : 2.0 * first;
  for (std::size_t i = 0; i < this->words.size(); ++i)
  {
    const double width = this->texts.widthOf(this->words[i]);
    const double room = pixels * kGap;
    const double left = isSteep ? x + room : x - 0.5 * width;
    const double middle = y + pixels * (first - double(i) * step);
    const double most = std::max(room, size[0] - width - room);
    const double high = std::max(pixels * kLine, size[1] - pixels * kLine);
    const double across = std::clamp(left, room, most);
    bool isPut = false;
    for (int away = 0; away < kMostSteps && !isPut; ++away)
    {
      for (int side : { 1, -1 })
      {
        const double up = std::clamp(middle + side * away * pixels * kLine, pixels * kLine, high);
        isPut = isPut || this->texts.put(this->words[i], across, up, 1.0, 0.0, kInk);
      }
    }
  }
}

void DistanceMark::Parts::place()
{
  this->rim.clear();
  this->line.clear();
  this->texts.clear(this->renderer, kFont);
  for (const std::array<double, 4>& box : this->taken ? this->taken() : std::vector<std::array<double, 4>>())
  {
    this->texts.take(box);
  }
  const ScreenProjection project(this->renderer);
  for (const Vec3& place : this->places)
  {
    const Pixel pixel = project(this->inPicture(place));
    if (pixel.seen)
    {
      this->drawCross(pixel, this->texts.pixelsPerPoint() * kArm);
    }
  }
  if (this->places.size() > 1)
  {
    Vec3 a = this->inPicture(this->places[0]);
    Vec3 b = this->inPicture(this->places[1]);
    if (project.leaveSeenPart(a, b))
    {
      this->draw(project(a), project(b));
      this->write(project(a), project(b));
    }
  }
  this->texts.finish();
  this->rim.finish();
  this->line.finish();
}

DistanceMark::DistanceMark()
  : parts_(std::make_unique<Parts>())
{
}

DistanceMark::~DistanceMark()
{
  if (vtkRenderer* renderer = parts_->renderer)
  {
    renderer->RemoveActor2D(parts_->rim.actor());
    renderer->RemoveActor2D(parts_->line.actor());
    parts_->texts.removeFrom(renderer);
  }
}

void DistanceMark::addTo(vtkRenderer* renderer)
{
  parts_->renderer = renderer;
  renderer->AddActor2D(parts_->rim.actor());
  renderer->AddActor2D(parts_->line.actor());
  parts_->texts.addTo(renderer);
  parts_->onStart.follow(renderer, vtkCommand::StartEvent, kLast);
}

void DistanceMark::setPlaces(std::vector<Vec3> places)
{
  parts_->places = std::move(places);
  parts_->rim.actor()->SetVisibility(!parts_->places.empty());
  parts_->line.actor()->SetVisibility(!parts_->places.empty());
  if (parts_->places.empty())
  {
    parts_->texts.hide();
  }
}

void DistanceMark::setWords(std::vector<std::string> words)
{
  parts_->words = std::move(words);
}

void DistanceMark::setTaken(std::function<std::vector<std::array<double, 4>>()> taken)
{
  parts_->taken = std::move(taken);
}

void DistanceMark::setModel(vtkMatrix4x4* model)
{
  parts_->model->DeepCopy(model);
}

} // namespace pointhaptics
