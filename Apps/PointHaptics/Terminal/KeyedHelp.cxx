#include "Terminal/KeyedHelp.h"

#include "CommandRegistry.h"
#include "HapticViewer.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pointhaptics::app
{
namespace
{

/// An option that a key does too: its help, and what stands behind the key there.
struct KeyedHelp
{
  const char* option;
  const char* words;
  std::vector<std::string> commands = {}; ///< Empty: the command has the name of the option.
  const char* rest = "";
};

const std::vector<KeyedHelp>& keyedHelps()
{
  static const std::vector<KeyedHelp> helps = {
    { "--together", "All files as one cloud; default: one at a time", { "next-file", "previous-file" } },
    { "--write-config", "Write the options in force as a file for --config, and end", { "write-settings" },
      " writes those of the window" },
    { "--color-by",
      "Array to colour by: rgb, clay (one colour), height, density, proxyradius, residual (the distance of "
      "each voxel mean from the surface that is felt) or one of the file, in upper or lower case, with :x, "
      ":0 or "
      ":magnitude for a component of a vector; default: rgb, classification, clay or height, what suits",
      { "colors" } },
    { "--push-pointer", "The touch pushes the mouse pointer while the hand follows it" },
    { "--axes", "A box about the cloud with its bounds in metres of the file, and where its axes point" },
    { "--figure", "Nothing but the cloud in one colour on white, the workspace, proxy and normal" },
    { "--felt", "Show the voxel means that are felt instead of the points" },
    { "--ambient", "Light from the normals of the felt surface: the shape of a cloud without colours" },
    { "--sound", "Hear the touch: a tone as loud as the force, a click where contact begins" },
    { "--full-screen", "The window covers the screen, without a border" },
    { "--projection", "How the cloud is seen: perspective (the default), or parallel, without perspective" },
    { "--stereo",
      "A picture for each eye: by colours for red and cyan, or red and blue glasses, by lines, by pixels, "
      "beside "
      "each other, or on a screen that shows two" },
    { "--background", "What is behind the cloud; default dark" },
    { "--theme",
      "high-contrast: black or white background, larger texts on opaque plates, thick outlines and other "
      "colours of the marks of touch; default usual" },
    { "--point-scale", "All points are drawn this many times as large",
      { "points-larger", "points-smaller" } },
    { "--edl-strength",
      "How much darker points are that lie behind those around them (eye-dome lighting); 0: none; default "
      "1.6",
      { "depth-stronger", "depth-weaker" } },
    { "--color-map", "The colours that stand for numbers" },
    { "--color-range",
      "The values that have the first and the last of these colours; default: nearly all that occur; drag on "
      "the "
      "colour bar to change them",
      {}, " takes all again" },
    { "--hide", "Neither shows nor lets feel these values: Classification=7,intensity=:20",
      { "hide-outside" } },
    { "--clip",
      "Shows, lets feel and pick only what lies in this box, in coordinates of the file; default: all",
      { "clip-box" }, " shows its handles" },
    { "--screenshot-size",
      "Size of pictures that are written, whatever the window's is; they show at least what it shows; "
      "default: the window's, or --size",
      { "screenshot" }, " writes one" },
    { "--turntable",
      "With --screenshot OUT.png: as many pictures, OUT-001.png and so on, from all around the cloud", {},
      " turns in the window" },
    { "--measure", "Shows the distance of two places of the file, in its coordinates and its unit", {},
      " measures between points that are clicked on" },
  };
  return helps;
}

} // namespace

void describeKeyedOptions(CLI::App& command, const std::vector<std::string>& bindings)
{
  CommandRegistry table = HapticViewer::commands();
  table.bind(bindings);
  for (const KeyedHelp& help : keyedHelps())
  {
    std::vector<std::string> keys;
    const std::string own = std::string(help.option).substr(2);
    for (const std::string& name : help.commands.empty() ? std::vector<std::string>{ own } : help.commands)
    {
      const std::string key = table.label(name);
      keys.insert(keys.end(), key.empty() ? 0 : 1, key);
    }
    const std::string behind = keys.empty()
      ? std::string()
      : fmt::format("; key{} {}{}", keys.size() > 1 ? "s" : "", fmt::join(keys, " and "), help.rest);
    command.get_option(help.option)->description(help.words + behind);
  }
}

} // namespace pointhaptics::app
