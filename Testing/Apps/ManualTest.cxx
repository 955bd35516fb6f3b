#include "RunProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

namespace
{

class Manual : public pointhaptics::apptest::CommandLine
{
};

TEST_F(Manual, CheatSheetInTheDocumentationIsTheHelpOfTheWindow)
{
  std::ifstream file(POINTHAPTICS_DOCUMENTATION "/CheatSheet.md");
  const std::string sheet{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  EXPECT_EQ(this->succeed({ "manual", "keys" }), sheet)
    << "write it anew: pointhaptics manual keys > Documentation/CheatSheet.md";
}

TEST_F(Manual, ManPageHasEveryCommandOptionAndKey)
{
  const std::string page = this->succeed({ "manual", "man" });
  EXPECT_EQ(page.rfind(".TH POINTHAPTICS 1", 0), 0u);
  for (const char* part : { "POINTHAPTICS VIEW", "POINTHAPTICS RESAMPLE", "\\-\\-write\\-config",
         "\\-\\-watch", "\\-\\-stiffness", "undo the last move" })
  {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(page.find("MANUAL"), std::string::npos) << "the hidden command is no command of the user's";
}

TEST_F(Manual, BashCompletesCommandsAndOptions)
{
  this->write("completion", this->succeed({ "manual", "bash" }));
  const std::string ask = "cd '" + this->path("") + "' && bash --norc -c '. ./completion; ";
  const auto complete = [&](const std::string& words, int place)
  {
    const std::string command = ask + "COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(place) +
      "; _pointhaptics; echo ${COMPREPLY[@]}' > answer";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return this->read("answer");
  };
  EXPECT_EQ(complete("pointhaptics resa", 1), "resample\n");
  EXPECT_EQ(complete("pointhaptics view --stif", 2), "--stiffness\n");
  EXPECT_EQ(complete("pointhaptics info --stif", 2), "\n");
  EXPECT_EQ(complete("pointhaptics info compl", 2), "completion\n");
}

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
  this->write("first.json", this->written({ "--stiffness", "400", "--dims", "50", "--smooth" }).dump());
  const nlohmann::json settings = this->written({ "--config", "first.json", "--stiffness", "300" });
  EXPECT_EQ(settings, nlohmann::json::parse(R"({"stiffness": 300.0, "dims": 50.0, "smooth": true})"));
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

TEST_F(ViewConfiguration, SaysThatItCannotBeWritten)
{
  this->refuse(
    1, { "view", "in.ply", "--write-config", "nowhere/out.json" }, { "nowhere/out.json", "folder" });
}

} // namespace
