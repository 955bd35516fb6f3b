/// @file
/// Draws fewer points while the picture moves, so that it keeps moving, and all of them when it rests.
#pragma once

#include "EventLink.h"
#include "FrameBudget.h"
#include "ProgressiveOrder.h"
#include "SplatBricks.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

class vtkActor;
class vtkPolyData;
class vtkProperty;
class vtkRenderWindow;
class vtkRenderer;
class vtkSplatMapper;

namespace pointhaptics
{

/// Stands beside the actor of a cloud in a renderer. A frame that differs from the last one by its camera,
/// its cloud or another actor is drawn with as many points, in progressiveOrder(), as fit the frame budget,
/// which is learnt from the times such frames take; the splats grow so that surfaces stay closed. After
/// kRestSeconds without such a frame refinementDue() asks for frames with four times as many points each,
/// until the cloud's own actor is drawn: the picture at rest is the one without this class. Of the splats
/// only the bricks in view, and in the workspace if there is one, are drawn in such a frame, and only they
/// count: a part of the cloud seen from near by is shown with more points. In the picture at rest what is out
/// of view is left out too, which changes no pixel. From so far that several points share a pixel
/// the picture is as fine as it gets with a part of the points: the others are neither drawn nor
/// uploaded. Text may change without the detail changing. Points are uploaded when they are first drawn.
///
/// The picture only gets finer when somebody renders: call refinementDue() from a timer. A frame that its
/// window gives up (vtkRenderWindow::SetAbortRender()) does not count, and is due again. GUI thread only. To
/// be destroyed before the actor's renderer.
class POINTHAPTICSRENDERING_EXPORT LevelOfDetail
{
public:
  static constexpr double kRestSeconds = 0.15;

  /// @param actor draws the whole cloud with a vtkSplatMapper, in @p renderer.
  LevelOfDetail(vtkRenderer* renderer, vtkActor* actor);
  ~LevelOfDetail();
  LevelOfDetail(const LevelOfDetail&) = delete;
  LevelOfDetail& operator=(const LevelOfDetail&) = delete;

  /// Sets a box in the frame of the scene; nothing outside is drawn while the picture moves. Default: none.
  void setWorkspace(const Bounds& box) { workspace_ = box; }
  /// Enables it. If it is off (the default), every frame shows all points.
  void setEnabled(bool enabled);
  bool isEnabled() const { return enabled_; }

  /// Chooses the points of the coming frame. Call it when the renderer starts (vtkCommand::StartEvent), after
  /// the cloud was brought up to date. @param now seconds of a steady clock.
  void beginFrame(double now);

  /// True if the picture rests and can become finer: render it.
  bool refinementDue(double now) const;
  /// Seconds for which the present frame at rest has been drawn. None: it belongs to a motion, or must be
  /// kept, so it must not be given up.
  std::optional<double> restingFrame() const;
  /// Gives it progressiveOrder() of the cloud's points. If it is null
  /// or has another size, the order is made here when it is first needed.
  void setOrder(std::shared_ptr<const ProgressiveOrder> order) { givenOrder_ = std::move(order); }
  /// Makes the next frame as fine as possible, whatever moves: for pictures that are kept.
  void showFinestOnce() { finestOnce_ = true; }

  /// Notes that the actor's mapper has other colours or hides others. After a picture at rest the next one is
  /// at rest, too, if it takes two seconds at most, as after a change of the viewport: splats that grow for a
  /// moment look like another object.
  void recolor();

  /// True if the last frame was as fine as possible: all points, but for those below a pixel.
  bool showsAll() const { return drawn_ >= finest_; }
  /// True if the last frame was as fine as possible and at rest: vtkDepthShadingPass blends its splats.
  bool isFinest() const { return !inMotion_ && this->showsAll(); }
  bool isMoving() const { return moving_; }
  /// True if the frame belongs to a motion: a better one of the same view comes after kRestSeconds.
  bool isInMotion() const { return inMotion_; }
  /// Number of points in the last frame, with those out of view; and without them.
  std::int64_t drawnPoints() const { return drawn_; }
  std::int64_t visiblePoints() const { return visible_; }
  std::int64_t allPoints() const { return total_; }
  /// Number of points that are kept beside the cloud, for pictures with a part of them; at most a quarter of
  /// all after a picture that went from few points to all.
  std::int64_t keptPoints() const { return levels_.empty() ? 0 : levels_.back().end; }
  /// Rough number of pixels that the splats in view cover, each on its own.
  double fragments() const;
  const FrameBudget& budget() const { return budget_; }

private:
  struct Level
  {
    std::int64_t end = 0; // points in this level and those before
    vtkSmartPointer<vtkActor> actor;
    vtkSmartPointer<vtkSplatMapper> splats;
    std::vector<SplatBrick> bricks;
    double largestLength = 0.0; // of a splat, in the array
  };

  vtkSplatMapper* splats() const;
  void watchWindow();
  void endFrame();
  bool sceneChanged(vtkPolyData* cloud);
  std::int64_t wanted(double now);
  const ProgressiveOrder& order(vtkPolyData* cloud);
  ProgressiveOrder::Step stepFor(vtkPolyData* cloud, std::int64_t points);
  void show(vtkPolyData* cloud, std::int64_t points);
  void addLevel(vtkPolyData* cloud);
  void cullOutsideFrustum();
  void leaveOutOfView(vtkPolyData* cloud);
  std::vector<HalfSpace> sides(double pixels) const;
  std::vector<HalfSpace> view() const;
  std::int64_t finestFor(vtkPolyData* cloud);
  void removeLevels();
  void dropLevels();

  vtkWeakPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkActor> actor_;
  vtkNew<vtkProperty> coarse_;
  EventLink onEnd_{ [this] { this->endFrame(); } };
  vtkWeakPointer<vtkRenderWindow> window_;
  std::shared_ptr<const ProgressiveOrder> givenOrder_;
  std::shared_ptr<const ProgressiveOrder> order_;
  std::vector<Level> levels_;
  FrameBudget budget_;
  bool enabled_ = false;
  bool finestOnce_ = false;
  bool isKept_ = false; // it was asked for the frame that is drawn
  bool moving_ = false;
  bool inMotion_ = false;
  bool cloudChanged_ = false;
  bool isRecolored_ = false;
  double height_ = 1.0;          // part of the window, in the last frame
  bool frameIsTypical_ = false;  // nothing is uploaded in it
  std::vector<SplatBrick> rows_; // of the whole cloud, in its order
  bool hasRows_ = false;         // and they were made
  std::int64_t total_ = 0;
  std::int64_t finest_ = 0; // so many points tell apart what pixels can
  std::int64_t drawn_ = 0;
  std::int64_t before_ = 0; // the same of the frame before
  std::int64_t visible_ = 0;
  Bounds workspace_;
  double lastMotion_ = -1e9;
  double frameBegin_ = 0.0;
  unsigned long long cloudTime_ = 0;
  unsigned long long propsTime_ = 0;
  std::vector<double> placement_; // of camera, cloud and window, in the last frame
};

} // namespace pointhaptics
