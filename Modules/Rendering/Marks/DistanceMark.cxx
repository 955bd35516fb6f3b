#include "DistanceMark.h"

#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr unsigned char kInk[3] = { 25, 25, 30 };
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

DistanceMark::DistanceMark() = default;

DistanceMark::~DistanceMark()
{
  if (renderer_)
  {
    renderer_->RemoveActor2D(rim_.actor());
    renderer_->RemoveActor2D(line_.actor());
    texts_.removeFrom(renderer_);
  }
}

void DistanceMark::draw(const Pixel& a, const Pixel& b)
{
  rim_.add(a.x, a.y, b.x, b.y, kMarkRim);
  line_.add(a.x, a.y, b.x, b.y, kMarkColor);
}

/// Writes beside the middle of the visible line, within the viewport, where nothing else is written.
void DistanceMark::write(const Pixel& a, const Pixel& b)
{
  const double pixels = texts_.pixelsPerPoint();
  const int* size = renderer_->GetSize();
  const auto within = [](double value, double edge) { return std::clamp(value, 0.0, edge); };
  const double x = 0.5 * (within(a.x, size[0]) + within(b.x, size[0]));
  const double y = 0.5 * (within(a.y, size[1]) + within(b.y, size[1]));
  // Words stand above and below a flat line, and beside a steep one, on the side that it leaves free.
  const bool isSteep = std::abs(b.y - a.y) > kSteep * std::abs(b.x - a.x);
  const double first = isSteep ? ((b.y - a.y) * (b.x - a.x) > 0.0 ? -0.5 : 1.5) * kLine : kGap + 0.5 * kLine;
  const double step = isSteep ? kLine : 2.0 * first;
  for (std::size_t i = 0; i < words_.size(); ++i)
  {
    const double width = texts_.widthOf(words_[i]);
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
        isPut = isPut || texts_.put(words_[i], across, up, 1.0, 0.0, kInk);
      }
    }
  }
}

void DistanceMark::place()
{
  if (places_.empty())
  {
    return;
  }
  rim_.clear();
  line_.clear();
  texts_.clear(renderer_, kFont);
  for (const std::array<double, 4>& box : taken_ ? taken_() : std::vector<std::array<double, 4>>())
  {
    texts_.take(box);
  }
  const ScreenProjection project(renderer_);
  for (const Vec3& place : places_)
  {
    const Pixel pixel = project(transformed(model_, place));
    if (pixel.seen)
    {
      const double arm = texts_.pixelsPerPoint() * kArm;
      this->draw({ pixel.x - arm, pixel.y - arm, true }, { pixel.x + arm, pixel.y + arm, true });
      this->draw({ pixel.x - arm, pixel.y + arm, true }, { pixel.x + arm, pixel.y - arm, true });
    }
  }
  if (places_.size() > 1)
  {
    Vec3 a = transformed(model_, places_[0]);
    Vec3 b = transformed(model_, places_[1]);
    if (project.leaveSeenPart(a, b))
    {
      this->draw(project(a), project(b));
      this->write(project(a), project(b));
    }
  }
  texts_.finish();
  rim_.finish();
  line_.finish();
}

void DistanceMark::addTo(vtkRenderer* renderer)
{
  renderer_ = renderer;
  renderer->AddActor2D(rim_.actor());
  renderer->AddActor2D(line_.actor());
  texts_.addTo(renderer);
  onStart_.follow(renderer, vtkCommand::StartEvent, kLast);
}

void DistanceMark::setPlaces(std::vector<Vec3> places)
{
  places_ = std::move(places);
  rim_.actor()->SetVisibility(!places_.empty());
  line_.actor()->SetVisibility(!places_.empty());
  if (places_.empty())
  {
    texts_.hide();
  }
}

} // namespace pointhaptics
