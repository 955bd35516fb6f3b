#include "View/PictureOptions.h"

#include "Options/OptionParsing.h"

#include "ClippedCloud.h"
#include "CloudAppearance.h"
#include "ColorMaps.h"
#include "StereoPicture.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace pointhaptics::app
{
namespace
{

/// x, y, z of both ends; while a person has chosen only one, there is none to keep.
constexpr std::size_t kNumbersOfDistance = 6;

} // namespace

void addPictureOptions(CLI::App& command, PictureSettings& picture)
{
  const char* const group = "Picture";
  const auto project = [&picture](int choice) { picture.parallel = choice == 1; };
  addChoice(command, "--projection", project, { { "perspective", 0 }, { "parallel", 1 } }, "")->group(group);
  addWord(command, "--stereo", picture.stereo, stereoNames(), "")->group(group);
  addWord(command, "--background", picture.background, groundNames(), "")->group(group);
  addWord(command, "--theme", picture.theme, themeNames(), "")->group(group);
  addNumber(command, "--point-scale", picture.pointScale, { 0.1, 10.0 }, "FACTOR", "")->group(group);
  addNumber(command, "--edl-strength", picture.depthStrength, { 0.0, 10.0 }, "STRENGTH", "")->group(group);
  addNumber(command, "--font-scale", picture.fontScale, { 0.5, 4.0 }, "FACTOR",
    "Size of all texts over the usual one, which follows the screen's dots per inch; default 1")
    ->group(group);
  addWord(command, "--color-map", picture.colorMap, colorMapNames(), "")->group(group);
  const auto checkRange = [](const std::vector<double>& range)
  { return range[0] < range[1] ? "" : "the first colour's value must be less than the last one's"; };
  addNumbers(command, "--color-range", picture.colorRange, { 2 }, checkRange, "LOW,HIGH", "")->group(group);
  const auto hide = [&picture](const std::string& text)
  {
    std::string wrong;
    picture.hidden = hiddenIn(text, wrong);
    if (!wrong.empty())
    {
      throwUsage("--hide", wrong, "no values; give ARRAY=VALUE or ARRAY=LOW:HIGH, such as Classification=7");
    }
  };
  command.add_option_function<std::string>("--hide", hide, "")->type_name("ARRAY=VALUE,...")->group(group);
  const auto checkEnds = [](const std::vector<double>& ends)
  {
    return std::equal(ends.begin(), ends.begin() + 3, ends.begin() + 3)
      ? "both are the same place; give two, in coordinates of the file"
      : "";
  };
  addNumbers(command, "--measure", picture.measure, { 6 }, checkEnds, "X,Y,Z,X,Y,Z", "")->group(group);
  const auto keepSize = [&picture](int width, int height) { picture.screenshotSize = { width, height }; };
  addSize(command, "--screenshot-size", keepSize, "")->group(group);
  command
    .add_flag("--transparent", picture.transparent,
      "Pictures have no background: what they are laid on shows through")
    ->group(group);
}

void setPicture(nlohmann::ordered_json& settings, const PictureSettings& picture)
{
  settings["projection"] = picture.parallel ? "parallel" : "perspective";
  settings["stereo"] = picture.stereo;
  settings["background"] = picture.background;
  settings["theme"] = picture.theme;
  settings["point-scale"] = picture.pointScale;
  settings["edl-strength"] = picture.depthStrength;
  settings["font-scale"] = picture.fontScale;
  settings["color-map"] = picture.colorMap;
  settings["transparent"] = picture.transparent;
  setUnlessEmpty(settings, "color-range", picture.colorRange);
  std::vector<std::string> hidden;
  std::transform(picture.hidden.begin(), picture.hidden.end(), std::back_inserter(hidden), textOf);
  setUnlessEmpty(settings, "hide", fmt::format("{}", fmt::join(hidden, ",")));
  const auto& size = picture.screenshotSize;
  setUnlessEmpty(
    settings, "screenshot-size", size[0] > 0 ? fmt::format("{}x{}", size[0], size[1]) : std::string());
  const bool isWhole = picture.measure.size() == kNumbersOfDistance;
  setUnlessEmpty(settings, "measure", isWhole ? picture.measure : decltype(picture.measure)());
}

} // namespace pointhaptics::app
