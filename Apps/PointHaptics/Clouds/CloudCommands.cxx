#include "Clouds/CloudCommands.h"

#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "IO/Info/LengthUnit.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkPolyData.h>

namespace pointhaptics::app
{

void CloudCommand::addTo(CLI::App& command)
{
  this->addFiles(command, false);
}

void CloudCommand::addFiles(CLI::App& command, bool lastIsOutput)
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
  command.add_flag("--merge,--together", this->merge,
    "Make one cloud of several IN, with every array of each; points of a cloud that lacks one have NaN "
    "there, or "
    "0 in colours, labels and fields of LAS, where that means none");
  addClip(command, this->reading.clip,
    "Only what lies in this box is read, in coordinates of the file; default: all");
  this->writing.addTo(command);
  addResolution(command, this->reading.resolution);
  addReading(command, this->reading.columns, this->reading.salvage);
  addSamples(command, this->reading.samples);
  addInteger(command, "--threads", this->threads, 1, 1024, "Threads to use; default all");
  command.add_flag("--json", this->json, "Print the figures as JSON");
}

void CloudCommand::print(const CloudResult& result) const
{
  printResult(this->json, result.json, result.summary);
}

CloudResult CloudCommand::resultOf(const std::string& figures, const nlohmann::ordered_json& numbers) const
{
  nlohmann::ordered_json all = { { "input", this->input },
    { "inputs", this->merge ? this->inputs : std::vector<std::string>{ this->input } },
    { "output", this->output } };
  all.update(numbers);
  return { fmt::format("{}: {}{}", figures, this->output, this->unitOfFile() == "m" ? "" : ", in metres"),
    all };
}

void CloudCommand::complete(CLI::App& command, Files&)
{
  this->unitIsGiven = isGiven(command, "--unit");
  for (const CLI::Option* option : command.get_options())
  {
    const bool isLength = option->count() > 0 && option->get_type_name() == kMetres;
    this->lengths.insert(this->lengths.end(), isLength ? 1 : 0,
      isLength ? option->get_name() + " " + option->results().front() : std::string());
  }
}

std::string CloudCommand::unitNote(vtkPolyData* cloud) const
{
  const std::string unit = lengthUnitOf(cloud, Bounds()).name;
  std::string given;
  for (const std::string& each : this->lengths)
  {
    given += fmt::format("{} is {} {}, ", each, each.substr(each.find(' ') + 1), unit);
  }
  return this->unitIsGiven         ? contradictedUnit(this->input, cloud, this->unitOfFile())
    : unit == "m" || given.empty() ? ""
                                   : fmt::format("{}: {}the unit of the file; --unit {} makes metres of {}",
                                       this->input, given, unit, this->lengths.size() == 1 ? "both" : "all");
}

int CloudCommand::run(Files& files)
{
  useThreads(this->threads);
  rememberStopSignals();
  std::vector<Cloud> merged;
  std::vector<CloudResult> results;
  const std::string pattern = this->output;
  for (const std::string& each : this->inputs)
  {
    this->input = each;
    this->output = expandedName(pattern, each);
    Cloud cloud = readCloud(each, this->reading);
    showNotes(cloud);
    this->merge ? merged.push_back(std::move(cloud)) : results.push_back(this->work(cloud, files));
  }
  if (this->merge)
  {
    Cloud all = mergedCloud(merged);
    this->input = fmt::format("{} merged inputs", merged.size());
    this->output = pattern;
    results.push_back(this->work(all, files));
  }
  files.commit();
  const bool isList = this->json && isPattern(pattern);
  nlohmann::ordered_json list = { { "files", nlohmann::ordered_json::array() } };
  for (const CloudResult& result : results)
  {
    isList ? list["files"].push_back(result.json) : this->print(result);
  }
  if (isList)
  {
    printJson(list);
  }
  return kSuccess;
}

} // namespace pointhaptics::app
