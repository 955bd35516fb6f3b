#include "ViewPicture.h"

#include "HapticViewer.h"
#include "PngFile.h"
#include "StereoPicture.h"
#include "ViewScene.h"

#include "vtkHapticProps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkSmartPointer.h>
#include <vtkWindowToImageFilter.h>

namespace pointhaptics
{
namespace
{

vtkSmartPointer<vtkImageData> grab(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  grabber->ShouldRerenderOff();
  grabber->Update();
  return grabber->GetOutput();
}

std::vector<vtkSmartPointer<vtkRenderer>> renderersOf(vtkRenderWindow* window)
{
  std::vector<vtkSmartPointer<vtkRenderer>> renderers;
  vtkCollectionSimpleIterator place;
  window->GetRenderers()->InitTraversal(place);
  while (vtkRenderer* renderer = window->GetRenderers()->GetNextRenderer(place))
  {
    renderers.emplace_back(renderer);
  }
  return renderers;
}

/// Replaces the background by one grey, and restores it.
class PlainGround
{
public:
  explicit PlainGround(vtkRenderer* renderer)
    : renderer_(renderer)
    , isGradient_(renderer->GetGradientBackground())
  {
    renderer->GetBackground(color_.data());
  }
  void set(double grey)
  {
    renderer_->GradientBackgroundOff();
    renderer_->SetBackground(grey, grey, grey);
  }
  void restore()
  {
    renderer_->SetGradientBackground(isGradient_);
    renderer_->SetBackground(color_.data());
  }

private:
  vtkRenderer* renderer_;
  bool isGradient_;
  std::array<double, 3> color_{};
};

/// Returns the image with alpha that gives @p black over black and @p white over white: each colour keeps the
/// part that is not the background's.
vtkSmartPointer<vtkImageData> withoutGround(vtkImageData* black, vtkImageData* white)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(black->GetDimensions());
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const vtkIdType pixels = image->GetNumberOfPoints();
  const auto* over = static_cast<const unsigned char*>(black->GetScalarPointer());
  const auto* under = static_cast<const unsigned char*>(white->GetScalarPointer());
  auto* out = static_cast<unsigned char*>(image->GetScalarPointer());
  for (vtkIdType i = 0; i < pixels; ++i, over += 3, under += 3, out += 4)
  {
    int through = 255;
    for (int c = 0; c < 3; ++c)
    {
      through = std::min(through, std::max(0, under[c] - over[c]));
    }
    const int opacity = 255 - through;
    for (int c = 0; c < 3; ++c)
    {
      out[c] =
        static_cast<unsigned char>(opacity > 0 ? std::min(255, (over[c] * 255 + opacity / 2) / opacity) : 0);
    }
    out[3] = static_cast<unsigned char>(opacity);
  }
  return image;
}

vtkSmartPointer<vtkImageData> grabWithoutGround(vtkRenderWindow* window, const std::function<void()>& render)
{
  std::vector<PlainGround> grounds;
  for (const auto& renderer : renderersOf(window))
  {
    grounds.emplace_back(renderer);
  }
  std::array<vtkSmartPointer<vtkImageData>, 2> images;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    for (PlainGround& ground : grounds)
    {
      ground.set(double(i));
    }
    render();
    images[i] = grab(window);
  }
  for (PlainGround& ground : grounds)
  {
    ground.restore();
  }
  return withoutGround(images[0], images[1]);
}

} // namespace

bool writePicture(vtkRenderWindow* window, const std::function<void()>& render, bool transparent,
  const std::string& fileName, std::string& message)
{
  vtkSmartPointer<vtkImageData> image = transparent ? grabWithoutGround(window, render) : nullptr;
  render(); // also what the window goes on to show
  image = image ? image : grab(window);
  return writePng(image, fileName, message);
}

namespace
{

/// Moves all renderers from @p from to @p to. Graphics resources belong to a window and are released.
void moveRenderers(vtkRenderWindow* from, vtkRenderWindow* to)
{
  for (const auto& renderer : renderersOf(from))
  {
    from->RemoveRenderer(renderer);
    to->AddRenderer(renderer);
  }
}

double aspectOf(const int* size)
{
  return double(size[0]) / std::max(1, size[1]);
}

/// Makes the view of @p camera @p factor times as high.
void widenView(vtkCamera* camera, double factor)
{
  constexpr double kHalfDegree = 0.5 * 3.14159265358979323846 / 180.0;
  camera->SetViewAngle(std::atan(factor * std::tan(camera->GetViewAngle() * kHalfDegree)) / kHalfDegree);
  camera->SetParallelScale(factor * camera->GetParallelScale());
}

} // namespace

bool writePictureOfSize(vtkRenderWindow* window, vtkCamera* camera, const std::array<int, 2>& size,
  const std::function<void(vtkRenderWindow*)>& render, bool transparent, const std::string& fileName,
  std::string& message)
{
  const double angle = camera->GetViewAngle();
  const double scale = camera->GetParallelScale();
  const double factor = std::max(1.0, aspectOf(window->GetSize()) / aspectOf(size.data()));
  vtkNew<vtkRenderWindow> other;
  other->SetOffScreenRendering(1);
  other->SetMultiSamples(0);
  other->SetSize(size[0], size[1]);
  other->SetNumberOfLayers(window->GetNumberOfLayers());
  other->SetStereoType(window->GetStereoType());
  other->SetStereoRender(window->GetStereoRender() && window->GetStereoType() != VTK_STEREO_CRYSTAL_EYES);
  if (factor > 1.0)
  {
    widenView(camera, factor);
  }
  moveRenderers(window, other);
  const bool isWritten = writePicture(
    other, [&render, &other] { render(other); }, transparent, fileName, message);
  moveRenderers(other, window);
  if (factor > 1.0)
  {
    camera->SetViewAngle(angle);
    camera->SetParallelScale(scale);
  }
  window->Render();
  return isWritten;
}

namespace
{

/// Warns if a picture shows one eye alone though two were asked for.
void checkStereo(vtkRenderWindow* window, const std::string& stereo, const HapticViewerObserver& observer)
{
  if (!window->GetStereoRender() && stereo != stereoNames().front())
  {
    observer.say(HapticViewerObserver::Kind::Warning,
      fmt::format("stereo: {} needs a screen that shows two pictures; this one is for one eye", stereo));
  }
}

/// Writes pictures once about the cloud in equal steps, beginning with the present view.
bool writeTurntable(ViewScene& scene, const std::function<bool(const std::string&)>& write, int pictures,
  const HapticViewerObserver& observer, const std::string& fileName, std::string& message)
{
  for (int i = 1; i <= pictures; ++i)
  {
    if (observer.stops())
    {
      message = fmt::format(
        "{}: the turntable was stopped on request, after {} of {} pictures", fileName, i - 1, pictures);
      return false;
    }
    if (!write(HapticViewer::pictureName(fileName, i, pictures)))
    {
      return false;
    }
    scene.turnView(360.0 / pictures);
  }
  return true;
}

} // namespace

bool makePicture(ViewScene& scene, const HapticViewerOptions& options, const HapticViewerObserver& observer,
  const std::optional<ServoSample>& shown, const std::string& fileName, std::string& message)
{
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  const bool hasSize = options.picture.screenshotSize[0] > 0;
  const int width = hasSize ? options.picture.screenshotSize[0] : options.width;
  const int height = hasSize ? options.picture.screenshotSize[1] : options.height;
  window->SetSize(width, height);
  window->AddRenderer(scene.renderer());
  if (shown)
  {
    scene.props()->Update(shown->state);
  }
  scene.showAmbient(options.ambient);
  scene.setPicture(options.picture);
  scene.completeMeans(options.voxels.computeCovariance);
  scene.followMeasurement(true);
  scene.detail().setEnabled(true);
  scene.showAxes(options.axes);
  scene.showFigure(options.figure);
  scene.placeAxes(scene.modelMatrix());
  scene.placeCamera(shown ? &shown->state : nullptr);
  scene.setCamera(options.camera);
  checkStereo(window, options.picture.stereo, observer);
  const auto render = [&]
  {
    scene.detail().showFinestOnce();
    window->Render();
  };
  const auto write = [&](const std::string& name)
  {
    const std::string place = observer.placeOf ? observer.placeOf(name) : name;
    return writePicture(window, render, options.picture.transparent, place, message);
  };
  const int pictures = options.turntable;
  const bool isWritten =
    pictures > 0 ? writeTurntable(scene, write, pictures, observer, fileName, message) : write(fileName);
  window->RemoveRenderer(scene.renderer());
  if (!isWritten)
  {
    return false;
  }
  const std::string names = pictures > 0 ? HapticViewer::pictureName(fileName, 1, pictures) + " to " +
      HapticViewer::pictureName(fileName, pictures, pictures)
                                         : fileName;
  observer.say(HapticViewerObserver::Kind::Note, fmt::format("screenshot: {} ({}x{})", names, width, height));
  if (const std::vector<std::string> words = scene.measuredText(); !words.empty())
  {
    observer.say(HapticViewerObserver::Kind::Note, "  distance: " + words.front() + "; " + words.back());
  }
  if (shown)
  {
    observer.say(HapticViewerObserver::Kind::Note,
      fmt::format("  shows t = {:.3f} s: {}, force {:.3f} N, proxy radius {:.3f} mm", shown->timeSeconds,
        shown->state.contact ? "in contact" : "no contact along the whole path", norm(shown->state.force),
        1e3 * shown->state.radius));
  }
  return true;
}

} // namespace pointhaptics
