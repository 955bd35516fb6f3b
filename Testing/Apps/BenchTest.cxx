#include "RunProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <thread>

namespace
{

using nlohmann::json;

class Bench : public pointhaptics::apptest::CommandLine
{
protected:
  json quick(const std::string& task, const std::vector<std::string>& options = {}) const
  {
    std::vector<std::string> words{ "bench", task, "--quick", "--json" };
    words.insert(words.end(), options.begin(), options.end());
    json result = json::parse(this->succeed(words));
    EXPECT_EQ(result["task"], task);
    return result;
  }
  void writeTetrahedron() const
  {
    this->write("tetra.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
      "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  }
};

TEST_F(Bench, ResamplingIsRightAndTimedInEveryMode)
{
  const json result = this->quick("resample", { "--repetitions", "2" });
  EXPECT_FALSE(result["machine"]["processor"].get<std::string>().empty());
  for (const char* study : { "points", "modes" })
  {
    ASSERT_FALSE(result[study]["rows"].empty()) << study;
    for (const json& row : result[study]["rows"])
    {
      EXPECT_GT(row["median_seconds"], 0.0) << row;
      EXPECT_LE(row["lower_quartile_seconds"], row["upper_quartile_seconds"]) << row;
      EXPECT_GT(row["first_seconds"], 0.0) << row;
      EXPECT_GT(row["times_ours"], 0.0) << row;
      EXPECT_EQ(row["repetitions"], 2) << row;
      EXPECT_EQ(row["right"], true) << row;
    }
  }
  EXPECT_EQ(result["modes"]["rows"].size(), 13u);
  EXPECT_EQ(result["modes"]["rows"][0]["contestant"], "points alone");
}

TEST_F(Bench, TheChosenContestantsRunAndNoOthers)
{
  const json result = this->quick("resample",
    { "--studies", "points", "--rivals", "none", "--points", "500,300", "--dims", "10,20", "--threads",
      "1" });
  ASSERT_EQ(result["points"]["rows"].size(), 4u);
  EXPECT_EQ(result["points"]["rows"][0]["points"], 300);
  EXPECT_EQ(result["points"]["rows"][1]["dimension"], 20);
  EXPECT_FALSE(result.contains("modes"));
  const json held = this->quick("resample",
    { "--studies", "points", "--rivals", "none", "--points", "500", "--instructions", "baseline" });
  EXPECT_EQ(held["points"]["rows"][0]["right"], true);
}

TEST_F(Bench, RowsComeOneALineAfterTheMachine)
{
  std::istringstream lines(this->succeed({ "bench", "friction", "--quick" }));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  const json head = json::parse(line);
  EXPECT_EQ(head["task"], "friction");
  EXPECT_EQ(head["command"], "pointhaptics bench friction --quick");
  int rows = 0;
  for (; std::getline(lines, line); ++rows)
  {
    EXPECT_EQ(json::parse(line)["study"], "ratio") << line;
  }
  EXPECT_EQ(rows, 2 * 2);
}

TEST_F(Bench, BandwidthsAreRightBesideOtherSearches)
{
  this->succeed({ "generate", "torus", "-n", "2000", "-o", "ring.ply" });
  const json result = this->quick("bandwidth", { "--repetitions", "1", "--file", this->path("ring.ply") });
  EXPECT_NE(result["command"].get<std::string>().find("--file ring.ply"), std::string::npos);
  for (const json& row : result["search"]["rows"])
  {
    EXPECT_EQ(row["right"], true) << row;
    EXPECT_GT(row["times_ours"], 0.0) << row;
    EXPECT_LE(row["worst_relative_error"], row["contestant"] == "ours" ? 1e-14 : 1e-6) << row;
  }
  EXPECT_EQ(result["search"]["rows"].back()["cloud"], "ring.ply");
  this->refuse(1, { "bench", "bandwidth", "--quick", "--file", "none.ply" }, { "bench", "none.ply" });
}

TEST_F(Bench, TheProxyIsJudgedWithEveryMethod)
{
  const json result = this->quick("proxy");
  double ours = 0.0;
  double papers = 0.0;
  for (const json& row : result["methods"]["rows"])
  {
    const bool isDefault = row["method"] == "surface-fit (default)";
    EXPECT_GE(row["max_percent"], row["rms_percent"]) << row;
    EXPECT_GT(row["p50_us"], 0.0) << row;
    EXPECT_LE(row["p50_us"], row["p99_us"]) << row;
    EXPECT_LE(row["p99_us"], row["max_us"]) << row;
    EXPECT_TRUE(!isDefault || row["pop_throughs"] == 0) << row;
    EXPECT_TRUE(!isDefault || row["rms_percent"] < 0.5) << row;
    if (row["shape"] == "torus" && row["noise_metres"] == 0.0)
    {
      (isDefault ? ours : papers) = row["rms_percent"];
    }
  }
  EXPECT_EQ(result["methods"]["rows"].size(), 2u + 2u * 7u) << "all methods on the torus only";
  EXPECT_GT(ours, 0.0);
  EXPECT_LT(ours, 0.2);
  EXPECT_GT(papers, 100.0) << "the printed gains do not follow a hand";
}

TEST_F(Bench, TouchIsJudgedOnScans)
{
  this->writeTetrahedron();
  const json result = this->quick("touch", { "--scans", "tetra.ply", "--methods", "surface-fit,sphere" });
  EXPECT_EQ(result["scans"]["rows"].size(), 3u * 2u)
    << "samples and vertices of the scan, samples of the box";
  for (const json& row : result["scans"]["rows"])
  {
    EXPECT_GT(row["judged_percent"], 50.0) << row;
    EXPECT_LE(row["median_percent"], row["p95_percent"]) << row;
    EXPECT_LE(row["p50_us"], row["p99_us"]) << row;
    EXPECT_LE(row["p99_us"], row["max_us"]) << row;
    EXPECT_TRUE(row["status_percent"].is_object()) << row;
  }
  EXPECT_EQ(result["scans"]["rows"].back()["mesh"], "box");
  this->refuse(1, { "bench", "touch", "--quick", "--scans", "none.ply" }, { "none.ply" });
  this->refuse(2, { "bench", "touch", "--methods", "ball" }, { "bench touch", "--methods", "surface-fit" });
  this->refuse(2, { "bench", "touch", "--late", "-1" }, { "bench touch", "--late" });
}

TEST_F(Bench, TouchIsTheSameWithEveryInstructionSet)
{
  const std::vector<std::string> options{ "--studies", "scans", "--methods", "surface-fit", "--stroke-set",
    "b", "--points", "5000", "--meshes", "stairs,gear", "--raw" };
  std::vector<std::string> withBaseline = options;
  withBaseline.insert(withBaseline.end(), { "--instructions", "baseline" });
  const json best = this->quick("touch", options);
  const json baseline = this->quick("touch", withBaseline);
  ASSERT_EQ(best["scans"]["rows"].size(), 2u);
  EXPECT_EQ(best["scans"]["rows"][0]["mesh"], "stairs");
  EXPECT_EQ(best["scans"]["rows"][0]["points"], 5000);
  EXPECT_FALSE(best.contains("hard"));
  EXPECT_EQ(baseline["scans"]["rows"][0]["instructions"], "baseline");
  for (const std::size_t row : { 0, 1 })
  {
    for (const char* figure : { "rms_percent", "energy_joule" })
    {
      EXPECT_EQ(baseline["scans"]["rows"][row][figure], best["scans"]["rows"][row][figure]) << figure;
    }
  }
  this->refuse(
    2, { "bench", "touch", "--instructions", "mmx" }, { "bench touch", "--instructions", "baseline" });
}

TEST_F(Bench, TouchIsTimedOnSmoothShapesOfEverySize)
{
  const json result = this->quick("touch",
    { "--studies", "scans", "--methods", "surface-fit", "--meshes", "sphere,ellipsoid", "--points",
      "5000,3e4" });
  const json& rows = result["scans"]["rows"];
  ASSERT_EQ(rows.size(), 2u * 2u);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const json& row = rows[i];
    EXPECT_EQ(row["mesh"], i < 2 ? "sphere" : "ellipsoid") << row;
    EXPECT_EQ(row["points"], i % 2 == 0 ? 5000 : 30000) << row;
    EXPECT_GT(row["built_seconds"], 0.0) << row;
    EXPECT_LE(row["first_contact_us"], row["max_us"]) << row;
    EXPECT_EQ(row["lost_percent"], 0.0) << row;
    EXPECT_LE(row["median_percent"], 1.0) << row << ": other points than the mesh's";
    EXPECT_TRUE(row["status_percent"].contains("around")) << row;
    EXPECT_GE(row["releases"], 1) << row;
  }
}

TEST_F(Bench, HardScenesAreHeldToTheirLimits)
{
  const std::vector<std::string> hard{ "bench", "touch", "--quick", "--json", "--studies", "hard", "--scenes",
    "sheet,fog" };
  const pointhaptics::apptest::Outcome outcome = this->run(hard);
  const json rows = json::parse(outcome.output)["hard"]["rows"];
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["name"], "sheet 20000");
  EXPECT_EQ(rows[0]["pass"], true) << rows[0];
  EXPECT_EQ(rows[0]["strokes"], 8);
  EXPECT_EQ(rows[1]["name"], "loop sheet 20000");
  EXPECT_TRUE(rows[1]["held"].is_null());
  EXPECT_EQ(rows[1]["oscillating"], 0.0);
  bool allPass = true;
  for (const json& row : rows)
  {
    EXPECT_EQ(row["pass"], row["missed"].empty()) << row;
    allPass = allPass && row["pass"];
  }
  EXPECT_EQ(outcome.exitCode, allPass ? 0 : 1) << outcome.errors;
  this->refuse(2, { "bench", "touch", "--scenes", "desert" }, { "bench touch", "--scenes", "leaves" });
}

TEST_F(Bench, FrictionIsJudgedAtEverySpeed)
{
  const json result = this->quick("friction");
  ASSERT_EQ(result["ratio"]["rows"].size(), 2u * 2u);
  for (const json& row : result["ratio"]["rows"])
  {
    if (row["method"] == "surface-fit")
    {
      EXPECT_NEAR(row["mean_ratio"].get<double>(), 0.3, 3e-4) << row;
      EXPECT_LE(row["peak"].get<double>(), 0.4 * (1 + 1e-6)) << row;
    }
  }
}

TEST_F(Bench, FilesAreReadAndWrittenRightlyAndComparedWithRivals)
{
  const json result = this->quick("io", { "--repetitions", "1" });
  std::set<std::string> contestants;
  for (const char* study : { "read", "write" })
  {
    std::set<std::string> kinds;
    for (const json& row : result[study]["rows"])
    {
      EXPECT_EQ(row["right"], true) << row;
      EXPECT_GT(row["median_seconds"], 0.0) << row;
      EXPECT_GT(row["times_ours"], 0.0) << row;
      kinds.insert(row["file"].get<std::string>());
      contestants.insert(row["contestant"].get<std::string>());
    }
    EXPECT_EQ(kinds.size(), 6u) << study;
  }
  EXPECT_EQ(contestants.count("vtkXMLPolyDataReader"), 1u);
  const json alone = this->quick("io", { "--studies", "write", "--rivals", "none", "--points", "50" });
  EXPECT_EQ(alone["write"]["rows"].size(), 6u);
  EXPECT_FALSE(alone.contains("read"));
}

TEST_F(Bench, ReadingTakesTheMemoryThatTheReaderPromises)
{
  const json result = this->quick("io", { "--studies", "memory", "--points", "500000" });
  for (const json& row : result["memory"]["rows"])
  {
    EXPECT_GT(row["peak_bytes"], row["output_bytes"].get<double>() - 1e6) << row;
    EXPECT_LE(row["beyond_bytes"], 64e6) << row;
  }
}

TEST_F(Bench, ThePictureTurnsWithFewerPointsAndRestsWithAll)
{
  if (!std::getenv("DISPLAY"))
  {
    this->refuse(1, { "bench", "render", "--quick" }, { "bench render", "no display" });
    return;
  }
  const json result = this->quick("render", { "--points", "200000", "--no-f3d" });
  ASSERT_EQ(result["turning"]["rows"].size(), 2u);
  for (const json& row : result["turning"]["rows"])
  {
    EXPECT_GT(row["frames_per_second"], 0.0) << row;
    EXPECT_GT(row["still_seconds"], 0.0) << row;
    EXPECT_EQ(row["drawn"].get<double>() > 199999.0, row["detail"] == false) << row;
  }
  ASSERT_EQ(result["first_picture"]["rows"].size(), 1u);
  EXPECT_EQ(result["first_picture"]["rows"][0]["failed"], false);
  EXPECT_GT(result["first_picture"]["rows"][0]["peak_bytes"], 1e7);
  this->succeed({ "generate", "torus", "-n", "60000", "-o", "ring.ply" });
  const json ring = this->quick("render", { "--file", this->path("ring.ply") });
  EXPECT_NE(ring["command"].get<std::string>().find("--file ring.ply"), std::string::npos);
  ASSERT_EQ(ring["turning"]["rows"].size(), 2u);
  EXPECT_EQ(ring["turning"]["rows"][0]["kind"], "object");
  EXPECT_EQ(ring["turning"]["rows"][0]["all"], 60000);
  this->refuse(1, { "bench", "render", "--quick", "--file", "none.ply" }, { "bench render", "none.ply" });
}

TEST_F(Bench, HelpAndVersionWorkOnBothLevels)
{
  EXPECT_NE(this->succeed({ "--help" }).find("bench"), std::string::npos);
  EXPECT_NE(this->succeed({ "bench", "--help" }).find("resample"), std::string::npos);
  EXPECT_NE(this->succeed({ "bench", "resample", "--help" }).find("--rivals"), std::string::npos);
  EXPECT_EQ(this->succeed({ "bench", "--version" }).rfind("pointhaptics-bench ", 0), 0u);
  EXPECT_EQ(this->succeed({ "bench", "resample", "--version" }).rfind("pointhaptics-bench ", 0), 0u);
}

TEST_F(Bench, BadOptionsAreUsageErrors)
{
  const auto refuseOption = [this](const char* option, const char* value, const char* part) {
    this->refuse(2, { "bench", "resample", option, value }, { "bench resample", option, value, part });
  };
  this->refuse(2, { "bench", "bandwidth", "--neighbors", "0" }, { "bench bandwidth", "--neighbors" });
  this->refuse(2, { "bench", "bandwidth", "--rivals", "cgal" }, { "bench bandwidth", "--rivals" });
  refuseOption("--points", "0", "from 1 to");
  refuseOption("--points", "1e9", "100000000");
  refuseOption("--points", "ten", "whole numbers");
  refuseOption("--dims", "2.5", "whole numbers");
  refuseOption("--threads", "100000", "from 1 to");
  refuseOption("--repetitions", "0", "from 1 to");
  refuseOption("--studies", "speed", "modes");
  this->refuse(2, { "bench", "proxy", "--shapes", "idol" }, { "bench proxy", "idol", "torus" });
  this->refuse(2, { "bench", "touch", "--strokes", "0" }, { "bench touch", "--strokes" });
  this->refuse(2, { "bench" }, { "pointhaptics-bench: ", "resample", "proxy", "--help" });
  this->refuse(2, { "bench", "servo", "--repetitions", "2" }, { "bench servo", "--repetitions" });
  this->refuse(2, { "bench", "sorting" }, { "bench", "sorting" });
}

TEST_F(Bench, ServoLoopTouchesRightlyAndTellsItsTimes)
{
  const json result = this->quick("servo", { "--seconds", "0.5" });
  const json& rows = result["loop"]["rows"];
  ASSERT_EQ(rows.size(), 6u);
  for (const json& row : rows)
  {
    EXPECT_EQ(row["right"], true) << row;
    EXPECT_GT(row["ticks"], 50) << row;
    for (const char* times : { "step_seconds", "jitter_seconds" })
    {
      EXPECT_LE(row[times]["p50"], row[times]["p99"]) << row;
      EXPECT_LE(row[times]["p99"], row[times]["max"]) << row;
      EXPECT_GT(row[times]["max"], 0.0) << row;
    }
    const bool isAlone = row["load"] == "idle" && std::thread::hardware_concurrency() > 1;
    EXPECT_EQ(row["empty_loop"].is_object(), isAlone) << row;
    EXPECT_TRUE(!isAlone || row["empty_loop"]["largest_jitter_seconds"] > 0.0) << row;
  }
}

TEST_F(Bench, ServoLoopRunsOnlyTheRowsThatWereAskedFor)
{
  const json result = this->quick(
    "servo", { "--seconds", "0.5", "--hands", "simulated", "--loads", "idle", "--rates", "10000" });
  const json& rows = result["loop"]["rows"];
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["rate_hz"], 10000.0);
  EXPECT_EQ(rows[0]["load"], "idle");
  this->refuse(1, { "bench", "servo", "--quick", "--hands", "falcon", "--rates", "10000" },
    { "1000 Hz only", "--rates" });
}

TEST_F(Bench, AMisspeltTaskIsToldWhichIsMeant)
{
  this->refuse(
    2, { "bench", "resampel" }, { "pointhaptics-bench: no command 'resampel'; did you mean resample?" });
  this->refuse(2, { "bench" }, { "nothing to do; commands are bandwidth, resample" });
}

TEST_F(Bench, AMisplacedOptionIsToldWhichCommandsThereAre)
{
  this->refuse(
    2, { "bench", "--quik" }, { "pointhaptics-bench: no command '--quik'; commands are bandwidth" });
  this->refuse(2, { "bench", "--versio" }, { "no command '--versio'; did you mean --version?" });
  EXPECT_EQ(this->run({ "bench" }).errors.find("manual"), std::string::npos);
}

} // namespace
