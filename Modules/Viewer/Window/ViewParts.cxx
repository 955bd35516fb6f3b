// The shown part of a cloud as a file, and the profile of a line through it.
#include "CloudAppearance.h"
#include "CloudFiles.h"
#include "ViewWindow.h"

#include "vtkPointCloudWriter.h"

#include "Core/Base/OutputFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace pointhaptics
{
namespace
{

constexpr double kProfileBegin = 0.76; // of the window's height

} // namespace

/// The first of pointhaptics-001.EXTENSION, pointhaptics-002.EXTENSION, ... that is not there yet.
std::string freeFileName(const std::string& extension)
{
  std::string name;
  std::error_code error;
  for (int number = 1; name.empty() || std::filesystem::exists(name, error) ||
       std::filesystem::exists(OutputFile::keptPartOf(name), error);
       ++number)
  {
    name = fmt::format("pointhaptics-{:03}.{}", number, extension);
  }
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
  const std::string name = freeFileName(isWritable ? first.substr(dot + 1) : "ply");
  saving_ = std::async(std::launch::async,
    [request = CloudRequest(shown_, options_), up = scene_.cloudUp(), name]
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
    this->say(message, isWritten ? kNote : kError);
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

} // namespace pointhaptics
