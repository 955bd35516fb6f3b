#include "Benchmark/Commands/BenchModelMover.h"

#include "Benchmark/Scenery/SceneWindow.h"

#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"

#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

namespace pointhaptics
{
namespace app
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr auto kTimerPeriod = std::chrono::milliseconds(33);
constexpr auto kLookPeriod = std::chrono::microseconds(200);
constexpr auto kLongestWait = std::chrono::seconds(10);
/// Of the hand in front of the surface, and in it when it touches; metres.
constexpr double kHandBefore = 0.005;
constexpr double kHandDepth = 0.001;
/// After a scene: the picture is refined, and the next key meets a window at rest or not.
constexpr double kPauseSeconds[2] = { 0.05, 0.35 };

double seconds()
{
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

class WindowMover : public bench::render::ModelMover
{
public:
  bool open(const std::string& file, int width, int height, std::string& message)
  {
    if (!view_.open(file, width, height, message))
    {
      return false;
    }
    interactor_->SetRenderWindow(view_.window());
    ViewScene& scene = view_.scene();
    scene.detail().setEnabled(true);
    SimulatedHandSettings hand;
    const Vec3 touched = this->frontOfCloud();
    const Vec3 front = scene.towardsViewer();
    hand.start = touched + kHandBefore * front;
    hand.yieldsToForce = false;
    hand_ = std::make_unique<SimulatedDevice>(hand);
    double bounds[6];
    scene.getWorkspaceBounds(bounds);
    style_->SetWorkspaceBounds(bounds);
    style_->SetModelMatrix(scene.modelMatrix());
    style_->SetResampler(scene.resampler());
    style_->SetBandwidthFilter(scene.bandwidth());
    style_->SetCloudActor(scene.actor());
    style_->SetProps(scene.props());
    style_->SetServoLoop(&servo_);
    style_->SetDefaultRenderer(scene.renderer());
    interactor_->SetInteractorStyle(style_);
    style_->UpdateModel();
    view_.window()->Render();
    interactor_->Initialize();
    style_->StartUpdates();
    if (hand_->open() != Status::Ok || servo_.start(*hand_, HapticParameters(), {}, &message) != Status::Ok)
    {
      message = "the servo loop cannot be started: " + message;
      return false;
    }
    watch_ = std::thread([this] { this->watch(); });
    this->goOn(0.5);
    hand_->setTarget(touched - kHandDepth * front);
    this->goOn(0.5);
    if (!servo_.latest().state.contact)
    {
      message = "the hand does not touch the cloud";
      return false;
    }
    return true;
  }

  ~WindowMover() override
  {
    ending_ = true;
    if (watch_.joinable())
    {
      watch_.join();
    }
    style_->StopUpdates();
    style_->SetServoLoop(nullptr);
    servo_.stop();
  }

  Response press(const char* key) override
  {
    this->goOn(std::uniform_real_distribution<double>(kPauseSeconds[0], kPauseSeconds[1])(random_));
    const std::uint64_t before = scenes_;
    firstScene_ = before;
    for (std::atomic<double>& time : takenAt_)
    {
      time = -1.0;
    }
    const double pressed = seconds();
    interactor_->SetKeyEventInformation(0, 0, 0, 0, key);
    interactor_->InvokeEvent(vtkCommand::KeyPressEvent);
    const Clock::time_point end = Clock::now() + kLongestWait;
    while ((scenes_ < before + 2 || style_->IsModelChanged()) && Clock::now() < end)
    {
      this->goOn(0.0);
    }
    Response response{ -1.0, -1.0, -1.0 };
    if (scenes_ >= before + 2)
    {
      response.movedSeconds = takenAt_[0] - pressed;
      response.nearSeconds = takenAt_[1] - pressed;
      response.wholeSeconds = takenAt_[scenes_ >= before + 3 ? 2 : 1] - pressed;
    }
    return response;
  }

private:
  /// What the window's event loop does, for so long or until its timer was due once.
  void goOn(double length)
  {
    const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(length));
    do
    {
      std::this_thread::sleep_until(length > 0.0 ? std::min(due_, end) : due_);
      if (Clock::now() >= due_)
      {
        due_ = Clock::now() + kTimerPeriod;
        style_->Refresh();
        if (view_.scene().detail().refinementDue(seconds()))
        {
          view_.window()->Render();
        }
      }
    } while (Clock::now() < end);
  }

  void watch()
  {
    while (!ending_)
    {
      const std::uint64_t scenes = servo_.latest().scenes;
      if (scenes != scenes_)
      {
        // Of two within one look the former is as late as the latter.
        const double now = seconds();
        for (std::uint64_t i = scenes_ - firstScene_; i < scenes - firstScene_ && i < 3; ++i)
        {
          takenAt_[i] = now;
        }
        scenes_ = scenes;
      }
      std::this_thread::sleep_for(kLookPeriod);
    }
  }

  /// The mean nearest to the middle of the workspace's front.
  Vec3 frontOfCloud()
  {
    const Bounds& workspace = view_.scene().workspace();
    const Vec3 front = workspace.center() + 0.5 * norm(workspace.extent()) * view_.scene().towardsViewer();
    vtkPolyData* means = view_.scene().bandwidth()->GetOutput();
    Vec3 nearest = workspace.center();
    double best = INFINITY;
    for (vtkIdType i = 0; i < means->GetNumberOfPoints(); ++i)
    {
      Vec3 mean;
      means->GetPoint(i, &mean.x);
      const double distance = norm2(mean - front);
      nearest = distance < best ? mean : nearest;
      best = std::min(best, distance);
    }
    return nearest;
  }

  SceneWindow view_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleHaptic> style_;
  std::unique_ptr<SimulatedDevice> hand_;
  ServoLoop servo_;
  std::mt19937 random_{ 8 };
  Clock::time_point due_ = Clock::now();
  std::atomic<std::uint64_t> scenes_{ 0 };
  std::atomic<std::uint64_t> firstScene_{ 0 };
  std::atomic<double> takenAt_[3]{}; ///< The scenes after the key: moved, near the hand, whole.
  std::atomic<bool> ending_{ false };
  std::thread watch_;
};

} // namespace

std::unique_ptr<bench::render::ModelMover> makeModelMover(
  const std::string& file, int width, int height, std::string& message)
{
  auto mover = std::make_unique<WindowMover>();
  const bool opened = mover->open(file, width, height, message);
  return std::unique_ptr<bench::render::ModelMover>(opened ? std::move(mover) : nullptr);
}

} // namespace app
} // namespace pointhaptics
