#include "RunProgram.h"

#include <gtest/gtest.h>

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

} // namespace
