#include "Clouds/CloudToCloud.h"

#include "Options/OptionParsing.h"
#include "Terminal/StopSignals.h"

#include <CLI/CLI.hpp>
#include <vtkPointCloudWriter.h>

namespace pointhaptics
{
namespace app
{

void CloudToCloudOptions::addTo(CLI::App& command)
{
  command.add_option("IN", this->input, "Point cloud to read")->required()->type_name("");
  command
    .add_option(
      "-o,--output", this->output, std::string("File to write: ") + vtkPointCloudWriter::GetExtensions())
    ->required()
    ->type_name("OUT");
  addResolution(command, this->resolution);
  addInteger(command, "--threads", this->threads, 1, 1024, "Threads to use; default all");
  command.add_flag("--json", this->json, "Print the figures as JSON");
}

bool CloudToCloudOptions::open(const std::string& command, Cloud& cloud, std::string& message) const
{
  if (!canWriteCloud(this->output, message))
  {
    return false;
  }
  useThreads(this->threads);
  rememberStopSignals();
  if (!this->read(cloud, message))
  {
    return false;
  }
  showNotes(command, this->input, cloud);
  return true;
}

bool CloudToCloudOptions::read(Cloud& cloud, std::string& message, Ranks* ranks) const
{
  ReadOptions reading;
  reading.resolution = this->resolution;
  reading.ranks = ranks;
  return readCloud(this->input, cloud, message, reading);
}

} // namespace app
} // namespace pointhaptics
