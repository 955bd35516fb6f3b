#include "TouchOutlines.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Distance between a mark and the middle of its outline, points.
constexpr double kAway = 1.5;
/// Priority after all observers that set the camera and the window's dots per inch.
constexpr float kLast = -2.0F;
constexpr double kPointsPerInch = 72.0;
constexpr int kCircleCorners = 32;
constexpr double kTurn = 6.28318530717958648;
constexpr unsigned char kYellow[3] = { 255, 217, 26 };

/// Circle about @p center through the ends of @p first and @p second.
std::vector<Vec3> circle(const Vec3& center, const Vec3& first, const Vec3& second)
{
  std::vector<Vec3> points;
  for (int i = 0; i < kCircleCorners; ++i)
  {
    const double angle = kTurn * i / kCircleCorners;
    points.push_back(center + std::cos(angle) * first + std::sin(angle) * second);
  }
  return points;
}

/// Circle across @p along.
std::vector<Vec3> circleAcross(const Vec3& center, const Vec3& along, double radius)
{
  const Vec3 second = anyPerpendicular(along);
  return circle(center, radius * second, radius * cross(along, second));
}

} // namespace

/// Projects shapes for the present camera.
class TouchOutlines::Picture
{
public:
  Picture(vtkRenderer* renderer, double away)
    : project_(renderer)
    , away_(away)
  {
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->GetViewUp(&up_.x);
    Vec3 forward;
    camera->GetDirectionOfProjection(&forward.x);
    right_ = normalized(cross(forward, up_));
    up_ = cross(right_, forward); // the camera's own stays as it is
  }

  /// Adds the shape about @p points, unless one lies behind the camera.
  void add(const std::vector<Vec3>& points)
  {
    ScreenPolygon polygon;
    for (const Vec3& point : points)
    {
      const Pixel pixel = project_(point);
      if (!pixel.seen)
      {
        return;
      }
      polygon.push_back({ pixel.x, pixel.y });
    }
    shapes_.push_back(hullAbout(polygon, away_));
  }
  void addBall(const Vec3& center, double radius)
  {
    if (radius > 0.0)
    {
      this->add(circle(center, radius * right_, radius * up_));
    }
  }
  /// Adds the shape about two circles across the way between them.
  void addCone(const Vec3& begin, double beginRadius, const Vec3& end, double endRadius)
  {
    const Vec3 along = normalized(end - begin);
    std::vector<Vec3> points = circleAcross(begin, along, beginRadius);
    const std::vector<Vec3> others = circleAcross(end, along, endRadius);
    points.insert(points.end(), others.begin(), others.end());
    this->add(points);
  }
  std::vector<ScreenPolygon> takeShapes() { return std::exchange(shapes_, {}); }

  void addLine(MarkOutlines& outlines, const Vec3& from, const Vec3& to) const
  {
    const Pixel begin = project_(from);
    const Pixel end = project_(to);
    if (begin.seen && end.seen)
    {
      outlines.add({ { begin.x, begin.y }, { end.x, end.y } }, kYellow);
    }
  }

private:
  ScreenProjection project_;
  double away_;
  Vec3 right_;
  Vec3 up_;
  std::vector<ScreenPolygon> shapes_;
};

TouchOutlines::TouchOutlines(std::function<TouchMarks()> marks)
  : marks_(std::move(marks))
{
  onStart_->SetClientData(this);
  onStart_->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*) { static_cast<TouchOutlines*>(self)->place(); });
}

TouchOutlines::~TouchOutlines()
{
  if (renderer_)
  {
    this->removeFrom(renderer_);
  }
}

void TouchOutlines::addTo(vtkRenderer* renderer)
{
  renderer_ = renderer;
  outlines_.addTo(renderer);
  renderer->AddObserver(vtkCommand::StartEvent, onStart_, kLast);
}

void TouchOutlines::removeFrom(vtkRenderer* renderer)
{
  renderer->RemoveObserver(onStart_);
  outlines_.removeFrom(renderer);
  renderer_ = nullptr;
}

void TouchOutlines::place()
{
  if (!renderer_ || !renderer_->GetRenderWindow())
  {
    return;
  }
  const TouchMarks marks = marks_();
  const double pixels = renderer_->GetRenderWindow()->GetDPI() / kPointsPerInch;
  outlines_.clear(pixels, marks.width);
  Picture picture(renderer_, kAway * pixels * marks.width);
  // Sphere, arrow and normal have one outline; the hand, which lies in them, has its own.
  picture.addBall(marks.proxy, marks.proxyRadius);
  if (marks.tipRadius > 0.0)
  {
    picture.addCone(marks.arrowBegin, marks.shaftRadius, marks.arrowNeck, marks.shaftRadius);
    picture.addCone(marks.arrowNeck, marks.tipRadius, marks.arrowEnd, 0.0);
  }
  if (marks.normalBegin != marks.normalEnd)
  {
    picture.add({ marks.normalBegin, marks.normalEnd });
  }
  outlines_.addOutline(picture.takeShapes());
  picture.addBall(marks.hip, marks.hipRadius);
  outlines_.addOutline(picture.takeShapes());
  if (marks.ringRadius > 0.0)
  {
    const std::vector<Vec3> ring =
      circleAcross(marks.nearest, normalized(marks.hand - marks.nearest), marks.ringRadius);
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
      picture.addLine(outlines_, ring[i], ring[(i + 1) % ring.size()]);
    }
    picture.addLine(outlines_, marks.nearest, marks.hand);
  }
  outlines_.finish();
}

} // namespace pointhaptics
