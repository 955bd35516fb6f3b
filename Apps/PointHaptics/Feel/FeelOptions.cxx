#include "Feel/FeelOptions.h"

#include "Options/ConfigFile.h"
#include "Options/Files.h"
#include "Options/OptionParsing.h"
#include "View/ViewOptions.h"
#include "View/ViewSettings.h"

#include "vtkPointCloudReader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <vector>

namespace pointhaptics::app
{

namespace
{

/// Options of `view` that `feel` does not have, and the device, which means another thing there.
std::vector<std::string> namesOfTheViewAlone(CLI::App& feel)
{
  CLI::App other("view");
  ViewOptions view;
  view.addTo(other);
  const std::vector<std::string> ours = configurableNames(feel);
  std::vector<std::string> names = { "device" };
  for (const std::string& name : configurableNames(other))
  {
    if (std::find(ours.begin(), ours.end(), name) == ours.end())
    {
      names.push_back(name);
    }
  }
  return names;
}

} // namespace

void FeelOptions::addTo(CLI::App& command)
{
  addInput(command, "FILE", this->file,
    "Point cloud to feel; with --replay the one that was recorded is the default");
  addReading(command, this->reading.columns, this->reading.salvage);
  addVertices(command, this->vertices);
  addInput(command, "--path", this->path,
    "Path of the hand: t,x,y,z in seconds and metres, or what feel or view --trace wrote; needed unless "
    "--device is falcon")
    ->type_name("HIP.csv");
  addPathUnits(command, this->pathUnits);
  addInput(command, "--replay", this->replay,
    "Feel this recording again, with its scenes, settings and motions of the model: the same forces to the "
    "last bit; --method replaces its method")
    ->type_name("REC.csv");
  addOutput(
    command, "--record", this->record, { "csv" }, "Write a recording, for --replay, beside the output")
    ->type_name("REC.csv");
  addOutput(command, "--sound-file", this->soundFile, { "wav" },
    "Write what is felt as sound, too: a quiet tone as loud as the force, and a click where contact begins")
    ->type_name("OUT.wav");
  addInput(command, "--config", this->config,
    "Defaults for these options, a JSON object as view writes it; the command line wins")
    ->type_name("FILE.json");
  command.add_flag("--fit", this->fit,
    "Fit the cloud to the 10 cm workspace and choose its voxels, as view does where no transform is given");
  addClip(
    command, this->clip, "Only what lies in this box is felt, in coordinates of the file; default: all");
  addOutput(command, "-o,--output", this->output, { "csv" }, "Where the felt forces go, one row a tick")
    ->type_name("OUT.csv");
  addWord(command, "--device", this->device, { "none", "simulated", "falcon" },
    "none: the hand is where the path says (default); simulated: a hand that is pulled there and yields to "
    "the "
    "force; falcon: the hand in the device, in real time");
  addNumber(command, "--seconds", this->seconds, { 0.0, 86400.0 }, "S",
    "Falcon: stop after so many seconds of touch; default 0: at Ctrl+C");
  this->falcon.addTo(command);
  addNumber(command, "--rate", this->rateHz, { 1.0, 1e5 }, "HZ", "Ticks per second; default 1000");
  command.add_flag(
    "--no-covariance", this->noCovariance, "Feel plain voxel means, without their second moments");
  command.add_flag("--raw", this->raw,
    "Feel the points themselves, without voxel means; --dims and --voxel then have no effect");
  command.add_flag("--json", this->json, "Print the summary as JSON");
  this->touch.addTo(command);
  this->lattice.addTo(command);
  command.get_option("--dims")->description(
    "Voxels on each axis of the lattice, everywhere; default 300, and near the hand, where that tells more, "
    "voxels about as fine as the points");
  this->bandwidth.addTo(command);
}

void FeelOptions::warnOfIdle(const CLI::App& command, const std::vector<std::string>& given) const
{
  if (this->path.empty())
  {
    warnIdle(command, given, { "path-unit", "path-time-unit" }, "without --path");
  }
  if (this->device != "falcon")
  {
    warnIdle(command, given, { "seconds", "falcon-firmware" }, "without --device falcon");
  }
  if (this->raw)
  {
    warnIdle(command, given, { "dims", "voxel", "no-covariance" }, "with --raw");
  }
}

void FeelOptions::complete(CLI::App& command)
{
  const std::vector<std::string> given = givenOptions(command);
  if (!this->config.empty())
  {
    applyConfigFile(command, this->config, namesOfTheViewAlone(command));
  }
  this->methodIsGiven = command.count("--method") > 0;
  if (this->file.empty() && this->replay.empty())
  {
    throwUsage("FILE", "(none)", "give the point cloud to feel, or a recording by --replay");
  }
  if (this->output.empty())
  {
    throwUsage("--output", "(none)",
      "give the file for the forces, one row a tick: -o OUT.csv, or - for standard output");
  }
  if (!this->replay.empty())
  {
    refuseRecorded(command, given, this->replay, "method");
  }
  if (this->fit && (this->raw || this->lattice.hasTransform() || !this->lattice.workspace().empty()))
  {
    throwUsage(
      "--fit", "", "the cloud is placed already; leave out --fit, or the transform, --workspace and --raw");
  }
  if (!this->record.empty() && this->raw)
  {
    throwUsage("--record", this->record, "what --raw feels cannot be made again; leave out one of them");
  }
  if (this->replay.empty() && (this->device == "falcon" ? !this->path.empty() : this->path.empty()))
  {
    throwUsage("--path", this->path.empty() ? "(none)" : this->path,
      this->path.empty() ? "give the path of the hand, or --device falcon"
                         : "a Falcon's hand goes where it likes; leave out --path or --device falcon");
  }
  this->reading.samples = this->vertices ? 0 : vtkPointCloudReader::AUTOMATIC;
  this->touch.complete(command);
  this->falcon.complete(command, this->touch.parameters.contact);
  this->warnOfIdle(command, given);
  if (this->device == "falcon")
  {
    checkForceLimitOfDevices(this->touch.parameters.contact, ", or feel a --path");
  }
  this->settings = givenSettings(command).dump();
}

void FeelOptions::declareMore(Files& files) const
{
  if (!this->replay.empty())
  {
    declareRecordedClouds(this->replay, this->file, files);
    return;
  }
  if (this->device == "falcon")
  {
    files.keep(this->output);
  }
  if (this->record.empty())
  {
    return;
  }
  if (files.isStream(this->file))
  {
    files.addOutput(keptCloudName(this->record));
  }
  this->device == "falcon" ? files.keep(this->record) : files.protect(this->record);
}

} // namespace pointhaptics::app
