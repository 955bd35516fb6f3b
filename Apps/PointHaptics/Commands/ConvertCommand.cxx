#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "MergedCloud.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <vtkPolyData.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kConvertCommand = "convert";

struct ConvertOptions
{
  std::vector<std::string> files; ///< The last one is written.
  std::string named;              ///< By -o: becomes the last of the files.
  std::string inputFormat;
  std::string outputFormat;
  bool together = false;
  bool keepPoses = false;
  bool json = false;

  std::vector<std::string> inputs() const { return { files.begin(), files.end() - 1 }; }
  const std::string& output() const { return files.back(); }
  bool writesStandardOutput() const { return files.back() == kStandardStream; }
};

/// What the words of the command line cannot mean together, and the cure; empty where all is well.
std::string contradiction(const ConvertOptions& options)
{
  if (options.files.size() < 2)
  {
    return fmt::format(
      "{}: nothing says what to write; give a second name, or -o and a name", options.files.front());
  }
  const std::vector<std::string> inputs = options.inputs();
  std::error_code ignored;
  if (inputs.size() > 1 && !options.together)
  {
    return fmt::format(
      "{} inputs and one output, {}; give --together to merge them", inputs.size(), options.output());
  }
  // A list of inputs whose output was forgotten must not cost the last of them.
  if (inputs.size() > 1 && std::filesystem::is_regular_file(options.output(), ignored))
  {
    return fmt::format(
      "{}: is there already, and --together does not replace files; name a new one or remove it",
      options.output());
  }
  if (std::count(inputs.begin(), inputs.end(), kStandardStream) > 1)
  {
    return "-: standard input can be read once; leave out the second one";
  }
  if (options.writesStandardOutput() && options.outputFormat.empty())
  {
    return fmt::format("-: standard output has no extension; give --output-format, one of {}",
      fmt::join(writableExtensions(), ", "));
  }
  if (options.writesStandardOutput() && options.json)
  {
    return "--json: standard output is the cloud; leave it out, or name a file to write";
  }
  return {};
}

bool readInputs(const ConvertOptions& options, std::vector<Cloud>& clouds, std::string& message)
{
  ReadOptions reading;
  reading.extension = options.inputFormat;
  reading.applyPoses = !options.keepPoses;
  for (const std::string& file : options.inputs())
  {
    if (!readCloud(file, clouds.emplace_back(), message, reading))
    {
      return false;
    }
    showNotes(kConvertCommand, file, clouds.back());
  }
  return true;
}

void print(const ConvertOptions& options, vtkIdType points)
{
  if (options.json)
  {
    const nlohmann::ordered_json result = { { "inputs", options.inputs() }, { "output", options.output() },
      { "points", points } };
    printJson(result);
  }
  else if (!options.writesStandardOutput())
  {
    fmt::print("{}: {}\n", countOfPoints(points), options.output());
  }
}

int runConvert(ConvertOptions options)
{
  if (!options.named.empty())
  {
    options.files.push_back(options.named);
  }
  std::string message = contradiction(options);
  if (!message.empty())
  {
    fail(kConvertCommand, message);
    return kUsage;
  }
  if (options.outputFormat.empty() && !canWriteCloud(options.output(), message))
  {
    return fail(kConvertCommand, message);
  }
  rememberStopSignals();
  std::vector<Cloud> clouds;
  if (!readInputs(options, clouds, message))
  {
    return fail(kConvertCommand, message);
  }
  vtkSmartPointer<vtkPolyData> cloud = clouds.front().points;
  if (clouds.size() > 1)
  {
    std::vector<vtkPolyData*> inputs;
    for (const Cloud& each : clouds)
    {
      inputs.push_back(each.points);
    }
    std::vector<std::string> notes;
    cloud = io::mergeClouds(inputs, notes);
    for (const std::string& note : notes)
    {
      warn(kConvertCommand, note);
    }
    clouds.clear();
  }
  showWarnings(kConvertCommand);
  vtkIdType written = 0;
  if (!writeCloud(cloud, options.output(), kConvertCommand, message, options.outputFormat, &written))
  {
    return fail(kConvertCommand, message);
  }
  print(options, written);
  return kSuccess;
}

} // namespace

void addConvertCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command =
    program.add_subcommand("convert", "Write point clouds in another format, with all they have");
  auto options = std::make_shared<ConvertOptions>();
  command
    ->add_option("FILES", options->files,
      fmt::format("IN... OUT: clouds to read and the file to write, {}; - is standard input or output",
        fmt::join(writableExtensions(), ", ")))
    ->required()
    ->type_name("");
  command->add_option("-o,--output", options->named, "File to write, in place of the last of FILES")
    ->type_name("OUT");
  command->add_flag("--together", options->together, "Merge several inputs; every array of each is kept");
  addWord(*command, "--input-format", options->inputFormat,
    { "ply", "pcd", "las", "laz", "e57", "vtp", "vtu", "vtk", "obj", "off", "stl", "xyz", "txt", "csv",
      "pts" },
    "Format of the input where neither its content nor its name tells it, such as obj from xyz");
  addWord(*command, "--output-format", options->outputFormat, writableExtensions(),
    "Format of the output where its name does not tell it");
  command->add_flag("--keep-poses", options->keepPoses,
    "Leave each scan of an E57 file in its scanner's frame; .vtp keeps the poses: ScanPoses");
  command->add_flag("--json", options->json, "Print the figures as JSON");
  command->callback([options, &exitCode] { exitCode = runConvert(*options); });
}

} // namespace app
} // namespace pointhaptics
