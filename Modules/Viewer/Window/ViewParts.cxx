// The shown part of a cloud as a file.
#include "CloudFiles.h"
#include "ViewWindow.h"

#include "vtkPointCloudWriter.h"

#include "Core/Base/OutputFile.h"

#include <fmt/format.h>

#include <filesystem>

namespace pointhaptics
{
/// The first of pointhaptics-001.EXTENSION, pointhaptics-002.EXTENSION, ... that is neither there nor about
/// to be.
std::string ViewWindow::freeFileName(const std::string& extension) const
{
  std::string name;
  std::error_code error;
  for (int number = 1; name.empty() || std::filesystem::exists(name, error) ||
       std::filesystem::exists(OutputFile::keptPartOf(name), error) ||
       (saving_.valid() && name == savedName_);
       ++number)
  {
    name = fmt::format("pointhaptics-{:03}.{}", number, extension);
  }
  return name;
}

/// Writes what is shown, in the format of the first file where that can be written, with all its arrays.
void ViewWindow::savePart()
{
  const std::string obstacle = saving_.valid() ? "the part is being saved" : this->hiddenWords();
  if (!obstacle.empty() || files_.shown().empty())
  {
    this->say(obstacle.empty() ? "the points are of no file" : obstacle);
    return;
  }
  const std::string& first = files_.shown().front();
  const std::size_t dot = first.rfind('.');
  const bool isWritable = dot != std::string::npos && vtkPointCloudWriter::CanWrite(first);
  savedName_ = this->freeFileName(isWritable ? first.substr(dot + 1) : "ply");
  saving_ = std::async(std::launch::async,
    [request = CloudRequest(files_.shown(), options_), up = scene_.cloudUp(), name = savedName_]
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

} // namespace pointhaptics
