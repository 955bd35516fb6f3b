#include "Clouds/CloudToCloud.h"

#include "Options/OptionParsing.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "MergedCloud.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <vtkPolyData.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace pointhaptics::app
{

void CloudToCloudOptions::addTo(CLI::App& command, bool lastIsOutput)
{
  CLI::Option* in = lastIsOutput
    ? addInputsAndOutput(command, "IN", this->inputs, writableExtensions(),
        "Point clouds to read, and where -o is not given the file to write; - is standard input or output")
    : addInput(command, "IN", this->inputs, "Point clouds to read; - is standard input");
  in->required();
  addOutput(command, "-o,--output", this->output, writableExtensions(),
    fmt::format(
      "File to write: .{}; - is standard output; for several IN a pattern such as {{stem}}-new.ply, with "
      "{{stem}}, {{name}} or {{folder}} of each",
      fmt::join(writableExtensions(), ", .")))
    ->required(!lastIsOutput);
  command.add_flag(
    "--merge,--together", this->merge, "Make one cloud of several IN, with every array of each");
  addClip(command, this->reading.clip,
    "Only what lies in this box is read, in coordinates of the file; default: all");
  this->writing.addTo(command);
  addResolution(command, this->reading.resolution);
  addReading(command, this->reading.columns, this->reading.salvage);
  addSamples(command, this->reading.samples);
  addInteger(command, "--threads", this->threads, 1, 1024, "Threads to use; default all");
  command.add_flag("--json", this->json, "Print the figures as JSON");
}

bool CloudToCloudOptions::read(Cloud& cloud, std::string& message, Ranks* ranks) const
{
  ReadOptions options = this->reading;
  options.ranks = ranks;
  return readCloud(this->input, cloud, message, options);
}

void print(const CloudResult& result, bool isJson)
{
  isJson ? printJson(result.json) : printSummary(result.summary);
}

/// Warns of files that are merged twice: their points would count twice in every mean.
static void warnOfRepeats(const std::string& command, const std::vector<std::string>& inputs)
{
  for (auto input = inputs.begin(); input != inputs.end(); ++input)
  {
    std::error_code problem;
    const auto first = std::find_if(inputs.begin(), input,
      [&](const std::string& earlier) { return std::filesystem::equivalent(earlier, *input, problem); });
    if (first != input)
    {
      warn(command, "is the same file as " + *first + ", so its points count twice; leave one out", *input);
    }
  }
}

int runOnClouds(const std::string& command, const CloudToCloudOptions& options, Files& files,
  const std::function<CloudResult(const CloudToCloudOptions&, Cloud&)>& work)
{
  useThreads(options.threads);
  rememberStopSignals();
  std::string message;
  std::vector<Cloud> merged;
  std::vector<CloudResult> results;
  CloudToCloudOptions each = options;
  for (const std::string& input : options.inputs)
  {
    each.input = input;
    each.output = expandedName(options.output, input);
    Cloud cloud;
    if (!each.read(cloud, message))
    {
      throw Failure(message);
    }
    showNotes(command, input, cloud);
    options.merge ? merged.push_back(std::move(cloud)) : results.push_back(work(each, cloud));
  }
  if (options.merge)
  {
    warnOfRepeats(command, options.inputs);
    Cloud all = mergedCloud(command, merged);
    each.input = fmt::format("{} merged inputs", merged.size());
    each.output = options.output;
    results.push_back(work(each, all));
  }
  if (!files.commit(message))
  {
    throw Failure(message);
  }
  const bool isList = options.json && isPattern(options.output);
  nlohmann::ordered_json list = { { "files", nlohmann::ordered_json::array() } };
  for (const CloudResult& result : results)
  {
    isList ? list["files"].push_back(result.json) : print(result, options.json);
  }
  if (isList)
  {
    printJson(list);
  }
  return kSuccess;
}

} // namespace pointhaptics::app
