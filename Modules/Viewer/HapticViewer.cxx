#include "HapticViewer.h"

#include "CloudFiles.h"
#include "CloudLoader.h"
#include "ViewDisplay.h"
#include "ViewPicture.h"
#include "ViewScene.h"
#include "ViewTouch.h"
#include "ViewWindow.h"

#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr double kLookPeriod = 0.05;

class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

/// Adds the name of the file to @p message where it lacks it.
std::string withTitle(const std::string& title, const std::string& message)
{
  return message.find(title) == std::string::npos ? title + ": " + message : message;
}

} // namespace

struct HapticViewer::Implementation
{
  Implementation(HapticViewerOptions givenOptions, HapticViewerObserver givenObserver)
    : options(std::move(givenOptions))
    , observer(std::move(givenObserver))
  {
  }

  HapticViewerOptions options;
  const HapticViewerObserver observer;
  ViewScene scene;
  std::vector<std::string> files;
  std::size_t cloud = 0; ///< Index of the shown file.
  std::string news;      ///< Files that were skipped before it; empty: none.
  bool isOpen = false;
  bool isCancelled = false;
  std::optional<ServoSample> felt; ///< Sample of the path that a picture shows.
  double readSeconds = 0.0;
  double resampleSeconds = 0.0;
  std::string message;
  std::unique_ptr<ViewWindow> window;

  ViewWindow& theWindow();
  bool fail(const std::string& text);
  bool hasCloud();
  bool isDrawable();
  bool await(const CloudLoader& loader, const std::string& title);
  bool awaitWithoutWindow(const CloudLoader& loader);
  bool read(CloudRequest request, LoadedCloud& loaded);
  bool readFirst(LoadedCloud& loaded);
  bool show(LoadedCloud loaded);
  void skip(const std::string& title);
};

/// The window, made at its first use.
ViewWindow& HapticViewer::Implementation::theWindow()
{
  if (!this->window)
  {
    this->window = std::make_unique<ViewWindow>(this->scene, this->options, this->observer, this->files);
  }
  return *this->window;
}

bool HapticViewer::Implementation::fail(const std::string& text)
{
  this->message = text;
  return false;
}

bool HapticViewer::Implementation::hasCloud()
{
  return this->isOpen || this->fail("no cloud is open; open one first");
}

bool HapticViewer::Implementation::isDrawable()
{
  return this->hasCloud() && displayIsAvailable(this->message, this->scene.numberOfPoints());
}

bool HapticViewer::Implementation::awaitWithoutWindow(const CloudLoader& loader)
{
  bool stops = false;
  while (!stops && !loader.waitFor(kLookPeriod))
  {
    stops = this->observer.stops();
    if (this->observer.progress)
    {
      const CloudLoader::Step step = loader.step();
      this->observer.progress(step.name, std::min(step.part, kAlmostDone));
    }
  }
  if (this->observer.progress)
  {
    this->observer.progress("reading", 1.0);
  }
  return !stops;
}

/// Waits until the loader has a result. False: the user gave it up.
bool HapticViewer::Implementation::await(const CloudLoader& loader, const std::string& title)
{
  std::string ignored;
  const bool shows = this->window ||
    (this->options.showsReading && !loader.waitFor(kProgressDelay) && displayIsAvailable(ignored));
  const bool isRead = shows ? this->theWindow().awaitCloud(loader, title) : this->awaitWithoutWindow(loader);
  this->isCancelled = !isRead;
  return isRead || this->fail(title + ": reading was stopped on request; nothing is shown");
}

/// Warns of a file that cannot be shown, where there are others.
void HapticViewer::Implementation::skip(const std::string& title)
{
  const std::string why = withTitle(title, this->message);
  this->news = this->cloud == 0 ? "skipped: " + why
                                : fmt::format("{} files are skipped; the last: {}", this->cloud + 1, why);
  this->observer.say(HapticViewerObserver::Kind::Warning, "skipped: " + why);
}

/// Reads in the loader's thread, without any message of what fails.
bool HapticViewer::Implementation::read(CloudRequest request, LoadedCloud& loaded)
{
  request.measuresLater = this->options.showsReading;
  request.resamplesLater = this->options.showsReading || !this->options.makesMeans;
  // A recording needs all points.
  const bool needsAll = !this->options.replay.empty() || !this->options.record.empty();
  request.mostPoints = this->options.showsReading && !needsAll ? this->options.coarsePoints : 0;
  request.makesScene = this->options.showsReading || this->options.followsFile();
  const std::string title = request.name();
  CloudLoader loader;
  loader.start(std::move(request));
  if (!this->await(loader, title))
  {
    return false;
  }
  loader.take(loaded, this->message);
  return this->message.empty();
}

/// Reads one cloud after the other until one can be shown.
bool HapticViewer::Implementation::readFirst(LoadedCloud& loaded)
{
  const std::size_t count = this->options.together ? 1 : this->files.size();
  this->news.clear();
  for (this->cloud = 0; this->cloud < count; ++this->cloud)
  {
    const std::vector<std::string> shown =
      this->options.together ? this->files : std::vector<std::string>{ this->files[this->cloud] };
    CloudRequest request(shown, this->options);
    const std::string up = this->observer.upOf ? this->observer.upOf(shown.front()) : std::string();
    request.options.up = up.empty() || this->options.up != "auto" ? this->options.up : up;
    if (this->read(std::move(request), loaded))
    {
      return true;
    }
    if (this->isCancelled || count == 1)
    {
      return false;
    }
    this->skip(titleOf(shown));
  }
  return this->fail(fmt::format("none of the {} files can be shown; mend one of them, see above", count));
}

bool HapticViewer::Implementation::show(LoadedCloud loaded)
{
  this->felt.reset();
  this->resampleSeconds = loaded.resampleSeconds;
  this->readSeconds -= loaded.resampleSeconds;
  for (const std::string& note : loaded.notes)
  {
    this->observer.say(HapticViewerObserver::Kind::Warning, note);
  }
  this->news += (this->news.empty() || loaded.notes.empty() ? "" : "\n") + shortNote(loaded.notes);
  this->isOpen = this->scene.open(std::move(loaded), this->options, this->message);
  this->options.picture.hidden = this->scene.picture().hidden; // as the arrays are written
  // Errors of VTK classes come first, since they may be the cause.
  const std::vector<std::string> errors =
    this->observer.takeVtkErrors ? this->observer.takeVtkErrors() : std::vector<std::string>();
  this->isOpen = errors.empty() ? this->isOpen : this->fail(errors.front());
  return this->isOpen;
}

HapticViewer::HapticViewer(HapticViewerOptions options, HapticViewerObserver observer)
  : implementation_(std::make_unique<Implementation>(std::move(options), std::move(observer)))
{
}

HapticViewer::~HapticViewer() = default;

bool HapticViewer::open(const std::vector<std::string>& files)
{
  Implementation& self = *implementation_;
  self.files = files;
  self.isCancelled = false;
  if (files.empty())
  {
    return self.fail("no file is named; give one");
  }
  const Stopwatch reading;
  LoadedCloud loaded;
  const bool isRead = self.readFirst(loaded);
  self.readSeconds = reading.seconds();
  return isRead && self.show(std::move(loaded));
}

bool HapticViewer::open(vtkPolyData* cloud, const std::string& title)
{
  Implementation& self = *implementation_;
  self.files.clear();
  self.news.clear();
  self.isCancelled = false;
  if (!cloud || cloud->GetNumberOfPoints() == 0)
  {
    return self.fail(title + ": holds no points; give a cloud with at least one");
  }
  const Stopwatch reading;
  CloudRequest request({}, self.options);
  request.points = withoutCells(cloud);
  request.title = title;
  LoadedCloud loaded;
  const bool isReady = self.read(std::move(request), loaded);
  self.readSeconds = reading.seconds();
  return isReady && self.show(std::move(loaded));
}

bool HapticViewer::feelPath()
{
  Implementation& self = *implementation_;
  if (!(self.options.forceChart.empty() ? self.hasCloud() : self.isDrawable()))
  {
    return false;
  }
  ServoSample shown;
  if (!feelAlongPath(self.scene, self.options, self.observer, shown, self.message))
  {
    return false;
  }
  self.felt = shown;
  return true;
}

bool HapticViewer::renderToFile(const std::string& fileName)
{
  Implementation& self = *implementation_;
  if (!self.isDrawable())
  {
    return false;
  }
  return self.window && self.window->isStarted()
    ? self.window->writeImage(fileName, self.message)
    : makePicture(self.scene, self.options, self.observer, self.felt, fileName, self.message);
}

bool HapticViewer::start()
{
  Implementation& self = *implementation_;
  return self.isDrawable() && self.theWindow().start(self.cloud, self.news, self.message);
}

bool HapticViewer::stop()
{
  Implementation& self = *implementation_;
  return !self.window || !self.window->isStarted() || self.window->finish(self.message);
}

bool HapticViewer::run()
{
  if (!this->start())
  {
    return false;
  }
  implementation_->window->handleEvents();
  return this->stop();
}

std::string HapticViewer::pictureName(const std::string& fileName, int number, int last)
{
  const std::size_t dot = std::min(fileName.rfind('.'), fileName.size());
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(last).size());
  return fmt::format("{}-{:0{}}{}", fileName.substr(0, dot), number, digits, fileName.substr(dot));
}

const std::string& HapticViewer::message() const
{
  return implementation_->message;
}

bool HapticViewer::isCancelled() const
{
  return implementation_->isCancelled;
}

vtkRenderWindow* HapticViewer::renderWindow()
{
  return implementation_->theWindow().window();
}

vtkRenderWindowInteractor* HapticViewer::interactor()
{
  return implementation_->theWindow().interactor();
}

vtkInteractorStyleHaptic* HapticViewer::style()
{
  return implementation_->theWindow().style();
}

vtkRenderer* HapticViewer::renderer()
{
  return implementation_->scene.renderer();
}

vtkPolyData* HapticViewer::means()
{
  return implementation_->isOpen ? implementation_->scene.bandwidth()->GetOutput() : nullptr;
}

vtkIdType HapticViewer::numberOfPoints() const
{
  return implementation_->scene.numberOfPoints();
}

vtkIdType HapticViewer::numberOfInvalidPoints() const
{
  return implementation_->scene.numberOfInvalidPoints();
}

std::string HapticViewer::scaleNote() const
{
  return implementation_->scene.scaleNote();
}

double HapticViewer::readSeconds() const
{
  return implementation_->readSeconds;
}

double HapticViewer::resampleSeconds() const
{
  return implementation_->resampleSeconds;
}

std::uint64_t HapticViewer::numberOfResamplings() const
{
  const std::unique_ptr<ViewWindow>& window = implementation_->window;
  return std::uint64_t(implementation_->scene.resamplings()) +
    (window ? window->style()->GetScenes().numberOfBuilds() : 0);
}

} // namespace pointhaptics
