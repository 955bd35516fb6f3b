// No command eats an input, whatever the input is called and whichever option names the output.
#include "RunProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include <sys/resource.h>
#include <sys/stat.h>

namespace
{

namespace fs = std::filesystem;
using nlohmann::json;
using pointhaptics::apptest::InputFrom;
using pointhaptics::apptest::Outcome;
using Words = std::vector<std::string>;

/// A line of `manual files`.
struct FileOption
{
  std::string command;
  std::string name;
  bool isRequired = false;
  bool isRead = false;
  std::vector<std::string> extensions; ///< of an output

  bool isPositional() const { return name.front() != '-'; }
};

class Outputs : public pointhaptics::apptest::CommandLine
{
protected:
  std::vector<FileOption> options() const
  {
    std::vector<FileOption> all;
    std::istringstream lines(this->succeed({ "manual", "files" }));
    for (std::string line; std::getline(lines, line);)
    {
      std::istringstream words(line);
      FileOption option;
      words >> option.command >> option.name;
      for (std::string word; words >> word;)
      {
        option.isRequired = option.isRequired || word == "required";
        option.isRead = option.isRead || word == "reads";
        if (word != "required" && word != "reads" && word != "writes" && word != "and")
        {
          option.extensions.push_back(word);
        }
      }
      all.push_back(option);
    }
    return all;
  }
  /// The words that give @p values to options, and something to each required one without.
  static Words commandLine(const std::vector<FileOption>& all, const std::string& command,
    const std::vector<std::pair<std::string, std::string>>& values)
  {
    Words words = { command };
    Words places;
    const auto add = [&](const FileOption& option, const std::string& value)
    {
      if (option.isPositional())
      {
        places.push_back(value);
        return;
      }
      words.insert(words.end(), { option.name, value });
    };
    for (const FileOption& option : all)
    {
      const auto value = std::find_if(
        values.begin(), values.end(), [&](const auto& each) { return each.first == option.name; });
      if (option.command == command && value != values.end())
      {
        add(option, value->second);
      }
      else if (option.command == command && option.isRequired)
      {
        add(option, option.isRead ? "other.any" : "other." + option.extensions.front());
      }
    }
    if (command == "generate")
    {
      words.insert(words.end(), { "sphere", "-n", "5" });
    }
    words.insert(words.end(), places.begin(), places.end());
    return words;
  }
  static std::string extensionOf(const FileOption& option)
  {
    return option.extensions.empty() ? "txt" : option.extensions.front();
  }
};

TEST_F(Outputs, AreNeverAnInput)
{
  const std::vector<FileOption> all = this->options();
  int pairs = 0;
  for (const FileOption& output : all)
  {
    for (const FileOption& input : all)
    {
      if (output.command != input.command || !input.isRead || output.extensions.empty() ||
        output.name == input.name)
      {
        continue;
      }
      ++pairs;
      const std::string name = "keep." + extensionOf(output);
      this->write(name, "precious");
      fs::create_hard_link(this->path(name), this->path("hard." + extensionOf(output)));
      fs::create_symlink(name, this->path("soft." + extensionOf(output)));
      fs::create_symlink(".", this->path("folder"));
      const Words aliases = { name, "./" + name, "folder/" + name, this->path(name),
        "hard." + extensionOf(output), "soft." + extensionOf(output) };
      // One rule knows all of them: two for each pair, in turn.
      for (const std::string& alias :
        { aliases[std::size_t(pairs) % 6], aliases[std::size_t(pairs + 3) % 6] })
      {
        const Words words =
          commandLine(all, output.command, { { input.name, name }, { output.name, alias } });
        this->refuse(2, words, { "this is the input", "keep." });
        EXPECT_EQ(this->read(name), "precious") << output.command << " " << output.name << " " << alias;
      }
      for (const std::string& file : this->files())
      {
        fs::remove(this->path(file));
      }
    }
  }
  EXPECT_GE(pairs, 25);
}

TEST_F(Outputs, DoNotReplaceARecording)
{
  const std::vector<FileOption> all = this->options();
  const std::string touch = "t,hip_x\n# pointhaptics recording: 2\n0,1\n";
  int tried = 0;
  for (const FileOption& output : all)
  {
    const auto csv = std::find(output.extensions.begin(), output.extensions.end(), "csv");
    if (csv == output.extensions.end() || output.isPositional())
    {
      continue;
    }
    ++tried;
    this->write("touch.csv", touch);
    this->refuse(
      2, commandLine(all, output.command, { { output.name, "touch.csv" } }), { "recording", "--force" });
    EXPECT_EQ(this->read("touch.csv"), touch) << output.command << " " << output.name;
  }
  EXPECT_GE(tried, 3);
}

TEST_F(Outputs, AreNeverEachOther)
{
  const std::vector<FileOption> all = this->options();
  int pairs = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    for (std::size_t j = i + 1; j < all.size(); ++j)
    {
      const FileOption& a = all[i];
      const FileOption& b = all[j];
      const bool areOfOne = a.command == b.command && !a.isRead && !b.isRead;
      const auto shared = std::find_first_of(
        a.extensions.begin(), a.extensions.end(), b.extensions.begin(), b.extensions.end());
      if (!areOfOne || shared == a.extensions.end())
      {
        continue;
      }
      ++pairs;
      const std::string name = "out." + *shared;
      this->refuse(2, commandLine(all, a.command, { { a.name, name }, { b.name, "./" + name } }),
        { "this is the same file as" });
      this->refuse(2, commandLine(all, a.command, { { a.name, "-" }, { b.name, "-" } }), { "-" });
    }
  }
  EXPECT_GE(pairs, 4);
}

TEST_F(Outputs, AreNeverEachOtherThroughLinksToNothing)
{
  this->write("in.csv", "x,y,z\n0,0,0\n1,1,1\n");
  fs::create_symlink("new.csv", this->path("first.csv"));
  fs::create_symlink("first.csv", this->path("second.csv"));
  for (const char* link : { "first.csv", "second.csv" })
  {
    const Outcome outcome =
      this->run({ "resample", "in.csv", "--unit", "m", "-o", "new.csv", "--voxel-index", link });
    EXPECT_EQ(outcome.exitCode, 2) << link << outcome.errors;
    EXPECT_FALSE(this->exists("new.csv")) << link;
  }
}

TEST_F(Outputs, AreRefusedWhereTheyMayNotBeReplaced)
{
  const std::vector<FileOption> all = this->options();
  for (const FileOption& output : all)
  {
    if (output.extensions.empty() || output.isPositional())
    {
      continue;
    }
    const std::string name = "kept." + extensionOf(output);
    this->write(name, "old");
    Words words = commandLine(all, output.command, { { output.name, name } });
    ASSERT_EQ(chmod(this->path(name).c_str(), 0444), 0);
    this->refuse(1, words, { name, "write-protected", "chmod u+w" });
    ASSERT_EQ(chmod(this->path(name).c_str(), 0644), 0);
    words.emplace_back("--no-clobber");
    this->refuse(2, words, { name, "--no-clobber" });
    EXPECT_EQ(this->read(name), "old") << output.command;
    fs::remove(this->path(name));
  }
}

TEST_F(Outputs, NameOnlyExtensionsThatThereAre)
{
  const std::vector<FileOption> all = this->options();
  for (const FileOption& output : all)
  {
    if (!output.extensions.empty() && !output.isPositional())
    {
      this->refuse(2, commandLine(all, output.command, { { output.name, "out.doc" } }),
        { "out.doc", "unknown extension \".doc\"", output.extensions.front() });
    }
  }
  this->refuse(2, { "convert", "a.csv", "b.lsa" }, { "b.lsa: unknown extension", "did you mean las?" });
}

TEST_F(Outputs, OfConvertThatExistAreNamedByAWordToBeReplaced)
{
  this->write("a.xyz", "1 2 3\n");
  this->write("b.xyz", "4 5 6\n");
  this->refuse(2, { "convert", "a.xyz", "b.xyz" }, { "b.xyz", "is there already", "-o", "--force" });
  this->refuse(2, { "convert", "a.xyz", "b.xyz", "--force", "--no-clobber" }, { "--force", "--no-clobber" });
  this->succeed({ "convert", "a.xyz", "b.xyz", "--force" });
  EXPECT_NE(this->read("b.xyz").find("1 2 3"), std::string::npos);
}

TEST_F(Outputs, AppearTogetherOrNotAtAll)
{
  std::string cloud;
  for (int i = 0; i < 4000; ++i)
  {
    cloud += std::to_string(i) + " " + std::to_string(i % 7) + " 0\n";
  }
  this->write("in.xyz", cloud);
  this->write("out.ply", "old");
  // Room for the cloud of few voxels, not for the row of each point.
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 6000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Outcome outcome =
    this->run({ "resample", "in.xyz", "--voxel", "1000", "-o", "out.ply", "--voxel-index", "index.csv" });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(
    outcome.errors.find("index.csv: cannot be written: File too large; raise the limit"), std::string::npos)
    << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1);
  EXPECT_EQ(this->files(), (Words{ "in.xyz", "out.ply" }));
  EXPECT_EQ(this->read("out.ply"), "old");
}

TEST_F(Outputs, OfSeveralInputsFollowAPattern)
{
  fs::create_directory(this->path("scans"));
  this->write("scans/a.xyz", "1 2 3\n");
  this->write("b.v2.xyz", "4 5 6\n");
  for (const std::string command : { "resample", "bandwidth", "convert" })
  {
    const Outcome outcome = this->run(
      { command, "scans/a.xyz", "b.v2.xyz", "-o", "{folder}/{stem}-" + command + ".csv", "--json" });
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_EQ(json::parse(outcome.output)["files"].size(), 2u);
    EXPECT_TRUE(this->exists("scans/a-" + command + ".csv"));
    EXPECT_TRUE(this->exists("b.v2-" + command + ".csv"));
    this->refuse(2, { command, "scans/a.xyz", "b.v2.xyz", "-o", "{stem}.csv", "--merge" }, { "--merge" });
    this->refuse(1, { command, "scans/a.xyz", "gone.xyz", "-o", "{stem}-x.csv" }, { "gone.xyz" });
    this->refuse(
      2, { command, "scans/a.xyz", "./scans/a.xyz", "-o", "{stem}.csv" }, { "this is the same file as" });
  }
  EXPECT_EQ(this->run({ "resample", "scans/a.xyz", "b.v2.xyz", "-o", "all.csv", "--merge" }).exitCode, 0);
  EXPECT_NE(this->read("all.csv").find("4,5,6"), std::string::npos);
}

TEST_F(Outputs, AreToldBeforeTheyAreWritten)
{
  this->write("in.xyz", "1 2 3\n");
  this->write("out.ply", "old");
  EXPECT_EQ(this->succeed({ "resample", "in.xyz", "-o", "out.ply", "--voxel-index", "i.csv", "--dry-run" }),
    "would read in.xyz\nwould replace out.ply\nwould write i.csv\n");
  const json plan =
    json::parse(this->succeed({ "convert", "in.xyz", "-o", "out.ply", "--dry-run", "--json" }));
  EXPECT_EQ(plan["reads"], json::array({ "in.xyz" }));
  EXPECT_EQ(plan["writes"][0]["replaces"], true);
  EXPECT_EQ(this->read("out.ply"), "old");
  this->refuse(1, { "convert", "gone.xyz", "-o", "x.ply", "--dry-run" }, { "gone.xyz" });
}

TEST_F(Outputs, GoToStandardOutput)
{
  this->write("in.xyz", "0 0 0\n0 0 0.01\n0 0.01 0\n0.01 0 0\n");
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.03\n0.01,0,0,0.029\n");
  EXPECT_EQ(this->succeed({ "feel", "in.xyz", "--path", "hip.csv", "-o", "-" }).rfind("t,hip_x,", 0), 0u);
  EXPECT_EQ(
    this->succeed({ "resample", "in.xyz", "-o", "o.ply", "--voxel-index", "-" }), "voxel\n0\n3\n2\n1\n");
  EXPECT_EQ(
    this->succeed({ "resample", "in.xyz", "-o", "-", "--output-format", "csv" }).rfind("x,y,z,", 0), 0u);
  EXPECT_EQ(
    this->succeed({ "generate", "sphere", "-n", "3", "-o", "-", "--output-format", "ply" }).rfind("ply\n", 0),
    0u);
  EXPECT_EQ(this->succeed({ "view", "in.xyz", "--axes", "--write-config", "-" }), "{\n  \"axes\": true\n}\n");
  EXPECT_FALSE(this->exists("-"));
}

TEST_F(Outputs, AreNotTheFileThatComesByStandardInput)
{
  this->write("in.xyz", "1 2 3\n");
  const InputFrom input(this->path("in.xyz"));
  this->refuse(2, { "convert", "-", "-o", "in.xyz" }, { "this is the input" });
  EXPECT_EQ(this->succeed({ "convert", "-", "out.csv" }), "1 point: out.csv\n");
}

TEST_F(Outputs, ComeFromPipesAsFromFiles)
{
  this->write("in.xyz", "1 2 3\n4 5 6\n");
  this->succeed({ "convert", "in.xyz", "in.laz" });
  this->succeed({ "convert", "in.xyz", "in.vtp" });
  for (const char* file : { "in.xyz", "in.laz", "in.vtp" })
  {
    SCOPED_TRACE(file);
    ASSERT_EQ(mkfifo(this->path("pipe").c_str(), 0600), 0);
    const std::string feed = "cat '" + this->path(file) + "' > '" + this->path("pipe") + "' &";
    ASSERT_EQ(std::system(feed.c_str()), 0);
    EXPECT_EQ(this->succeed({ "convert", "pipe", "-o", "out.csv" }), "2 points: out.csv\n") << file;
    fs::remove(this->path("pipe"));
  }
}

TEST_F(Outputs, AreTheOnlyThingAQuietRunMakes)
{
  this->write("in.csv", "x,y,z,Name\n1,2,3,a\n4,5,6,b\n");
  EXPECT_NE(this->run({ "convert", "in.csv", "loud.ply" }).errors, "");
  EXPECT_EQ(this->succeed({ "convert", "in.csv", "quiet.ply", "--quiet" }), "");
  const Outcome verbose = this->run({ "convert", "in.csv", "verbose.ply", "-v" });
  EXPECT_NE(verbose.errors.find("read: in.csv: "), std::string::npos) << verbose.errors;
  EXPECT_NE(verbose.errors.find("convert: verbose.ply: 2 points written in"), std::string::npos)
    << verbose.errors;
}

TEST_F(Outputs, AreWarnedOfOnceWithTheCount)
{
  Words words = { "convert" };
  for (int i = 0; i < 5; ++i)
  {
    words.push_back("in" + std::to_string(i) + ".csv");
    this->write(words.back(), "x,y,z,Name\n1,2,3,a\n4,5,6,b\n");
  }
  words.insert(words.end(), { "-o", "{stem}.ply" });
  const Outcome outcome = this->run(words);
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  EXPECT_NE(outcome.errors.find("in0.csv: "), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("(5 times)"), std::string::npos) << outcome.errors;
}

TEST_F(Outputs, OfEachInputAreAllPatterns)
{
  this->write("a.xyz", "1 2 3\n");
  this->write("b.xyz", "4 5 6\n");
  this->refuse(2, { "resample", "a.xyz", "b.xyz", "-o", "{stem}.csv", "--voxel-index", "v.csv" },
    { "--voxel-index v.csv", "{stem}", "--merge" });
  this->run({ "resample", "a.xyz", "b.xyz", "-o", "{stem}.csv", "--voxel-index", "{stem}-v.csv" });
  EXPECT_TRUE(this->exists("a-v.csv") && this->exists("b-v.csv"));
  this->refuse(2, { "resample", "a.xyz", "-o", "{stam}.csv" }, { "{stam} stands for nothing", "{stem}" });
}

TEST_F(Outputs, GoToStandardOutputByAnyOfItsNames)
{
  this->write("in.xyz", "0 0 0\n0 0 0.01\n0 0.01 0\n0.01 0 0\n");
  const std::string expected = this->succeed({ "resample", "in.xyz", "-o", "-", "--output-format", "csv" });
  fs::create_symlink("/dev/stdout", this->path("link"));
  for (const char* name : { "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "link" })
  {
    EXPECT_EQ(this->succeed({ "resample", "in.xyz", "-o", name, "--output-format", "csv" }), expected)
      << name;
  }
}

TEST_F(Outputs, OfAFormatThatTheNameDoesNotTellAreWarnedOf)
{
  this->write("in.csv", "x,y,z,ScanAngle\n1,2,3,4\n");
  const Outcome outcome = this->run({ "convert", "in.csv", "-o", "a.ply", "--output-format", "csv" });
  EXPECT_NE(outcome.errors.find("a.ply: holds .csv"), std::string::npos) << outcome.errors;
  EXPECT_EQ(this->succeed({ "convert", "in.csv", "-o", "a.las", "--las-scale", "0.1" }), "1 point: a.las\n");
  EXPECT_NE(this->run({ "convert", "in.csv", "-o", "b.ply", "--las-scale", "0.1" }).errors.find("no effect"),
    std::string::npos);
}

TEST_F(Outputs, OfATurntableAreAllInThePlan)
{
  this->write("in.xyz", "1 2 3\n");
  EXPECT_EQ(this->succeed({ "view", "in.xyz", "--screenshot", "s.png", "--turntable", "2", "--dry-run" }),
    "would read in.xyz\nwould write s-001.png\nwould write s-002.png\n");
  fs::create_symlink("nothing.csv", this->path("link.csv"));
  this->succeed({ "convert", "in.xyz", "-o", "link.csv", "--no-clobber" });
  EXPECT_TRUE(this->exists("nothing.csv"));
}

TEST_F(Outputs, MayBeNamedByAConfiguration)
{
  this->write("in.xyz", "0 0 0\n0 0 0.01\n0 0.01 0\n0.01 0 0\n");
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.03\n0.01,0,0,0.029\n");
  this->write("good.json", "{\"output\": \"out.csv\"}");
  this->write("bad.json", "{broken");
  this->succeed({ "feel", "in.xyz", "--path", "hip.csv", "--config", "good.json" });
  EXPECT_TRUE(this->exists("out.csv"));
  this->refuse(2, { "feel", "in.xyz", "--path", "hip.csv", "--config", "bad.json" }, { "bad.json" });
  this->refuse(2, { "feel", "in.xyz", "--path", "hip.csv" }, { "--output" });
}

TEST_F(Outputs, OfJsonSayErrors)
{
  for (const Words& words :
    { Words{ "convert", "gone.ply", "x.ply" }, { "resample", "gone.ply", "-o", "x.ply" },
      { "feel", "gone.ply", "--path", "gone.csv", "-o", "x.csv" }, { "compare", "gone.csv" } })
  {
    Words all = words;
    all.emplace_back("--json");
    const Outcome outcome = this->run(all);
    const json said = json::parse(outcome.output);
    EXPECT_NE(said["error"].get<std::string>().find("gone."), std::string::npos) << outcome.output;
    EXPECT_EQ(said["exit_code"], 1);
  }
  EXPECT_EQ(json::parse(this->run({ "resample", "a.ply", "-o", "x.doc", "--json" }).output)["exit_code"], 2);
}

TEST_F(Outputs, OfEndedRunsAreNamedWhereTheyAreMissed)
{
  this->write("kill.csv.part", "t,hip_x\n");
  for (const Words& words :
    { Words{ "feel", "--replay", "kill.csv", "-o", "o.csv" }, { "compare", "kill.csv" },
      { "info", "kill.csv" }, { "view", "--replay", "kill.csv", "--trace", "t.csv" } })
  {
    this->refuse(
      1, words, { "kill.csv: there is no such file, but what an ended run kept of it: give kill.csv.part" });
  }
}

TEST_F(Outputs, OfAllCloudCommandsNameTheirInputs)
{
  this->write("a.xyz", "0 0 0\n0 0 1\n0 1 0\n");
  this->write("b.xyz", "1 0 0\n1 0 1\n1 1 0\n");
  for (const std::string command : { "resample", "bandwidth", "convert" })
  {
    const json one = json::parse(this->succeed({ command, "a.xyz", "-o", "o.ply", "--json" }));
    EXPECT_EQ(one["input"], "a.xyz");
    EXPECT_EQ(one["inputs"], json::array({ "a.xyz" }));
    const json both =
      json::parse(this->succeed({ command, "a.xyz", "b.xyz", "--merge", "-o", "o.ply", "--json" }));
    EXPECT_EQ(both["inputs"], json::array({ "a.xyz", "b.xyz" })) << command;
    EXPECT_EQ(both["output"], "o.ply");
  }
}

TEST_F(Outputs, OfEndedRunsThatAreMissedLeaveTheOthersAlone)
{
  this->write("a.xyz", "0 0 0\n0 0 1\n");
  this->write("kill.csv.part", "t,hip_x\n");
  const Outcome outcome = this->run({ "info", "kill.csv", "a.xyz", "--json" });
  EXPECT_EQ(outcome.exitCode, 1);
  const json files = json::parse(outcome.output)["files"];
  ASSERT_EQ(files.size(), 2u);
  EXPECT_NE(files[0]["error"].get<std::string>().find("give kill.csv.part"), std::string::npos) << files[0];
  EXPECT_EQ(files[1]["points"], 2);
  this->refuse(1, { "feel", "a.xyz", "--path", "kill.csv", "-o", "o.csv" }, { "give kill.csv.part" });
}

TEST_F(Outputs, OfAFileAndStandardInputFromItAreMerged)
{
  this->write("keep.xyz", "0 0 0\n0 0 1\n0 1 0\n");
  const apptest::InputFrom input(this->path("keep.xyz"));
  const Outcome outcome =
    this->run({ "convert", "-", "keep.xyz", "-o", "x.ply", "--merge", "--input-format", "xyz", "--force" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("is the same file as -"), std::string::npos) << outcome.errors;
  this->refuse(2, { "convert", "-", "/dev/stdin", "-o", "y.ply", "--merge" }, { "can be read once" });
}

} // namespace
