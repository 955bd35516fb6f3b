#include "Commands/Commands.h"

#include "Commands/FalconDiagnosis.h"
#include "Options/FalconOptions.h"
#include "Terminal/Messages.h"

#include "Devices/DeviceList.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kDevicesCommand = "devices";

struct DevicesOptions
{
  FalconOptions falcon;
  bool diagnose = false;
  bool yes = false;
  bool json = false;
  std::string report = "falcon-report.txt";
};

int printDevices(bool json)
{
  std::vector<std::string> notes;
  const std::vector<ListedDevice> devices = listDevices(notes);
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const ListedDevice& device : devices)
  {
    all.push_back({ { "kind", device.kind }, { "name", device.name }, { "place", device.place },
      { "usable", device.problem.empty() }, { "problem", device.problem } });
    if (!json)
    {
      const std::string place = device.place.empty() ? "" : ", " + device.place;
      fmt::print("{:<11} {}{}: {}\n", device.kind, device.name, place,
        device.problem.empty() ? "can be used" : device.problem);
    }
  }
  if (json)
  {
    printJson({ { "devices", all }, { "notes", notes } });
    return kSuccess;
  }
  for (const std::string& note : notes)
  {
    fmt::print("{}\n", note);
  }
  return kSuccess;
}

int runDevices(const DevicesOptions& options)
{
  if (!options.diagnose)
  {
    return printDevices(options.json);
  }
  std::string message;
  return diagnoseFalcon(options.falcon, options.report, options.yes, message)
    ? kSuccess
    : fail(kDevicesCommand, message);
}

} // namespace

void addDevicesCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand("devices", "List haptic devices and SpaceMice; check a Falcon");
  auto options = std::make_shared<DevicesOptions>();
  CLI::Option* diagnose = command->add_flag("--diagnose", options->diagnose,
    "Walk through the checks of a Falcon that need its owner: LEDs, homing, encoders, motors, rate");
  addOutput(*command, "--report", options->report, {}, "What the checks found; default falcon-report.txt")
    ->type_name("FILE")
    ->needs(diagnose);
  command
    ->add_flag("--yes", options->yes, "Take Enter for every answer: what can be measured without a person")
    ->needs(diagnose);
  command->add_flag("--json", options->json, "Print the list as JSON")->excludes(diagnose);
  options->falcon.addTo(*command);
  runAs(*command, exitCode, { [options](Files&) { return runDevices(*options); } });
}

} // namespace pointhaptics::app
