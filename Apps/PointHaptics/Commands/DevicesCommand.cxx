#include "Commands/Commands.h"

#include "Commands/FalconDiagnosis.h"
#include "Options/Files.h"
#include "Options/SharedOptions.h"
#include "Terminal/Messages.h"

#include "Devices/DeviceList.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <vector>

namespace pointhaptics::app
{
namespace
{

void printDevices(bool json)
{
  std::vector<std::string> notes;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  std::string text;
  for (const ListedDevice& device : listDevices(notes))
  {
    all.push_back({ { "kind", device.kind }, { "name", device.name }, { "place", device.place },
      { "usable", device.problem.empty() }, { "problem", device.problem } });
    text += fmt::format("{:<11} {}{}{}: {}\n", device.kind, device.name, device.place.empty() ? "" : ", ",
      device.place, device.problem.empty() ? "can be used" : device.problem);
  }
  for (const std::string& note : notes)
  {
    text += note + "\n";
  }
  json ? printJson({ { "devices", all }, { "notes", notes } }) : printNow(stdout, text);
}

struct DevicesCommand : Command
{
  FalconOptions falcon;
  bool diagnose = false;
  bool yes = false;
  bool json = false;
  std::string report = "falcon-report.txt";

  void addTo(CLI::App& command) override
  {
    CLI::Option* diagnosis = command.add_flag("--diagnose", this->diagnose,
      "Walk through the checks of a Falcon that need its owner: LEDs, homing, encoders, motors, rate");
    addOutput(command, "--report", this->report, {}, "What the checks found; default falcon-report.txt")
      ->type_name("FILE")
      ->needs(diagnosis);
    command
      .add_flag("--yes", this->yes, "Take Enter for every answer: what can be measured without a person")
      ->needs(diagnosis);
    command.add_flag("--json", this->json, "Print the list as JSON")->excludes(diagnosis);
    this->falcon.addTo(command);
  }

  int run(Files&) override
  {
    this->diagnose ? diagnoseFalcon(this->falcon.settings(), this->report, this->yes)
                   : printDevices(this->json);
    return kSuccess;
  }
};

} // namespace

Command* devicesCommand()
{
  return new DevicesCommand;
}

} // namespace pointhaptics::app
