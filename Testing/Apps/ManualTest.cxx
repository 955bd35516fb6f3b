#include "RunProgram.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace
{

class Manual : public pointhaptics::apptest::CommandLine
{
};

TEST_F(Manual, FormatsOfTheReadmeAreThoseOfTheProgram)
{
  std::ifstream file(POINTHAPTICS_DOCUMENTATION "/../README.md");
  const std::string readme((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(readme.find(this->succeed({ "manual", "formats" })), std::string::npos)
    << "put the table of pointhaptics manual formats into the README";
}

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
  for (const char* part :
    { "POINTHAPTICS VIEW", "POINTHAPTICS RESAMPLE", "\\-\\-write\\-config", "\\-\\-watch", "SH EXAMPLES",
      "SH EXIT STATUS", "128 + N", "143 SIGTERM", "\\-\\-stiffness", "undo the last move" })
  {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  EXPECT_NE(page.find("POINTHAPTICS MANUAL"), std::string::npos);
  EXPECT_NE(this->succeed({ "--help" }).find("  manual "), std::string::npos);
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
  EXPECT_EQ(complete("pointhaptics view --background w", 3), "white\n");
  EXPECT_EQ(complete("pointhaptics view --background = w", 4), "white\n");
  EXPECT_EQ(complete("pointhaptics feel --method =", 3), "surface-fit sphere gradient-steps\n");
  EXPECT_EQ(complete("pointhaptics view --up \"\"", 3), "auto x -x y -y z -z\n");
  EXPECT_EQ(complete("pointhaptics cloud.ply --kind ter", 3), "terrain\n") << "view is the default command";
  EXPECT_EQ(complete("pointhaptics feel --method surf", 3), "surface-fit\n");
  EXPECT_EQ(complete("pointhaptics generate tor", 2), "torus\n");
  EXPECT_EQ(complete("pointhaptics manual ke", 2), "keys\n");
  EXPECT_EQ(complete("pointhaptics man", 1), "manual\n");
  EXPECT_EQ(complete("pointhaptics compare --methods sph", 3), "sphere\n");
  EXPECT_EQ(complete("pointhaptics compare --methods sphere,surf", 3), "sphere,surface-fit\n");
  EXPECT_EQ(complete("pointhaptics view --bind screens", 3), "screenshot=\n");
  EXPECT_EQ(complete("pointhaptics view --color-by den", 3), "density\n");
  EXPECT_EQ(complete("pointhaptics view --measure 0,0", 3), "\n") << "numbers are no choice";
}

} // namespace
