#include "Feel/FeelCommand.h"

#include "Commands/Commands.h"
#include "Feel/FeelReplay.h"
#include "Options/Files.h"
#include "Options/OptionParsing.h"
#include "View/ViewCommand.h"
#include "View/ViewSettings.h"

#include "vtkPointCloudReader.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace pointhaptics::app
{

namespace
{

/// Options of `view` that `feel` does not have, and the device, which means another thing there.
std::vector<std::string> namesOfTheViewAlone(CLI::App& feel)
{
  CLI::App other("view");
  ViewCommand view;
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

void FeelCommand::addTo(CLI::App& command)
{
  addInput(command, "FILE", this->file,
    "Point cloud to feel; with --replay the one that was recorded is the default");
  addReading(command, this->reading.columns, this->reading.salvage);
  addVertices(command, this->viewer.vertices);
  addInput(command, "--path", this->viewer.path,
    "Path of the hand: t,x,y,z in seconds and metres, or what feel or view --trace wrote; needed unless "
    "--device is falcon",
    "HIP.csv");
  addPathUnits(command, this->viewer.pathUnits);
  addInput(command, "--replay", this->viewer.replay,
    "Feel this recording again, with its scenes, settings and motions of the model: the same forces to the "
    "last bit; --method replaces its method",
    "REC.csv");
  addOutput(command, "--record", this->viewer.record, { "csv" },
    "Write a recording, for --replay, beside the output", "REC.csv");
  addOutput(command, "--sound-file", this->soundFile, { "wav" },
    "Write what is felt as sound, too: a quiet tone as loud as the force, and a click where contact begins",
    "OUT.wav");
  addInput(command, "--config", this->config,
    "Defaults for these options, a JSON object as view writes it; the command line wins", "FILE.json");
  command.add_flag("--fit", this->viewer.fitsWorkspace,
    "Fit the cloud to the 10 cm workspace and choose its voxels, as view does where no transform is given");
  addClip(command, this->viewer.clip,
    "Only what lies in this box is felt, in coordinates of the file; default: all");
  addOutput(
    command, "-o,--output", this->output, { "csv" }, "Where the felt forces go, one row a tick", "OUT.csv");
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

void FeelCommand::complete(CLI::App& command, Files& files)
{
  const std::vector<std::string> given = givenOptions(command);
  if (!this->config.empty())
  {
    applyConfigFile(command, this->config, namesOfTheViewAlone(command), files);
  }
  const std::string& path = this->viewer.path;
  const std::string& replay = this->viewer.replay;
  const bool isFalcon = this->device == "falcon";
  this->methodIsGiven = command.count("--method") > 0;
  requireUsage(!this->file.empty() || !replay.empty(), "FILE", "(none)",
    "give the point cloud to feel, or a recording by --replay");
  requireUsage(!this->output.empty(), "--output", "(none)",
    "give the file for the forces, one row a tick: -o OUT.csv, or - for standard output");
  if (!replay.empty())
  {
    refuseRecorded(command, given, replay, "method");
  }
  const bool isPlaced = this->raw || this->lattice.hasTransform() || !this->lattice.workspace().empty();
  requireUsage(!this->viewer.fitsWorkspace || !isPlaced, "--fit", "",
    "the cloud is placed already; leave out --fit, or the transform, --workspace and --raw");
  requireUsage(this->viewer.record.empty() || !this->raw, "--record", this->viewer.record,
    "what --raw feels cannot be made again; leave out one of them");
  requireUsage(!replay.empty() || !isFalcon || path.empty(), "--path", path,
    "a Falcon's hand goes where it likes; leave out --path or --device falcon");
  requireUsage(!replay.empty() || isFalcon || !path.empty(), "--path", "(none)",
    "give the path of the hand, or --device falcon");
  this->reading.samples = this->viewer.vertices ? 0 : vtkPointCloudReader::AUTOMATIC;
  this->touch.complete(command);
  this->falcon.complete(command, this->touch.parameters.contact);
  warnIdle(path.empty(), given, { "path-unit", "path-time-unit" }, "without --path");
  warnIdle(!isFalcon, given, { "seconds", "falcon-firmware" }, "without --device falcon");
  warnIdle(this->raw, given, { "dims", "voxel", "no-covariance" }, "with --raw");
  if (isFalcon)
  {
    checkForceLimitOfDevices(this->touch.parameters.contact, ", or feel a --path");
  }
  setFelt(this->viewer, this->lattice, this->bandwidth, this->noCovariance);
  this->viewer.unitIsChosen = isGiven(command, "--unit");
  this->viewer.voxels.passAttributes = false;
  this->settings = jsonText(givenSettings(command));
  this->declare(files);
}

void FeelCommand::declare(Files& files) const
{
  const std::string& record = this->viewer.record;
  if (!this->viewer.replay.empty())
  {
    declareRecordedClouds(this->viewer.replay, this->file, files);
    return;
  }
  if (this->device == "falcon")
  {
    files.keep(this->output);
  }
  if (record.empty())
  {
    return;
  }
  if (files.isStream(this->file))
  {
    files.addOutput(keptCloudName(record));
  }
  this->device == "falcon" ? files.keep(record) : files.protect(record);
}

Command* feelCommand()
{
  return new FeelCommand;
}

} // namespace pointhaptics::app
