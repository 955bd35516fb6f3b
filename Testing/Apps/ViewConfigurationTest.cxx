#include "RunProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{

class ViewConfiguration : public pointhaptics::apptest::CommandLine
{
protected:
  nlohmann::json written(std::vector<std::string> arguments) const
  {
    arguments.insert(arguments.begin(), { "view", "in.ply", "--write-config", "out.json" });
    EXPECT_EQ(this->succeed(arguments), "settings: out.json\n");
    return nlohmann::json::parse(this->read("out.json"));
  }
};

TEST_F(ViewConfiguration, HoldsTheOptionsThatWereGiven)
{
  const nlohmann::json settings =
    this->written({ "--stiffness", "400", "--watch", "--translate", "0,0.01,0", "--up", "y" });
  EXPECT_EQ(settings,
    nlohmann::json::parse(R"({"stiffness": 400.0, "watch": true, "translate": "0,0.01,0", "up": "y"})"));
}

TEST_F(ViewConfiguration, ComesBackThroughConfigAndGivesWayToTheCommandLine)
{
  this->write("first.json", this->written({ "--stiffness", "400", "--dims", "50", "--watch" }).dump());
  const nlohmann::json settings = this->written({ "--config", "first.json", "--stiffness", "300" });
  EXPECT_EQ(settings, nlohmann::json::parse(R"({"stiffness": 300.0, "dims": 50.0, "watch": true})"));
}

TEST_F(ViewConfiguration, KeepsNamesThatLookLikeNumbers)
{
  const nlohmann::json settings =
    this->written({ "--color-by", "1e3", "--neighbors", "20", "--beta", "2.50" });
  EXPECT_EQ(settings, nlohmann::json::parse(R"({"color-by": "1e3", "neighbors": 20, "beta": "2.50"})"));
  this->write("first.json", settings.dump());
  EXPECT_EQ(this->written({ "--config", "first.json" }), settings);
}

TEST_F(ViewConfiguration, LeavesOutWhatIsADeedAndNoState)
{
  EXPECT_EQ(this->written({ "--screenshot", "picture.png", "--verbose" }), nlohmann::json::object());
  EXPECT_FALSE(this->exists("picture.png")) << "writing the configuration is all that is done";
}

/// A value for each option of view that is state; "" for flags. Options that are deeds have none.
const std::map<std::string, std::string>& valuesOfOptions()
{
  static const std::map<std::string, std::string> values = { { "--together", "" }, { "--watch", "" },
    { "--size", "320x240" }, { "--path", "hip.csv" }, { "--device", "none" },
    { "--falcon-firmware", "image.bin" }, { "--max-force", "3" }, { "--up", "y" }, { "--color-by", "Height" },
    { "--point-size", "4" }, { "--resolution", "0.5" }, { "--columns", "x,y,z" }, { "--salvage", "" },
    { "--vertices", "" }, { "--bind", "help=Ctrl+h Ctrl+j,rotate-x=Ctrl+x" },
    { "--camera", "0,0,1,0,0,0,0,1,0" }, { "--push-pointer", "" }, { "--axes", "" }, { "--figure", "" },
    { "--ambient", "" }, { "--felt", "" }, { "--full-screen", "" }, { "--sound", "" },
    { "--projection", "parallel" }, { "--background", "white" }, { "--theme", "high-contrast" },
    { "--stereo", "red-blue" }, { "--point-scale", "2" }, { "--edl-strength", "0.5" },
    { "--font-scale", "1.5" }, { "--color-map", "greys" }, { "--color-range", "1,2" },
    { "--measure", "0,0,0,1,1,1" }, { "--hide", "Classification=7,intensity=:20" },
    { "--clip", "0,1,0,1,0,1" }, { "--screenshot-size", "4000x3000" }, { "--transparent", "" },
    { "--kind", "terrain" }, { "--ideal", "torus" }, { "--method", "gradient-steps" },
    { "--preset", "paper" }, { "--stiffness", "500" }, { "--damping", "1.5" }, { "--mu-s", "0.5" },
    { "--force-limit", "3" }, { "--mu-d", "0.25" }, { "--no-covariance", "" }, { "--neighbors", "20" },
    { "--radius", "0.002" }, { "--rule", "scott" }, { "--beta", "3" }, { "--r1", "0.001" },
    { "--r2", "0.01" }, { "--dims", "100,50,25" }, { "--voxel", "0.002" }, { "--workspace", "0,1,0,1,0,1" },
    { "--scale", "1,2,3" }, { "--rotate", "30,0,0,1" }, { "--translate", "0,0,0.5" },
    { "--matrix", "2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1" }, { "--unit", "mm" }, { "--path-unit", "mm" },
    { "--path-time-unit", "ms" } };
  return values;
}

const std::set<std::string>& deeds()
{
  static const std::set<std::string> names = { "--help", "--version", "--verbose", "--screenshot",
    "--turntable", "--force-chart", "--trace", "--record", "--replay", "--config", "--set", "--write-config",
    "--recent", "--skip-unreadable", "--quiet", "--no-clobber", "--force", "--dry-run", "--marker-text",
    "--marker-socket" };
  return names;
}

TEST_F(ViewConfiguration, HasEveryOptionOfTheProgram)
{
  const std::string completion = this->succeed({ "manual", "bash" });
  const std::string begin = "view) words=\"";
  const std::size_t found = completion.find(begin);
  ASSERT_NE(found, std::string::npos);
  std::istringstream words(completion.substr(
    found + begin.size(), completion.find('"', found + begin.size()) - found - begin.size()));
  int seen = 0;
  for (std::string option; words >> option;)
  {
    if (deeds().count(option) > 0)
    {
      continue;
    }
    ++seen;
    const auto value = valuesOfOptions().find(option);
    ASSERT_NE(value, valuesOfOptions().end())
      << option << " is new: give it a value in this test, or name it a deed in ViewSettings.cxx and here";
    std::vector<std::string> arguments = { option };
    if (!value->second.empty())
    {
      arguments.push_back(value->second);
    }
    for (const char* needed : { "--method", "--mu-s" }) // of --preset and --mu-d
    {
      if (option == (std::string(needed) == "--method" ? "--preset" : "--mu-d"))
      {
        arguments.insert(arguments.end(), { needed, valuesOfOptions().at(needed) });
      }
    }
    const nlohmann::json settings = this->written(arguments);
    EXPECT_EQ(settings.count(option.substr(2)), 1u) << option << " is lost in the written file";
    this->write("first.json", settings.dump());
    EXPECT_EQ(this->written({ "--config", "first.json" }), settings) << option << " does not come back";
  }
  EXPECT_EQ(seen, int(valuesOfOptions().size())) << "an option of the test is none of the program's";
}

TEST_F(ViewConfiguration, RefusesBindingsAndCamerasThatCannotBe)
{
  this->refuse(2, { "view", "in.ply", "--bind", "hepl=F1" }, { "--bind hepl=F1", "no such action", "help," });
  this->refuse(2, { "view", "in.ply", "--bind", "help" }, { "--bind help", "no key", "help=Ctrl+h" });
  this->refuse(2, { "view", "in.ply", "--bind", "help=Alt+F1" }, { "Alt+F1", "Ctrl+z" });
  this->refuse(2, { "view", "in.ply", "--camera", "0,0,1,0,0,0,0,0,2" }, { "no view", "upward" });
  this->refuse(2, { "view", "in.ply", "--camera", "0,0,1" }, { "3 numbers", "9" });
  this->refuse(2, { "view", "in.ply", "--screenshot-size", "4000" },
    { "--screenshot-size 4000", "WIDTHxHEIGHT", "16 to 16384" });
  this->refuse(2, { "view", "in.ply", "--turntable", "36" }, { "--turntable 36", "--screenshot" });
  this->refuse(2, { "view", "in.ply", "--screenshot", "out.png", "--turntable", "1" },
    { "--turntable 1", "from 2", "9999" });
  this->refuse(2, { "view", "in.ply", "--clip", "0,1,2,1,0,1" }, { "--clip 0,1,2,1,0,1", "no box" });
  this->refuse(
    2, { "view", "in.ply", "--measure", "1,2,3,1,2,3" }, { "--measure 1,2,3,1,2,3", "same place" });
  this->refuse(2, { "view", "in.ply", "--hide", "Height=2:1" }, { "--hide Height=2:1", "ARRAY=LOW:HIGH" });
  this->write("bad.json", R"({"bind": ["help=F1", "hepl=F2"]})");
  this->refuse(2, { "view", "in.ply", "--config", "bad.json" }, { "bad.json", "\"bind\"", "hepl=F2" });
}

TEST_F(ViewConfiguration, SaysThatItCannotBeWritten)
{
  this->refuse(
    1, { "view", "in.ply", "--write-config", "nowhere/out.json" }, { "nowhere/out.json", "folder" });
}

TEST_F(ViewConfiguration, SetIsBetweenConfigAndCommandLine)
{
  this->write("first.json", R"({"stiffness": 400, "beta": 3, "axes": false})");
  EXPECT_EQ(this->written({ "--config", "first.json", "--set", "beta=2", "--set", "stiffness=500",
              "--stiffness", "300", "--set", "axes=true" }),
    nlohmann::json::parse(R"({"stiffness": 300.0, "beta": 2.0, "axes": true})"));
  this->refuse(2, { "view", "in.ply", "--set", "axse=true" }, { "--set", "\"axse\"", "did you mean axes?" });
  this->refuse(2, { "view", "in.ply", "--set", "axes" }, { "--set axes", "NAME=VALUE" });
  this->refuse(2, { "view", "in.ply", "--set", "beta=soft" }, { "--set", "\"beta\"", "soft" });
}

TEST_F(ViewConfiguration, HelpDescribesWhatIsUsedOftenAndNamesTheRest)
{
  const std::string help = this->succeed({ "view", "--help" });
  EXPECT_NE(help.find("--stiffness N_PER_M  "), std::string::npos);
  EXPECT_EQ(help.find("--stereo none|"), std::string::npos);
  EXPECT_NE(help.find(" --stereo "), std::string::npos);
  EXPECT_NE(this->succeed({ "manual", "man" }).find("\\-\\-stereo"), std::string::npos);
}

} // namespace
