#include "Benchmark/Render/Turntable.h"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <chrono>
#include <thread>

namespace pointhaptics::bench::render
{

Turntable::~Turntable()
{
  window_->RemoveRenderer(scene_.renderer());
}

bool Turntable::open(const std::string& file, int width, int height, std::string& message)
{
  LoadedCloud loaded;
  const HapticViewerOptions options;
  const CloudRequest request({ file }, options);
  if (!loadCloud(
        request, [](const char*, double) { return true; }, loaded, message) ||
    !scene_.open(std::move(loaded), options, message))
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

std::string Turntable::kind() const
{
  return cloudKindName(scene_.shown()->look.kind);
}

void Turntable::setDetail(bool on)
{
  scene_.detail().setEnabled(on);
}

void Turntable::turn(double degrees)
{
  scene_.renderer()->GetActiveCamera()->Azimuth(degrees);
  this->render();
}

int Turntable::rest()
{
  int frames = 0;
  std::this_thread::sleep_for(std::chrono::duration<double>(LevelOfDetail::kRestSeconds));
  for (; !this->showsAll() && frames < 100; ++frames)
  {
    this->render();
  }
  return frames;
}

void Turntable::turnToStill(double degrees)
{
  scene_.detail().showFinestOnce();
  this->turn(degrees);
}

bool Turntable::showsAll() const
{
  return scene_.detail().showsAll();
}

std::int64_t Turntable::allPoints() const
{
  return scene_.detail().allPoints();
}

std::int64_t Turntable::drawnPoints() const
{
  return scene_.detail().drawnPoints();
}

void Turntable::render()
{
  scene_.renderer()->ResetCameraClippingRange();
  window_->Render();
  window_->WaitForCompletion();
}

} // namespace pointhaptics::bench::render
