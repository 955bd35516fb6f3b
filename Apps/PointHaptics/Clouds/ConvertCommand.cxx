#include "Commands/Commands.h"

#include "Clouds/CloudCommands.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "vtkPointCloudReader.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkPolyData.h>

namespace pointhaptics::app
{
namespace
{

struct ConvertCommand : CloudCommand
{
  bool keepPoses = false;

  void addTo(CLI::App& command) override
  {
    this->addFiles(command, true);
    addWord(command, "--input-format", this->reading.extension, vtkPointCloudReader::GetExtensions(),
      "Format of the input where neither its content nor its name tells it, such as obj from xyz");
    command.add_flag("--keep-poses", this->keepPoses,
      "Leave each scan of an E57 file in its scanner's frame; .vtp keeps the poses: ScanPoses");
  }

  void complete(CLI::App&, Files&) override
  {
    requireUsage(!this->output.empty() || this->inputs.size() > 1, this->inputs.front(), "",
      "nothing says what to write; give a second name, or -o and a name");
    if (this->output.empty())
    {
      this->output = this->inputs.back();
      this->inputs.pop_back();
    }
    this->reading.applyPoses = !this->keepPoses;
  }

  CloudResult work(Cloud& cloud, Files& files) override
  {
    showWarnings();
    const vtkIdType written = writeCloud(cloud.points, this->output, files, this->writing);
    return this->resultOf(countOfPoints(written), { { "points", written } });
  }
};

} // namespace

Command* convertCommand()
{
  return new ConvertCommand;
}

} // namespace pointhaptics::app
