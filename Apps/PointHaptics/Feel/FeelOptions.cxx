#include "Feel/FeelOptions.h"

#include "Options/OptionParsing.h"

#include <CLI/CLI.hpp>

namespace pointhaptics
{
namespace app
{

void FeelOptions::addTo(CLI::App& command)
{
  command.add_option("FILE", this->file, "Point cloud to feel")->required()->type_name("");
  command
    .add_option("--path", this->path,
      "Path of the hand: t,x,y,z in seconds and metres, or what feel or view --trace wrote; needed unless "
      "--device is falcon")
    ->type_name("HIP.csv");
  command.add_option("-o,--output", this->output, "Where the felt forces go, one row a tick")
    ->required()
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

void FeelOptions::complete(const CLI::App& command)
{
  if (this->device == "falcon" ? !this->path.empty() : this->path.empty())
  {
    throwUsage("--path", this->path.empty() ? "(none)" : this->path,
      this->path.empty() ? "give the path of the hand, or --device falcon"
                         : "a Falcon's hand goes where it likes; leave out --path or --device falcon");
  }
  this->touch.complete(command);
}

} // namespace app
} // namespace pointhaptics
