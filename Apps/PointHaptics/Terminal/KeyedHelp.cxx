#include "Terminal/KeyedHelp.h"

#include "HapticBindings.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pointhaptics
{
namespace app
{
namespace
{

/// An option that a key does too: its help, and what stands behind the key there.
struct KeyedHelp
{
  const char* option;
  const char* words;
  std::vector<HapticAction> actions;
  const char* rest = "";
};

const std::vector<KeyedHelp>& keyedHelps()
{
  static const std::vector<KeyedHelp> helps = {
    { "--together", "All files as one cloud; default: one at a time",
      { HapticAction::NextFile, HapticAction::PreviousFile } },
    { "--write-config", "Write the options in force as a file for --config, and end",
      { HapticAction::WriteSettings }, " writes those of the window" },
    { "--color-by",
      "Array to colour by: rgb, height, density, proxyradius, residual (the distance of each voxel mean from "
      "the surface that is felt) or one of the file, in upper or lower case, with :x, :0 or :magnitude for a "
      "component of a vector; default: rgb, or height",
      { HapticAction::Colors } },
    { "--push-pointer", "The touch pushes the mouse pointer while the hand follows it",
      { HapticAction::PushPointer } },
    { "--axes", "A box about the cloud with its bounds in metres of the file, and where its axes point",
      { HapticAction::Axes } },
    { "--figure", "Nothing but the cloud in one colour on white, the workspace, proxy and normal",
      { HapticAction::Figure } },
    { "--ambient",
      "Ambient light from the normals of the surface that is felt: shows the shape of a cloud without "
      "colours",
      { HapticAction::Ambient } },
  };
  return helps;
}

} // namespace

void describeKeyedOptions(CLI::App& command, const std::vector<std::string>& bindings)
{
  HapticBindings table;
  for (const std::string& each : bindings)
  {
    const std::size_t equals = each.find('=');
    table.set(hapticActionFromName(each.substr(0, equals)), each.substr(equals + 1));
  }
  for (const KeyedHelp& help : keyedHelps())
  {
    std::vector<std::string> keys;
    for (const HapticAction action : help.actions)
    {
      const std::string key = table.firstLabel(action);
      keys.insert(keys.end(), key.empty() ? 0 : 1, key);
    }
    const std::string behind = keys.empty()
      ? std::string()
      : fmt::format("; key{} {}{}", keys.size() > 1 ? "s" : "", fmt::join(keys, " and "), help.rest);
    command.get_option(help.option)->description(help.words + behind);
  }
}

} // namespace app
} // namespace pointhaptics
