#include "RunProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

namespace
{

using Words = std::vector<std::string>;

class Usage : public pointhaptics::apptest::CommandLine
{
protected:
  /// A path and a cloud small enough to be made for every test.
  void makeInputs() const
  {
    this->succeed({ "generate", "sphere", "-n", "200", "-o", "in.ply" });
    this->write("hip.csv", "t,x,y,z\n0,0,0,0.03\n0.01,0,0,0.029\n");
  }
};

TEST_F(Usage, HelpAndVersionWorkEverywhere)
{
  EXPECT_EQ(this->succeed({ "--version" }).rfind("pointhaptics ", 0), 0u);
  EXPECT_NE(this->succeed({ "--help" }).find("resample"), std::string::npos);
  for (const char* command : { "view", "feel", "resample", "bandwidth", "info", "generate" })
  {
    EXPECT_EQ(this->succeed({ command, "--version" }).rfind("pointhaptics ", 0), 0u);
    EXPECT_NE(this->succeed({ command, "--help" }).find(command), std::string::npos);
  }
}

TEST_F(Usage, HelpNamesTheKeysThatAreBound)
{
  // Lines are broken where they may be.
  const auto help = [this](Words options)
  {
    options.insert(options.begin(), "view");
    options.emplace_back("--help");
    std::string text = this->succeed(options);
    std::string words;
    for (const char letter : text)
    {
      const bool isBlank = letter == ' ' || letter == '\n';
      words += isBlank ? (words.empty() || words.back() == ' ' ? "" : " ") : std::string(1, letter);
    }
    return words;
  };
  const auto says = [](const std::string& text, const std::string& part)
  { return text.find(part) != std::string::npos; };
  const std::string usual = help({});
  for (const char* part : { "where its axes point; key A ", "proxy and normal; key O ",
         "one at a time; keys N and B ", "and end; key W writes those of the window ",
         "default: rgb, classification, clay or height, what suits; key M " })
  {
    EXPECT_TRUE(says(usual, part)) << part << "\n" << usual;
  }
  const std::string bound = help({ "--bind", "axes=F5,next-file=F7,write-settings=Ctrl+s,figure=,colors=a" });
  for (const char* part : { "where its axes point; key F5 ", "proxy and normal --",
         "one at a time; keys F7 and B ", "and end; key Ctrl+s writes those of the window ",
         "default: rgb, classification, clay or height, what suits; key A " })
  {
    EXPECT_TRUE(says(bound, part)) << part << "\n" << bound;
  }
}

TEST_F(Usage, NothingOrNoCommandIsAUsageError)
{
  this->refuse(2, {}, { "--help" });
  this->refuse(2, { "resampel", "in.ply" }, { "'resampel'; did you mean resample?", "--help" });
  this->refuse(2, { "resample" }, { "pointhaptics resample: ", "IN", "--help" });
  this->refuse(2, { "resample", "in.ply" }, { "--output", "--help" });
  this->refuse(2, { "feel", "in.ply", "-o", "out.csv" }, { "--path" });
  this->refuse(2, { "info" }, { "FILE" });
}

TEST_F(Usage, UnknownAndSurplusArgumentsAreUsageErrors)
{
  this->refuse(
    2, { "resample", "a.ply", "b.ply", "-o", "c.ply" }, { "pointhaptics resample: ", "c.ply: 2 inputs" });
  this->refuse(
    2, { "bandwidth", "a.ply", "b.ply", "-o", "c.ply" }, { "c.ply: 2 inputs", "{stem}", "--merge" });
  this->refuse(2, { "feel", "a.ply", "b.ply", "--path", "h.csv", "-o", "c.csv" }, { "b.ply" });
  this->refuse(2, { "generate", "sphere", "torus", "-n", "5", "-o", "c.ply" }, { "torus" });
  this->refuse(2, { "resample", "a.ply", "-o", "c.ply", "--foo", "1" }, { "--foo" });
  this->refuse(
    2, { "info", "a.ply", "--foo", "--bar", "--baz" }, { "unexpected arguments --foo --bar --baz;" });
  this->refuse(2, { "info", "a.ply", "--foo" }, { "unexpected argument --foo;" });
  this->refuse(2, { "bandwidth", "a.ply", "-o", "c.ply", "--voxel", "1" }, { "--voxel" });
  this->refuse(2, { "resample", "a.ply", "-o", "c.ply", "--dims" }, { "--dims" });
  this->refuse(2, { "resample", "a.ply", "-o", "c.ply", "--dims", "3", "--dims", "4" }, { "--dims" });
}

TEST_F(Usage, AFileThatLooksLikeAnOptionIsToldHowToBeGiven)
{
  this->write("-dash.xyz", "1 2 3\n");
  const std::string cure = "-dash.xyz: begins with - as options do; give the file as ./-dash.xyz";
  this->refuse(2, { "info", "-dash.xyz" }, { cure });
  this->refuse(2, { "view", "-dash.xyz" }, { cure });
  this->refuse(2, { "convert", "-dash.xyz", "out.ply" }, { cure });
  this->refuse(2, { "resample", "-dash.xyz", "-o", "out.ply" }, { cure });
  this->refuse(2, { "info", "-gone.xyz" }, { "see pointhaptics info --help" });
  EXPECT_NE(this->succeed({ "info", "./-dash.xyz" }).find("points   1"), std::string::npos);
  EXPECT_NE(this->succeed({ "info", "--", "-dash.xyz" }).find("points   1"), std::string::npos);
}

TEST_F(Usage, AnOutputThroughALinkKeepsTheLink)
{
  this->makeInputs();
  this->write("real.csv", "old");
  std::filesystem::create_symlink("real.csv", this->path("link.csv"));
  this->succeed({ "feel", "in.ply", "--path", "hip.csv", "-o", "link.csv" });
  EXPECT_TRUE(std::filesystem::is_symlink(this->path("link.csv")));
  EXPECT_EQ(this->read("real.csv").rfind("t,hip_x", 0), 0u);
}

TEST_F(Usage, AnOutputThatIsNoRegularFileIsNotReplaced)
{
  this->makeInputs();
  ASSERT_EQ(mkfifo(this->path("pipe").c_str(), 0600), 0);
  const int reader = ::open(this->path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  this->succeed({ "feel", "in.ply", "--path", "hip.csv", "-o", "pipe" });
  char head[8] = {};
  EXPECT_EQ(::read(reader, head, 7), 7);
  EXPECT_STREQ(head, "t,hip_x");
  ::close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(this->path("pipe")));
}

TEST_F(Usage, PicturesArePng)
{
  this->makeInputs();
  this->refuse(2, { "view", "in.ply", "--screenshot", "a.jpg" }, { "--screenshot", "a.jpg", ".png" });
}

TEST_F(Usage, AStillPictureHasNoTouchToWrite)
{
  this->makeInputs();
  this->refuse(2, { "view", "in.ply", "--screenshot", "a.png", "--trace", "t.csv" }, { "--trace", "--path" });
  this->refuse(2, { "view", "in.ply", "--screenshot", "a.png", "--force-chart", "f.png" },
    { "--force-chart", "--path" });
}

TEST_F(Usage, BadLatticeNumbersNameTheRange)
{
  const auto refuseOption = [this](const char* option, const char* value, const char* part) {
    this->refuse(2, { "resample", "a.ply", "-o", "c.ply", option, value }, { option, value, part });
  };
  refuseOption("--dims", "0", "from 1 to");
  refuseOption("--dims", "3,4", "1 or 3");
  refuseOption("--dims", "2.5", "whole numbers");
  refuseOption("--dims", "9999999", "2097152");
  refuseOption("--dims", "3,,4", "not a list");
  refuseOption("--voxel", "0", "above 0");
  refuseOption("--voxel", "-1", "above 0");
  refuseOption("--voxel", "nan", "above 0");
  refuseOption("--voxel", "inf", "above 0");
  refuseOption("--voxel", "1mm", "not a number");
  refuseOption("--workspace", "0,1,0,1,0", "5 numbers");
  refuseOption("--workspace", "0,1,1,0,0,1", "maximum");
  refuseOption("--workspace", "0,1,0,1,0,nan", "finite");
  refuseOption("--scale", "0", "not zero");
  refuseOption("--scale", "1,0,1", "not zero");
  refuseOption("--rotate", "90,0,0,0", "axis");
  refuseOption("--rotate", "90", "4");
  refuseOption("--translate", "inf,0,0", "finite");
  refuseOption("--matrix", "1,0,0,0,0,1,0,0,0,0,1,0,0,0,1,1", "0,0,0,1");
  refuseOption("--matrix", "1,0,0,0,1,0,0,0,0,0,1,0,0,0,0,1", "singular");
  refuseOption("--unit", "parsec", "mm");
  refuseOption("--threads", "0", "from 1");
}

TEST_F(Usage, OptionsThatContradictEachOtherAreRefused)
{
  this->refuse(
    2, { "resample", "a.ply", "-o", "c.ply", "--dims", "3", "--voxel", "1" }, { "--dims", "--voxel" });
  this->refuse(2,
    { "resample", "a.ply", "-o", "c.ply", "--scale", "3", "--matrix", "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1" },
    { "--scale", "--matrix" });
  this->refuse(2, { "bandwidth", "a.ply", "-o", "c.ply", "--neighbors", "3", "--radius", "1" },
    { "--neighbors", "--radius" });
  this->refuse(
    2, { "bandwidth", "a.ply", "-o", "c.ply", "--r2", "1", "--r1", "2" }, { "--r1", "--r2", "r1 <= r2" });
}

TEST_F(Usage, BadBandwidthNumbersNameTheRange)
{
  const auto refuseOption = [this](const char* option, const char* value, const char* part) {
    this->refuse(2, { "bandwidth", "a.ply", "-o", "c.ply", option, value }, { option, value, part });
  };
  refuseOption("--neighbors", "0", "from 1");
  refuseOption("--radius", "0", "above 0");
  refuseOption("--beta", "-1", "above 0");
  refuseOption("--r1", "nan", "above 0");
  refuseOption("--rule", "best", "normal-reference");
}

TEST_F(Usage, BadFeelNumbersNameTheRange)
{
  const auto refuseOption = [this](const Words& options, const Words& parts)
  {
    Words words = { "feel", "a.ply", "--path", "h.csv", "-o", "c.csv" };
    words.insert(words.end(), options.begin(), options.end());
    this->refuse(2, words, parts);
  };
  refuseOption({ "--stiffness", "-1" }, { "--stiffness -1", "100000" });
  refuseOption({ "--stiffness", "nan" }, { "--stiffness nan" });
  refuseOption({ "--damping", "inf" }, { "--damping inf", "1000" });
  refuseOption({ "--mu-d", "-0.1" }, { "--mu-d -0.1" });
  refuseOption({ "--mu-s", "0.1", "--mu-d", "0.3" }, { "--mu-d 0.3", "--mu-s 0.1", "mu_d <= mu_s" });
  refuseOption({ "--rate", "0" }, { "--rate 0" });
  refuseOption({ "--method", "magic" }, { "--method magic", "surface-fit" });
  refuseOption({ "--preset", "best" }, { "--preset best", "paper" });
}

TEST_F(Usage, BadShapesAndCountsAreRefused)
{
  this->refuse(2, { "generate", "cube", "-n", "5", "-o", "c.ply" }, { "cube", "density-step", "idol" });
  for (const char* count : { "0", "-5", "1e9", "2.5", "nan", "many" })
  {
    this->refuse(2, { "generate", "sphere", "-n", count, "-o", "c.ply" }, { count, "100000000" });
  }
  this->refuse(2, { "generate", "sphere", "-n", "5", "--noise", "-1", "-o", "c.ply" }, { "--noise -1" });
  this->refuse(2, { "generate", "sphere", "-n", "5", "--seed", "-1", "-o", "c.ply" }, { "--seed -1" });
}

TEST_F(Usage, BadInputFilesAreFailuresInOneLine)
{
  this->makeInputs();
  this->write("empty.ply", "");
  this->write("cut.ply", this->read("in.ply").substr(0, 1500));
  this->write("noise.dat", std::string("\x01\x02\x00\xff\xfe garbage", 13));
  for (const char* file : { "none.ply", ".", "empty.ply", "cut.ply", "noise.dat" })
  {
    this->refuse(1, { "resample", file, "-o", "out.ply" }, { "pointhaptics resample: ", file });
    this->refuse(1, { "bandwidth", file, "-o", "out.ply" }, { "pointhaptics bandwidth: ", file });
    this->refuse(1, { "feel", file, "--path", "hip.csv", "-o", "out.csv" }, { "pointhaptics feel: ", file });
    this->refuse(1, { "info", file }, { "pointhaptics info: ", file });
  }
}

TEST_F(Usage, BadPathsAreFailuresInOneLine)
{
  this->makeInputs();
  this->write("empty.csv", "");
  this->write("header.csv", "t,x,y,z\n");
  this->write("wrong.csv", "a,b\n1,2\n");
  this->write("back.csv", "t,x,y,z\n0,0,0,0\n1,0,0,0\n0.5,0,0,0\n");
  this->write("nan.csv", "t,x,y,z\n0,0,0,nan\n");
  this->write("years.csv", "t,x,y,z\n0,0,0,0\n1e9,0,0,0\n");
  for (const char* path :
    { "none.csv", ".", "empty.csv", "header.csv", "wrong.csv", "back.csv", "nan.csv", "years.csv" })
  {
    this->refuse(1, { "feel", "in.ply", "--path", path, "-o", "out.csv" }, { "pointhaptics feel: ", path });
  }
}

TEST_F(Usage, BadOutputsAreFailuresThatLeaveNothingBehind)
{
  this->makeInputs();
  for (const std::string output : { "out.xls", "out", "none/out.ply" })
  {
    const int code = output == "none/out.ply" ? 1 : 2;
    this->refuse(code, { "resample", "in.ply", "-o", output }, { "pointhaptics resample: ", output });
    this->refuse(code, { "bandwidth", "in.ply", "-o", output }, { "pointhaptics bandwidth: ", output });
    this->refuse(
      code, { "generate", "sphere", "-n", "9", "-o", output }, { "pointhaptics generate: ", output });
  }
  this->refuse(1, { "feel", "in.ply", "--path", "hip.csv", "-o", "none/out.csv" }, { "none/out.csv" });
  this->refuse(1, { "feel", "in.ply", "--path", "hip.csv", "-o", "." }, { "folder" });
}

TEST_F(Usage, AWorkspaceWithoutPointsIsAFailure)
{
  this->makeInputs();
  const std::string away = "1,2,1,2,1,2";
  this->refuse(1, { "resample", "in.ply", "-o", "out.ply", "--workspace", away }, { "200 clipped" });
  this->refuse(
    1, { "feel", "in.ply", "--path", "hip.csv", "-o", "out.csv", "--workspace", away }, { "--workspace" });
  this->refuse(1, { "feel", "in.ply", "--path", "hip.csv", "-o", "out.csv", "--raw", "--workspace", away },
    { "--workspace" });
  this->refuse(1, { "resample", "in.ply", "-o", "out.ply", "--voxel", "1e-12" }, { "larger voxel" });
}

TEST_F(Usage, DevicesSaysWhatItFoundAndWhatNotWithTheCure)
{
  const nlohmann::json result = nlohmann::json::parse(this->succeed({ "devices", "--json" }));
  std::string notes;
  for (const auto& note : result["notes"])
  {
    notes += note.get<std::string>() + "\n";
  }
  const auto isListed = [&](const std::string& kind)
  {
    return std::any_of(result["devices"].begin(), result["devices"].end(),
      [&](const nlohmann::json& device) { return device["kind"] == kind; });
  };
  EXPECT_TRUE(isListed("simulated"));
  // Found, or said not to be, or to be out of this build's reach.
  for (const auto& [kind, name] :
    { std::pair{ "falcon", "Falcon" }, std::pair{ "spacemouse", "SpaceMouse" } })
  {
    EXPECT_NE(isListed(kind), notes.find(std::string("no ") + name) != std::string::npos) << kind << notes;
  }
  for (const char* cure : { "no Falcon was found: plug in", "no SpaceMouse was found: plug in" })
  {
    const std::string finding = std::string(cure).substr(0, std::string(cure).find(':'));
    EXPECT_EQ(notes.find(finding) == std::string::npos, notes.find(cure) == std::string::npos) << notes;
  }
  const std::string text = this->succeed({ "devices" });
  EXPECT_NE(text.find(notes), std::string::npos) << text;
}

TEST_F(Usage, NegativeNumbersAreNumbersNotOptions)
{
  this->makeInputs();
  this->succeed({ "resample", "in.ply", "-o", "a.csv", "--translate", "-.01,-1e-3,-2" });
  this->succeed({ "resample", "in.ply", "-o", "b.csv", "--translate=-.01,-1e-3,-2" });
  EXPECT_EQ(this->read("a.csv"), this->read("b.csv"));
}

TEST_F(Usage, AMisspeltOptionIsToldBeforeWhatIsMissing)
{
  this->makeInputs();
  this->refuse(2, { "resample", "in.ply", "--outptu", "out.ply" },
    { "unexpected argument --outptu; did you mean --output?" });
  this->refuse(2, { "generate", "sphere", "--piont=3", "-o", "out.ply" },
    { "unexpected argument --piont=3; did you mean --points?" });
}

TEST_F(Usage, TheBeginningOfALongWordFindsIt)
{
  this->makeInputs();
  this->refuse(2, { "resample", "in.ply", "-o", "out.ply", "--representative", "nearst" },
    { "no such choice; did you mean nearest-to-mean?" });
}

TEST_F(Usage, TheProgramStartsWithoutTheLibrariesOfPictures)
{
  setenv("LD_DEBUG", "files", 1); // the loader lists on stderr what it loads
  const Outcome listed = this->run({ "--version" });
  unsetenv("LD_DEBUG");
  if (listed.errors.find("libpointhaptics_program") == std::string::npos)
  {
    GTEST_SKIP() << "the libraries are part of the program";
  }
  EXPECT_EQ(listed.errors.find("libvtkRendering"), std::string::npos) << listed.errors;
  EXPECT_EQ(listed.errors.find("libPointHapticsViewer"), std::string::npos) << listed.errors;
}

TEST_F(Usage, AStandardOutputThatIsFullIsSaidOnce)
{
  const int full = ::open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  this->makeInputs();
  for (const Words& words :
    { Words{ "manual", "man" }, { "info", "in.ply" }, { "info", "in.ply", "--json" }, { "--version" } })
  {
    const Outcome outcome = this->finish(this->start(words, full));
    EXPECT_EQ(outcome.exitCode, 1) << words.front();
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find("the standard output cannot be written"), std::string::npos)
      << outcome.errors;
  }
  ::close(full);
}

TEST_F(Usage, ACommandThatLosesItsOnlyKeyIsSaid)
{
  this->makeInputs();
  const auto errorsOf = [this](const std::string& bindings) {
    return this->run({ "view", "in.ply", "--bind", bindings, "--write-config", "c.json", "--force" }).errors;
  };
  EXPECT_NE(errorsOf("help=q").find("--bind takes q, all the keys it has, from quit"), std::string::npos)
    << errorsOf("help=q");
  EXPECT_EQ(errorsOf("help=q,quit=Ctrl+q"), "");
  EXPECT_EQ(errorsOf("help=q,quit="), "");
}

TEST_F(Usage, NamesThatAreNoUtf8AreKeptAsFarAsTheyCanBe)
{
  this->makeInputs();
  const std::string cloud = "f\xfcr.ply";
  const std::string path = "h\xe4nd.csv";
  std::filesystem::rename(this->path("in.ply"), this->path(cloud));
  std::filesystem::rename(this->path("hip.csv"), this->path(path));
  const auto said = [this](const Words& words)
  {
    const Outcome outcome = this->run(words);
    EXPECT_EQ(outcome.exitCode, 0) << words.front() << ": " << outcome.errors;
    return nlohmann::json::parse(outcome.output, nullptr, false);
  };
  EXPECT_FALSE(said({ "info", cloud, "--json" }).is_discarded());
  EXPECT_FALSE(said({ "convert", cloud, "-o", "{stem}.csv", "--json" }).is_discarded());
  const Words feel = { "feel", cloud, "--path", path, "--record", "r\xe9.csv", "-o", "o\xf6.csv", "--json" };
  EXPECT_FALSE(said(feel).is_discarded());
  EXPECT_FALSE(said({ "feel", "--replay", "r\xe9.csv", "-o", "again.csv", "--json" }).is_discarded());
  this->refuse(1, { "view", cloud, "--path", path, "--write-config", "c.json" }, { "--path: ", "no UTF-8" });
  EXPECT_EQ(this->run({ "view", cloud, "--path", path, "--trace", "t\xe4.csv" }).exitCode, 0);
}

} // namespace
