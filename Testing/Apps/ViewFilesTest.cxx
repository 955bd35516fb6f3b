// Files that cannot be read and devices that are not there, in `view` without a window.
#include "RunProgram.h"

#include "../Unit/IO/E57/E57File.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{

using pointhaptics::apptest::InputFrom;
using pointhaptics::apptest::Outcome;
using pointhaptics::apptest::parseTable;

class ViewFiles : public pointhaptics::apptest::CommandLine
{
protected:
  void SetUp() override
  {
    this->succeed({ "generate", "sphere", "-n", "2000", "-o", "good.ply" });
    this->write("bad.laz", "LASF, and nothing more");
    this->write("worse.obj", "");
    this->write("path.csv", "t,x,y,z\n0,0,0,0.03\n0.1,0,0,0.02\n");
  }
  /// `view files... options...` with files that need no display.
  Outcome view(std::vector<std::string> files, const std::vector<std::string>& options = {}) const
  {
    files.insert(files.begin(), "view");
    files.insert(files.end(), { "--unit", "m", "--path", "path.csv", "--trace", "trace.csv" });
    files.insert(files.end(), options.begin(), options.end());
    return this->run(files);
  }
  static std::ptrdiff_t numberOfLines(const std::string& text)
  {
    return std::count(text.begin(), text.end(), '\n');
  }
  static bool contains(const std::string& text, const std::string& part)
  {
    return text.find(part) != std::string::npos;
  }
};

TEST_F(ViewFiles, ThatCannotBeReadAreSkipped)
{
  const Outcome outcome = this->view({ "bad.laz", "worse.obj", "good.ply" }, { "--skip-unreadable" });
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_TRUE(contains(outcome.output, "2000 points")) << outcome.output;
  EXPECT_TRUE(this->exists("trace.csv"));
  EXPECT_EQ(numberOfLines(outcome.errors), 3) << outcome.errors;
  EXPECT_EQ(outcome.errors.rfind("pointhaptics view: warning: skipped: bad.laz: ", 0), 0u) << outcome.errors;
  EXPECT_TRUE(contains(outcome.errors, "warning: skipped: worse.obj: ")) << outcome.errors;
}

TEST_F(ViewFiles, SayHowManyOfTheirPointsAreInvalid)
{
  this->write("some.xyz", "1 2 3\nnan nan nan\n1 2 4\n1 3 4\ninf 0 0\n");
  const Outcome some = this->view({ "some.xyz" });
  EXPECT_EQ(some.output.rfind("5 points, 2 of them NaN or infinite, ", 0), 0u) << some.output;
  EXPECT_FALSE(contains(this->view({ "good.ply" }).output, "NaN"));
}

TEST_F(ViewFiles, SayThatPointsAtZeroAreNotDrawn)
{
  this->write("zeros.xyz", "1 2 3\n0 0 0\n1 2 4\n0 0 0\n1 3 4\n-0 0 0\n");
  const std::string note = "warning: zeros.xyz: 3 points at (0, 0, 0), which scanners write for rays without "
                           "return, are felt but not drawn; --felt draws what is felt";
  EXPECT_TRUE(contains(this->view({ "zeros.xyz" }).errors, note));
  EXPECT_TRUE(
    contains(this->view({ "good.ply", "zeros.xyz" }, { "--together" }).errors, "3 points at (0, 0, 0)"));
  EXPECT_FALSE(contains(this->view({ "zeros.xyz" }, { "--felt" }).errors, "(0, 0, 0)"));
  EXPECT_FALSE(contains(this->view({ "zeros.xyz" }, { "--clip", "0.5,2,1,4,2,5" }).errors, "(0, 0, 0)"));
  EXPECT_TRUE(
    contains(this->run({ "info", "zeros.xyz" }).output, "note     3 points at (0, 0, 0), which scanners"));
  // One may well be a point, and where there are no others, all are drawn.
  this->write("one.xyz", "1 2 3\n0 0 0\n1 2 4\n1 3 4\n");
  this->write("same.xyz", "0 0 0\n0 0 0\nnan 0 0\n");
  for (const char* file : { "one.xyz", "same.xyz" })
  {
    EXPECT_FALSE(contains(this->view({ file }).errors, "(0, 0, 0)")) << file;
    EXPECT_FALSE(contains(this->run({ "info", file }).output, "(0, 0, 0)")) << file;
  }
}

TEST_F(ViewFiles, ThatAPictureWouldMissAreAnError)
{
  for (const std::string file : { "bad.laz", "gone.ply" })
  {
    for (const std::vector<std::string>& files :
      { std::vector<std::string>{ "good.ply", file }, { file, "good.ply" } })
    {
      const Outcome outcome = this->view(files);
      EXPECT_EQ(outcome.exitCode, 1);
      EXPECT_TRUE(contains(outcome.errors, file + ": ")) << outcome.errors;
      EXPECT_TRUE(contains(outcome.errors, "--skip-unreadable shows the others")) << outcome.errors;
    }
  }
  EXPECT_FALSE(this->exists("trace.csv"));
}

TEST_F(ViewFiles, AfterOneThatCanBeReadAreNotLookedAt)
{
  const Outcome outcome = this->view({ "good.ply", "bad.laz" }, { "--skip-unreadable" });
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.errors,
    "pointhaptics view: warning: only the first of the 2 files is shown; --together shows all\n");
}

TEST_F(ViewFiles, WithoutTheArrayThatWasAskedForAreSkippedByName)
{
  this->write("warm.csv", "x,y,z,Warmth\n0,0,0,1\n0.01,0,0,2\n0,0.01,0,3\n0.01,0.01,0,4\n");
  const Outcome outcome = this->view({ "good.ply", "warm.csv" }, { "--color-by", "Warmth" });
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_TRUE(contains(outcome.errors, "skipped: good.ply: --color-by Warmth: ")) << outcome.errors;
}

TEST_F(ViewFiles, ThatCannotBeReadAtAllEndTheProgramWithAnError)
{
  const Outcome outcome = this->view({ "bad.laz", "worse.obj" }, { "--skip-unreadable" });
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_EQ(outcome.output, "");
  EXPECT_EQ(numberOfLines(outcome.errors), 3) << outcome.errors;
  EXPECT_TRUE(contains(outcome.errors, "pointhaptics view: none of the 2 files can be shown"))
    << outcome.errors;
  EXPECT_FALSE(this->exists("trace.csv"));
  this->refuse(1, { "view", "bad.laz" }, { "bad.laz" });
}

TEST_F(ViewFiles, ThatAreOneCloudMustAllBeRead)
{
  this->refuse(1, { "view", "bad.laz", "good.ply", "--together" }, { "bad.laz" });
}

TEST_F(ViewFiles, ThatAreOneCloudHaveTheArraysOfEach)
{
  this->write("warm.csv", "x,y,z,Warmth\n0,0,0,1\n0.01,0,0,2\n0,0.01,0,3\n0.01,0.01,0,4\n");
  const Outcome outcome = this->view({ "good.ply", "warm.csv" }, { "--together", "--color-by", "Warmth" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_TRUE(contains(outcome.output, "2004 points")) << outcome.output;
  EXPECT_TRUE(contains(outcome.errors, "have no Warmth: their points have NaN there")) << outcome.errors;
}

TEST_F(ViewFiles, ThatAreNotReadWithAllTheyHaveAreShownWithAWarning)
{
  E57TestFile file{ { { { e57Double("cartesianX", { 0.0, 1.0 }), e57Double("cartesianY", { 0.0, 1.0 }),
    e57Double("cartesianZ", { 0.0, 1.0 }) } } } };
  file.xml = "<images2D type=\"Vector\"><vectorChild type=\"Structure\"/></images2D>";
  this->write("scan.e57", file.bytes());
  const Outcome outcome = this->view({ "scan.e57" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "pointhaptics view: warning: scan.e57: 1 image is not read: only points are\n");
}

TEST_F(ViewFiles, AreNotDrawnForADeviceThatIsNotThere)
{
  const std::vector<std::string> parts = { "--device falcon: falcon: ", "--device none" };
  this->refuse(1, { "view", "good.ply", "--device", "falcon", "--screenshot", "out.png" }, parts);
  this->refuse(1,
    { "view", "good.ply", "--unit", "m", "--path", "path.csv", "--trace", "out.csv", "--device", "falcon" },
    parts);
  const Outcome outcome = this->view({ "good.ply" }, { "--device", "none" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
}

TEST_F(ViewFiles, ComeByStandardInput)
{
  {
    const InputFrom input(this->path("good.ply"));
    const Outcome outcome = this->view({ "-" });
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.errors, "");
    EXPECT_TRUE(contains(outcome.output, "2000 points")) << outcome.output;
  }
  const auto forces = parseTable(this->read("trace.csv")).at("force_z");
  EXPECT_EQ(this->view({ "good.ply" }).exitCode, 0);
  EXPECT_EQ(parseTable(this->read("trace.csv")).at("force_z"), forces);
  EXPECT_GT(*std::max_element(forces.begin(), forces.end()), 0.0);
  const InputFrom bad(this->path("bad.laz"));
  const Outcome outcome = this->view({ "-" });
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_EQ(outcome.errors.rfind("pointhaptics view: standard input: ", 0), 0u) << outcome.errors;
}

TEST_F(ViewFiles, OfStandardInputSayWhatDoesNotGoWithIt)
{
  const InputFrom input(this->path("good.ply"));
  this->refuse(2, { "view", "-", "-" }, { "can be read once" });
  this->refuse(2, { "view", "-", "--watch" }, { "--watch: standard input is read once" });
  this->refuse(2, { "view", "-", "--write-config", "c.json" }, { "--write-config c.json: settings" });
}

TEST_F(ViewFiles, WithOptionsThatHaveNoEffectNameThem)
{
  const Outcome outcome = this->view({ "good.ply" },
    { "--path-time-unit", "s", "--bind", "help=F2", "--skip-unreadable", "--falcon-firmware", "no.bin",
      "--device", "none", "--sound" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_TRUE(contains(outcome.errors, "--bind has no effect without a window")) << outcome.errors;
  EXPECT_TRUE(contains(outcome.errors, "--sound has no effect without a window")) << outcome.errors;
  EXPECT_FALSE(contains(outcome.errors, "--skip-unreadable")) << outcome.errors;
  EXPECT_TRUE(contains(outcome.errors, "--falcon-firmware has no effect with --device none"));
  EXPECT_FALSE(contains(outcome.errors, "--path-time-unit")) << outcome.errors;
}

} // namespace
