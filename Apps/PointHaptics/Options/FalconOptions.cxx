#include "Options/FalconOptions.h"

#include "Options/Files.h"
#include "Options/OptionParsing.h"
#include "Terminal/StopSignals.h"

#include <CLI/CLI.hpp>

namespace pointhaptics::app
{
namespace
{

constexpr double kLargestForce = 8.0;

} // namespace

void FalconOptions::addTo(CLI::App& command)
{
  addInput(command, "--falcon-firmware", this->firmware,
    "Firmware of the Falcon, from Novint's own driver; default: what POINTHAPTICS_FALCON_FIRMWARE names")
    ->type_name("FILE");
  addNumber(command, "--max-force", this->maximumForce, { 0.0, kLargestForce, true }, "N",
    "Largest force, of the Falcon and of all else that is felt, as --force-limit; default: 4 of the Falcon");
}

void FalconOptions::complete(const CLI::App& command, ContactParameters& contact) const
{
  contact.forceLimit =
    command.count("--max-force") > 0 ? std::min(contact.forceLimit, this->maximumForce) : contact.forceLimit;
}

FalconSettings FalconOptions::settings() const
{
  FalconSettings result;
  result.firmwareFile = this->firmware;
  result.limits.maximumForce = this->maximumForce;
  result.cancelled = stopIsRequested;
  return result;
}

} // namespace pointhaptics::app
