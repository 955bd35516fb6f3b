#include "Options/TouchOptions.h"

#include "Options/SettingOptions.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>

namespace pointhaptics::app
{

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, ProxyMethod& method)
{
  return addEnum<ProxyMethod>(command, row, method,
    { { "surface-fit", ProxyMethod::SurfaceFit }, { "sphere", ProxyMethod::Sphere },
      { "gradient-steps", ProxyMethod::GradientSteps } });
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, GradientStepsParameters& steps)
{
  const auto keep = [&steps](int isPaper)
  { steps = isPaper ? GradientStepsParameters::paper() : GradientStepsParameters::tuned(); };
  return addChoice(command, row.option, keep, { { "tuned", 0 }, { "paper", 1 } }, row.text);
}

void TouchOptions::addTo(CLI::App& command)
{
  addSettings(command, this->parameters, kTouchOptions, kTouchGroup);
  addSettings(command, this->parameters.contact, kContactOptions, kTouchGroup);
}

void TouchOptions::complete(const CLI::App& command)
{
  if (command.count("--preset") > 0 && this->parameters.method != ProxyMethod::GradientSteps)
  {
    warn(command.get_name(), kPresetIsIdle);
  }
  ContactParameters& contact = this->parameters.contact;
  if (command.count("--mu-s") == 0)
  {
    contact.staticFriction = contact.dynamicFriction;
  }
  if (contact.dynamicFriction > contact.staticFriction)
  {
    throwUsage("--mu-d", fmt::format("{}", contact.dynamicFriction),
      fmt::format("above --mu-s {}; give mu_d <= mu_s", contact.staticFriction));
  }
}

void checkForceLimitOfDevices(const ContactParameters& contact, const std::string& cure)
{
  const double most = ForceLimits().maximumForce;
  if (contact.forceLimit > most)
  {
    throwUsage("--force-limit", fmt::format("{}", contact.forceLimit),
      fmt::format("a servo loop pushes a hand with at most {} N; give that or less{}", most, cure));
  }
}

void setContact(nlohmann::ordered_json& settings, const ContactParameters& contact)
{
  std::size_t i = 0;
  visitMembers(contact,
    [&](const char*, double member)
    {
      const SettingOption& row = kContactOptions[i++];
      if (row.option)
      {
        nlohmann::ordered_json& setting = settings[std::string(row.option).substr(2)];
        setting = std::isfinite(member) ? nlohmann::ordered_json(member) : nlohmann::ordered_json("inf");
      }
    });
}

} // namespace pointhaptics::app
