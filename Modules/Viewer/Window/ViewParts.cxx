// What keys do with the shown part of a cloud, a line through it, and its up axis.
#include "CloudAppearance.h"
#include "CloudFiles.h"
#include "ViewWindow.h"

#include "vtkPointCloudWriter.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>

namespace pointhaptics
{
namespace
{

constexpr double kProfileBegin = 0.76; // of the window's height

constexpr const char* kAxes[] = { "z", "-z", "y", "-y", "x", "-x" };

} // namespace

/// The first of STEM-001.EXTENSION, STEM-002.EXTENSION, ... after @p last that is not there yet.
std::string freeFileName(const char* extension, int& last)
{
  std::string name;
  std::error_code error;
  do
  {
    name = fmt::format("pointhaptics-{:03}.{}", ++last, extension);
  } while (std::filesystem::exists(name, error));
  return name;
}

/// Writes what is shown, in the format of the first file where that can be written, with all its arrays.
void ViewWindow::savePart()
{
  if (saving_.valid() || shown_.empty())
  {
    this->say(shown_.empty() ? "the points are of no file" : "the part is being saved");
    return;
  }
  const std::string& first = shown_.front();
  const std::size_t dot = first.rfind('.');
  const bool isWritable = dot != std::string::npos && vtkPointCloudWriter::CanWrite(first);
  const std::string name = freeFileName(isWritable ? first.c_str() + dot + 1 : "ply", savedParts_);
  saving_ = std::async(std::launch::async,
    [request = CloudRequest::of(shown_, options_), up = scene_.cloudUp(), name]
    {
      std::string message;
      const bool isWritten = writePart(request, up, name, message);
      return std::make_pair(isWritten, message);
    });
}

void ViewWindow::followSaving()
{
  if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
  {
    const auto [isWritten, message] = saving_.get();
    isWritten ? this->say(message) : this->tell(message);
  }
}

void ViewWindow::toggleProfile()
{
  if (this->endProfile())
  {
    return;
  }
  if (scene_.profile().empty())
  {
    this->say(
      "no profile: " + style_->GetCommands().label("measure") + " measures its line between two clicks");
    return;
  }
  window_->AddRenderer(profile_.renderer());
  this->followProfile();
}

bool ViewWindow::endProfile()
{
  const bool wasShown = window_->HasRenderer(profile_.renderer()) != 0;
  window_->RemoveRenderer(profile_.renderer());
  this->setTop(1.0);
  return wasShown;
}

/// Shows the profile of the present line.
void ViewWindow::followProfile()
{
  if (!window_->HasRenderer(profile_.renderer()))
  {
    return;
  }
  const ProfilePoints points = scene_.profile();
  if (points.empty())
  {
    this->endProfile();
    return;
  }
  profile_.show(points, scene_.unit().name);
  profile_.renderer()->SetViewport(0.0, kProfileBegin, 1.0, 1.0);
  this->setTop(kProfileBegin);
  const auto [low, high] = std::minmax_element(
    points.begin(), points.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  this->say(fmt::format("profile: heights {} {}", rangeText((*low)[1], (*high)[1]), scene_.unit().name));
}

/// Ends the picture of the cloud at this part of the window's height.
void ViewWindow::setTop(double top)
{
  vtkRenderer* renderer = scene_.renderer();
  const double* viewport = renderer->GetViewport();
  renderer->SetViewport(viewport[0], viewport[1], viewport[2], top);
}

/// Reads the file again with the next axis upwards.
void ViewWindow::turnUp()
{
  const std::string present = axisName(scene_.cloudUp());
  const auto* found = std::find(std::begin(kAxes), std::end(kAxes), present);
  const std::string next = kAxes[(found - std::begin(kAxes) + 1) % std::size(kAxes)];
  if (shown_.empty() || loader_.busy())
  {
    this->say(shown_.empty() ? "the points are of no file" : "a file is being read; turn it after that");
    return;
  }
  ups_[shown_.front()] = next;
  if (observer_.keepUp)
  {
    observer_.keepUp(shown_.front(), next);
  }
  this->load(shown_, Load::New, [this, next](bool isShown) { isShown ? this->say("up: " + next) : void(); });
}

/// The axis that points up in @p file: as it was turned here; else that of the options, else as it was kept.
std::string ViewWindow::upOf(const std::string& file)
{
  if (askedUp_ == "auto" && ups_.count(file) == 0 && observer_.upOf)
  {
    ups_[file] = observer_.upOf(file);
  }
  const auto found = ups_.find(file);
  return found == ups_.end() || found->second.empty() ? askedUp_ : found->second;
}

} // namespace pointhaptics
