#include "Options/BandwidthOptions.h"

#include "Options/SettingOptions.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace pointhaptics::app
{

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, BandwidthRule& rule)
{
  return addEnum<BandwidthRule>(command, row, rule,
    { { "normal-reference", BandwidthRule::NormalReference },
      { "silverman-robust", BandwidthRule::SilvermanRobust }, { "scott", BandwidthRule::ScottMultivariate },
      { "silverman", BandwidthRule::SilvermanMultivariate },
      { "sheather-jones", BandwidthRule::SheatherJones } });
}

void BandwidthOptions::addTo(CLI::App& command)
{
  addSettings(command, this->settings, kBandwidthOptions, kBandwidthGroup);
  CLI::Option* nearest = command.get_option("--neighbors");
  CLI::Option* ball = command.get_option("--radius");
  nearest->each([this](const std::string&) { this->settings.fixedRadius = false; });
  ball->each([this](const std::string&) { this->settings.fixedRadius = true; });
  ball->excludes(nearest);
  // Options are processed in the order they were added: r1 is known here.
  command.get_option("--r2")->each(
    [this](const std::string& text)
    {
      double value = 0.0;
      if (parseNumber(text, value) && value < this->settings.minimumRadius)
      {
        throw CLI::ValidationError(
          fmt::format("{} is below --r1 {}; give r1 <= r2", value, this->settings.minimumRadius));
      }
    });
}

} // namespace pointhaptics::app
