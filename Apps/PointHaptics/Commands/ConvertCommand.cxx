#include "Commands/Commands.h"

#include "Clouds/CloudToCloud.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include "vtkPointCloudReader.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkPolyData.h>

#include <memory>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kConvertCommand = "convert";

struct ConvertOptions
{
  CloudToCloudOptions clouds; ///< The last of the inputs is written, unless -o is given.
  std::string inputFormat;
  bool keepPoses = false;
};

/// Checks that need all words of the command line.
void complete(ConvertOptions& options)
{
  CloudToCloudOptions& clouds = options.clouds;
  if (clouds.output.empty() && clouds.inputs.size() < 2)
  {
    throwUsage(clouds.inputs.front(), "", "nothing says what to write; give a second name, or -o and a name");
  }
  if (clouds.output.empty())
  {
    clouds.output = clouds.inputs.back();
    clouds.inputs.pop_back();
  }
  clouds.reading.extension = options.inputFormat;
  clouds.reading.applyPoses = !options.keepPoses;
}

CloudResult convert(const CloudToCloudOptions& options, Cloud& cloud, Files& files)
{
  showWarnings(kConvertCommand);
  std::string message;
  vtkIdType written = 0;
  require(
    writeCloud(cloud.points, options.output, files, kConvertCommand, message, options.writing, &written),
    message);
  const std::vector<std::string> inputs =
    options.merge ? options.inputs : std::vector<std::string>{ options.input };
  return { fmt::format("{}: {}", countOfPoints(written), options.output),
    { { "inputs", inputs }, { "output", options.output }, { "points", written } } };
}

} // namespace

void addConvertCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("convert", "Write point clouds in another format, with all they have");
  auto options = std::make_shared<ConvertOptions>();
  options->clouds.addTo(*command, true);
  addWord(*command, "--input-format", options->inputFormat, vtkPointCloudReader::GetExtensions(),
    "Format of the input where neither its content nor its name tells it, such as obj from xyz");
  command->add_flag("--keep-poses", options->keepPoses,
    "Leave each scan of an E57 file in its scanner's frame; .vtp keeps the poses: ScanPoses");
  const auto run = [options](Files& files)
  {
    return runOnClouds(kConvertCommand, options->clouds, files,
      [&](const CloudToCloudOptions& each, Cloud& cloud) { return convert(each, cloud, files); });
  };
  runAs(*command, exitCode, { run, [options] { complete(*options); } });
}

} // namespace pointhaptics::app
