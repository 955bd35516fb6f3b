#include "Benchmark/Scenery/SceneTurntable.h"

#include "Benchmark/Scenery/SceneWindow.h"

#include "vtkDepthShadingPass.h"
#include "vtkSplatMapper.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkRenderPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <chrono>
#include <thread>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kDiscPixels = 3.0;

/// The viewer's scene in a window of its own.
class SceneTurntable : public bench::render::Turntable
{
public:
  bool open(const std::string& file, int width, int height, std::string& message)
  {
    if (!view_.open(file, width, height, message))
    {
      return false;
    }
    pass_ = view_.scene().renderer()->GetPass();
    this->render();
    return true;
  }

  std::string kind() const override { return cloudKindName(view_.scene().shown()->look.kind); }

  void setEffects(bench::render::Effect last) override
  {
    using bench::render::Effect;
    vtkRenderer* renderer = view_.scene().renderer();
    auto* splats = vtkSplatMapper::SafeDownCast(view_.scene().pointsActor()->GetMapper());
    splats->SetFixedPixels(last >= Effect::Sizes ? 0.0 : kDiscPixels);
    splats->SetAmbientLight(last >= Effect::Tilt);
    splats->SetSurfaces(last >= Effect::Tilt);
    renderer->SetPass(pass_);
    if (last < Effect::Shading)
    {
      renderer->SetPass(nullptr);
    }
  }

  void turnToStill(double degrees) override
  {
    view_.scene().completeNextFrame();
    this->turn(degrees);
  }

  void setDetail(bool on) override { view_.scene().detail().setEnabled(on); }

  void turn(double degrees) override
  {
    view_.scene().renderer()->GetActiveCamera()->Azimuth(degrees);
    this->render();
  }

  int rest() override
  {
    int frames = 0;
    std::this_thread::sleep_for(std::chrono::duration<double>(LevelOfDetail::kRestSeconds));
    for (; !view_.scene().detail().showsAll() && frames < 100; ++frames)
    {
      this->render();
    }
    return frames;
  }

  std::int64_t allPoints() const override { return view_.scene().detail().allPoints(); }
  std::int64_t drawnPoints() const override { return view_.scene().detail().drawnPoints(); }

private:
  void render()
  {
    view_.scene().renderer()->ResetCameraClippingRange();
    view_.window()->Render();
    view_.window()->WaitForCompletion();
  }

  SceneWindow view_;
  vtkSmartPointer<vtkRenderPass> pass_; ///< Of all effects.
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
