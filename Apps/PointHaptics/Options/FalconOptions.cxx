#include "Options/FalconOptions.h"

#include "Options/Files.h"
#include "Options/OptionParsing.h"
#include "Terminal/StopSignals.h"

#include <CLI/CLI.hpp>

namespace pointhaptics
{
namespace app
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
  addNumber(command, "--max-force", this->maximumForce, { 0.0, kLargestForce }, "N",
    "Largest force of the Falcon; default 4");
}

FalconSettings FalconOptions::settings() const
{
  FalconSettings result;
  result.firmwareFile = this->firmware;
  result.limits.maximumForce = this->maximumForce;
  result.cancelled = stopIsRequested;
  return result;
}

} // namespace app
} // namespace pointhaptics
