#include "BenchModelMover.h"

#include "ViewScene.h"

#include "vtkInteractorStyleHaptic.h"

#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <atomic>
#include <chrono>
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
    ViewOptions options;
    options.files = { file };
    if (!scene_.open(options.files, options, message) || !scene_.build(options, message))
    {
      return false;
    }
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(width, height);
    window_->AddRenderer(scene_.renderer());
    interactor_->SetRenderWindow(window_);
    scene_.detail().setEnabled(true);
    scene_.placeCamera();
    SimulatedHandSettings hand;
    hand.start = { 0.0, 0.0, 0.049 };
    hand_ = std::make_unique<SimulatedDevice>(hand);
    double bounds[6];
    scene_.getWorkspaceBounds(bounds);
    style_->SetWorkspaceBounds(bounds);
    style_->SetModelMatrix(scene_.modelMatrix());
    style_->SetResampler(scene_.resampler());
    style_->SetBandwidthFilter(scene_.bandwidth());
    style_->SetCloudActor(scene_.actor());
    style_->SetProps(scene_.props());
    style_->SetServoLoop(&servo_);
    style_->SetDefaultRenderer(scene_.renderer());
    interactor_->SetInteractorStyle(style_);
    style_->UpdateModel();
    window_->Render();
    interactor_->Initialize();
    style_->StartUpdates();
    if (hand_->open() != Status::Ok || servo_.start(*hand_, HapticParameters(), {}, &message) != Status::Ok)
    {
      message = "the servo loop cannot be started: " + message;
      return false;
    }
    watch_ = std::thread([this] { this->watch(); });
    this->goOn(1.0);
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
    window_->RemoveRenderer(scene_.renderer());
  }

  Response press(const char* key) override
  {
    this->goOn(std::uniform_real_distribution<double>(kPauseSeconds[0], kPauseSeconds[1])(random_));
    const std::uint64_t before = scenes_;
    movedAt_ = takenAt_ = -1.0;
    const double pressed = seconds();
    interactor_->SetKeyEventInformation(0, 0, 0, 0, key);
    interactor_->InvokeEvent(vtkCommand::KeyPressEvent);
    const Clock::time_point end = Clock::now() + kLongestWait;
    while ((scenes_ < before + 2 || style_->IsModelChanged()) && Clock::now() < end)
    {
      this->goOn(0.0);
    }
    const bool came = scenes_ >= before + 2;
    return { came ? movedAt_ - pressed : -1.0, came ? takenAt_ - pressed : -1.0 };
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
        if (scene_.detail().refinementDue(seconds()))
        {
          window_->Render();
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
        takenAt_ = seconds();
        movedAt_ = movedAt_ < 0.0 ? takenAt_.load() : movedAt_.load();
        scenes_ = scenes;
      }
      std::this_thread::sleep_for(kLookPeriod);
    }
  }

  ViewScene scene_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleHaptic> style_;
  std::unique_ptr<SimulatedDevice> hand_;
  ServoLoop servo_;
  std::mt19937 random_{ 8 };
  Clock::time_point due_ = Clock::now();
  std::atomic<std::uint64_t> scenes_{ 0 };
  std::atomic<double> movedAt_{ -1.0 }; ///< The first scene after the key, and the last one.
  std::atomic<double> takenAt_{ -1.0 };
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
