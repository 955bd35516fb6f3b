#include "Options/FeelOptions.h"

#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics
{
namespace app
{
namespace
{

enum Preset : int
{
  kTuned = 1,
  kPaper,
};

} // namespace

void FeelOptions::addTo(CLI::App& command)
{
  ContactParameters& contact = this->parameters.contact;
  command.add_option("FILE", this->file, "Point cloud to feel")->required()->type_name("");
  command
    .add_option("--path", this->path,
      "Path of the hand: t,x,y,z in seconds and metres, or what feel or view --trace wrote; needed unless "
      "--device is falcon")
    ->type_name("HIP.csv");
  command.add_option("-o,--output", this->output, "Where the felt forces go, one row a tick")
    ->required()
    ->type_name("OUT.csv");
  addChoice(command, "--method", this->method,
    { { "surface-fit", static_cast<int>(ProxyMethod::SurfaceFit) },
      { "sphere", static_cast<int>(ProxyMethod::Sphere) },
      { "gradient-steps", static_cast<int>(ProxyMethod::GradientSteps) } },
    "How the proxy meets the surface: a fit (the default), a sphere among the points, or the paper's steps");
  addChoice(command, "--preset", this->preset, { { "tuned", kTuned }, { "paper", kPaper } },
    "Gains of --method gradient-steps; default tuned");
  addNumber(command, "--stiffness", contact.stiffness, { 0.0, 1e5 }, "N_PER_M", "Spring; default 800");
  addNumber(command, "--damping", contact.damping, { 0.0, 1e3 }, "N_S_PER_M",
    "Of the hand's speed along the normal, in contact; default 0");
  addNumber(
    command, "--mu-s", this->staticFriction, { 0.0, 10.0 }, "X", "Static friction; default that of --mu-d");
  addNumber(command, "--mu-d", this->dynamicFriction, { 0.0, 10.0 }, "X", "Dynamic friction; default 0");
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
  this->lattice.addTo(command);
  command.get_option("--dims")->description(
    "Voxels on each axis of the lattice, everywhere; default 300, and near the hand, where that tells more, "
    "voxels about as fine as the points");
  this->bandwidth.addTo(command);
}

void FeelOptions::complete()
{
  if (this->device == "falcon" ? !this->path.empty() : this->path.empty())
  {
    throwUsage("--path", this->path.empty() ? "(none)" : this->path,
      this->path.empty() ? "give the path of the hand, or --device falcon"
                         : "a Falcon's hand goes where it likes; leave out --path or --device falcon");
  }
  ContactParameters& contact = this->parameters.contact;
  contact.dynamicFriction = std::max(0.0, this->dynamicFriction);
  contact.staticFriction = this->staticFriction >= 0.0 ? this->staticFriction : contact.dynamicFriction;
  if (contact.dynamicFriction > contact.staticFriction)
  {
    throwUsage("--mu-d", fmt::format("{}", contact.dynamicFriction),
      fmt::format("above --mu-s {}; give mu_d <= mu_s", contact.staticFriction));
  }
  this->parameters.method = static_cast<ProxyMethod>(this->method);
  if (this->preset != 0 && this->parameters.method != ProxyMethod::GradientSteps)
  {
    warn("feel", kPresetIsIdle);
  }
  if (this->preset == kPaper)
  {
    this->parameters.gradientSteps = GradientStepsParameters::paper();
  }
}

} // namespace app
} // namespace pointhaptics
