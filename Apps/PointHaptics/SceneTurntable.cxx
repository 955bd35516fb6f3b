#include "SceneTurntable.h"

#include "ViewScene.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <chrono>
#include <thread>

namespace pointhaptics
{
namespace app
{
namespace
{

/// The viewer's scene in a window of its own.
class SceneTurntable : public bench::render::Turntable
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
    scene_.placeCamera();
    this->render();
    return true;
  }

  ~SceneTurntable() override { window_->RemoveRenderer(scene_.renderer()); }

  void setDetail(bool on) override { scene_.detail().setEnabled(on); }

  void turn(double degrees) override
  {
    scene_.renderer()->GetActiveCamera()->Azimuth(degrees);
    this->render();
  }

  int rest() override
  {
    int frames = 0;
    std::this_thread::sleep_for(std::chrono::duration<double>(CloudDetail::kRestSeconds));
    for (; !scene_.detail().showsAll() && frames < 100; ++frames)
    {
      this->render();
    }
    return frames;
  }

  std::int64_t allPoints() const override { return scene_.detail().allPoints(); }
  std::int64_t drawnPoints() const override { return scene_.detail().drawnPoints(); }

private:
  void render()
  {
    scene_.renderer()->ResetCameraClippingRange();
    window_->Render();
    window_->WaitForCompletion();
  }

  ViewScene scene_;
  vtkNew<vtkRenderWindow> window_;
};

} // namespace

std::unique_ptr<bench::render::Turntable> makeSceneTurntable(
  const std::string& file, int width, int height, std::string& message)
{
  auto table = std::make_unique<SceneTurntable>();
  const bool opened = table->open(file, width, height, message);
  return opened ? std::move(table) : nullptr;
}

} // namespace app
} // namespace pointhaptics
