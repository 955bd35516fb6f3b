#include "RunProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <thread>

namespace
{

using nlohmann::json;

class Bench : public pointhaptics::apptest::CommandLine
{
protected:
  json quick(std::vector<std::string> options) const
  {
    options.insert(options.begin(), { "bench", "resample", "--quick", "--repetitions", "2", "--json" });
    return json::parse(this->succeed(options));
  }
};

TEST_F(Bench, EveryStudyGivesRightAnswersAndPositiveRatios)
{
  const json result = this->quick({});
  EXPECT_EQ(result["task"], "resample");
  EXPECT_FALSE(result["machine"]["processor"].get<std::string>().empty());
  for (const char* study : { "points", "voxels", "attributes" })
  {
    ASSERT_FALSE(result[study]["rows"].empty()) << study;
    for (const json& row : result[study]["rows"])
    {
      EXPECT_GT(row["median_seconds"], 0.0) << row;
      EXPECT_LE(row["lower_quartile_seconds"], row["upper_quartile_seconds"]) << row;
      EXPECT_GT(row["first_seconds"], 0.0) << row;
      EXPECT_GT(row["times_ours"], 0.0) << row;
      EXPECT_GT(row["times_copy"], 0.0) << row;
      EXPECT_EQ(row["repetitions"], 2) << row;
      const bool isRival = row["contestant"].get<std::string>().find("VTK") == 0;
      EXPECT_TRUE(row["right"] == true || isRival) << row; // vtkVoxelGrid truncates the number of leaves
    }
  }
  for (const json& row : result["zoom"]["rows"])
  {
    EXPECT_EQ(row["right"], true) << row;
    EXPECT_GT(row["of_full_update"], 0.0) << row;
    EXPECT_GT(row["of_scan"], 0.0) << row;
  }
  EXPECT_EQ(result["zoom"]["rows"].size(), 4u);
}

TEST_F(Bench, FixedPointIsExactAndFloatSumsAreNotAtUtmCoordinates)
{
  const json result = this->quick({ "--studies", "accumulators" });
  EXPECT_FALSE(result.contains("points"));
  int seen = 0;
  for (const json& row : result["accumulators"]["rows"])
  {
    const double error = row["largest_error_voxels"];
    if (row["accumulator"] == "fixed point 2^-32")
    {
      EXPECT_LE(error, 0x1p-31) << row;
      ++seen;
    }
    if (row["accumulator"] == "float sum" && row["cloud"] != "plain")
    {
      EXPECT_GT(error, 1.0) << row;
      ++seen;
    }
    EXPECT_GT(row["times_fixed_point"], 0.0) << row;
  }
  EXPECT_EQ(seen, 5);
}

TEST_F(Bench, TheChosenContestantsRunAndNoOthers)
{
  const json result = this->quick({ "--studies", "points,voxels", "--rivals", "none", "--points", "500,300",
    "--dims", "10", "--threads", "1" });
  EXPECT_EQ(result["points"]["rows"].size(), 2u * 2u * 2u); // points, orders, ours with both workspaces
  EXPECT_EQ(result["voxels"]["rows"].size(), 2u);
  EXPECT_EQ(result["points"]["rows"][0]["points"], 300);
  EXPECT_FALSE(result.contains("zoom"));
}

TEST_F(Bench, EveryAnswerOfTheBandwidthStudiesIsRight)
{
  const json result =
    json::parse(this->succeed({ "bench", "bandwidth", "--quick", "--repetitions", "1", "--json" }));
  EXPECT_EQ(result["task"], "bandwidth");
  ASSERT_FALSE(result["search"]["rows"].empty());
  for (const json& row : result["search"]["rows"])
  {
    EXPECT_EQ(row["right"], true) << row;
    EXPECT_GT(row["times_ours"], 0.0) << row;
    EXPECT_LE(row["worst_relative_error"], row["contestant"] == "ours" ? 1e-14 : 1e-6) << row;
  }
  for (const char* study : { "touch", "truncation" })
  {
    ASSERT_FALSE(result[study]["rows"].empty()) << study;
    for (const json& row : result[study]["rows"])
    {
      EXPECT_EQ(row["right"], true) << row;
    }
  }
  // A ball hardly follows the density; the nearest neighbours do.
  for (const json& row : result["settling"]["rows"])
  {
    if (row["neighbors"] == 16)
    {
      EXPECT_NEAR(row["step_radius_ratio"], row["neighborhood"] == "ball" ? 1.7 : 4.0, 0.5) << row;
    }
  }
  EXPECT_GT(result["lattice"]["rows"][0]["points"], result["lattice"]["rows"][5]["points"]);
  EXPECT_EQ(result["rules"]["rows"].size(), 8u);
}

TEST_F(Bench, EveryReaderAndWriterOfFilesGivesTheSamePoints)
{
  const json result =
    json::parse(this->succeed({ "bench", "io", "--quick", "--repetitions", "1", "--json" }));
  std::set<std::string> readers;
  for (const char* study : { "read", "write" })
  {
    ASSERT_FALSE(result[study]["rows"].empty()) << study;
    for (const json& row : result[study]["rows"])
    {
      EXPECT_EQ(row["right"], true) << row;
      readers.insert(row["contestant"]);
    }
  }
  EXPECT_EQ(readers.count("ours"), 1u);
  EXPECT_EQ(readers.count("vtkXMLPolyDataReader"), 1u);
}

TEST_F(Bench, ARealCloudJoinsTheSearchAndIsCalledByItsName)
{
  this->succeed({ "generate", "torus", "-n", "2000", "-o", "ring.ply" });
  const json result =
    json::parse(this->succeed({ "bench", "bandwidth", "--quick", "--repetitions", "1", "--studies", "search",
      "--rivals", "none", "--threads", "1", "--file", this->path("ring.ply"), "--json" }));
  ASSERT_EQ(result["search"]["rows"].size(), 3u);
  EXPECT_EQ(result["search"]["rows"][2]["cloud"], "ring.ply");
  EXPECT_NE(result["command"].get<std::string>().find("--file ring.ply"), std::string::npos);
  this->refuse(1, { "bench", "bandwidth", "--quick", "--studies", "search", "--file", "none.ply" },
    { "bench", "none.ply" });
}

TEST_F(Bench, TheReportIsAPageThatKeepsItsOtherSections)
{
  std::filesystem::create_directory(this->path("doc"));
  this->write("doc/Performance.md", "# Performance\n\nKept.\n");
  const auto outcome =
    this->run({ "bench", "resample", "--quick", "--repetitions", "1", "--studies", "zoom", "-o", "doc" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  const std::string page = this->read("doc/Performance.md");
  EXPECT_NE(page.find("Kept."), std::string::npos);
  EXPECT_NE(
    page.find("pointhaptics-bench resample --repetitions 1 --studies zoom --quick --output Documentation"),
    std::string::npos)
    << page;
  EXPECT_NE(page.find("| 0.100 |"), std::string::npos);
  const bool hasDisplay = std::getenv("DISPLAY") != nullptr;
  EXPECT_EQ(this->exists("doc/Images/resample-zoom.png"), hasDisplay);
  EXPECT_EQ(page.find("](Images/resample-zoom.png)") != std::string::npos, hasDisplay);
  EXPECT_EQ(outcome.errors.find("without pictures") == std::string::npos, hasDisplay);
}

TEST_F(Bench, TheProxyIsJudgedOnEveryPathAndMethod)
{
  const json result = json::parse(this->succeed({ "bench", "proxy", "--quick", "--json" }));
  for (const json& row : result["shapes"]["rows"])
  {
    const bool clean = row["noise_metres"] == 0.0;
    EXPECT_LT(row["rms_percent"], clean ? 0.1 : 0.5) << row; // a tick of the ball
    EXPECT_GT(row["rms_percent"], 0.0) << row;
    EXPECT_GE(row["max_percent"], row["rms_percent"]) << row;
    EXPECT_EQ(row["pop_throughs"], 0) << row;
    EXPECT_GT(row["p50_us"], 0.0) << row;
    EXPECT_LE(row["p50_us"], row["p99_us"]) << row;
    EXPECT_LE(row["p99_us"], row["max_us"]) << row;
  }
  EXPECT_EQ(result["shapes"]["rows"].size(), 2u * 2u);
  EXPECT_EQ(result["paths"]["rows"].size(), 2u * 4u);
  double ours = 0.0;
  double papers = 0.0;
  for (const json& row : result["methods"]["rows"])
  {
    if (row["noise_metres"] == 0.0)
    {
      (row["method"] == "surface-fit (default)" ? ours : papers) = row["rms_percent"];
    }
  }
  EXPECT_LT(ours, 0.2);
  EXPECT_GT(papers, 100.0) << "the printed gains do not follow a hand";
  EXPECT_EQ(result["validation"]["rows"].size(), 4u);
  EXPECT_EQ(result["size"]["rows"].size(), 2u);
  EXPECT_FALSE(result.contains("scans")) << "none was given";
}

TEST_F(Bench, TheProxysInstructionSetsAreTimedSideBySide)
{
  const json result =
    json::parse(this->succeed({ "bench", "proxy", "--quick", "--studies", "instructions", "--json" }));
  const json& rows = result["instructions"]["rows"];
  ASSERT_GE(rows.size(), 2u) << "clean and noisy, with the baseline at least";
  EXPECT_EQ(rows[rows.size() - 1]["instructions"], "baseline");
  for (const json& row : rows)
  {
    EXPECT_GT(row["fit_us"], 0.0) << row;
    EXPECT_GT(row["p50_us"], 0.0) << row;
    EXPECT_LE(row["p50_us"], row["p99_us"]) << row;
  }
}

TEST_F(Bench, ScansAreFelt)
{
  this->succeed({ "generate", "sphere", "-n", "20000", "-o", "ball.ply" });
  this->write("tetra.ply",
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const json result = json::parse(this->succeed({ "bench", "proxy", "--quick", "--json", "--studies", "scans",
    "--scans", "ball.ply,tetra.ply", "--strokes", "2" }));
  ASSERT_EQ(result["scans"]["rows"].size(), 4u);
  for (const json& row : result["scans"]["rows"])
  {
    // Four points are needles: the hand slips off each, which ends the force at once.
    const bool isNeedles = row["points"] == 4;
    EXPECT_LE(row["drops"], isNeedles ? 2 : 0) << row;
    EXPECT_EQ(row["not_finite"], 0) << row;
    EXPECT_LE(row["largest_change_newton"], isNeedles ? 0.8 : 0.1 + 1e-6) << row;
  }
  EXPECT_EQ(result["scans"]["rows"][0]["strokes"], 2);
  const std::string text = this->succeed({ "bench", "proxy", "--quick", "--studies", "scans", "--scans",
    "./tetra.ply,./ball.ply", "--strokes", "1", "-o", "doc" });
  EXPECT_NE(this->read("doc/Accuracy.md").find("--scans tetra.ply,ball.ply"), std::string::npos) << text;
  this->refuse(1, { "bench", "proxy", "--quick", "--scans", "none.ply" }, { "none.ply" });
}

TEST_F(Bench, TouchIsJudgedAtEdgesOnScansAndOnThinParts)
{
  this->write("tetra.ply",
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const json result = json::parse(this->succeed(
    { "bench", "touch", "--quick", "--json", "--scans", "tetra.ply", "--methods", "surface-fit,occupancy" }));
  EXPECT_EQ(result["task"], "touch");
  EXPECT_EQ(result["scans"]["rows"].size(), 3u * 2u)
    << "samples and vertices of the scan, samples of the box";
  EXPECT_EQ(result["edges"]["rows"].size(), 2u * 2u * 2u);
  EXPECT_GE(result["thin"]["rows"].size(), 2u * 10u);
  for (const char* study : { "scans", "edges", "thin" })
  {
    for (const json& row : result[study]["rows"])
    {
      EXPECT_GT(row["judged_percent"], 50.0) << row;
      EXPECT_LE(row["median_percent"], row["p95_percent"]) << row;
      EXPECT_LE(row["p50_us"], row["p99_us"]) << row;
      EXPECT_LE(row["p99_us"], row["max_us"]) << row;
      EXPECT_TRUE(row["status_percent"].is_object()) << row;
    }
  }
  const json& box = result["scans"]["rows"].back();
  EXPECT_EQ(box["mesh"], "box");
  // A box of many points has its force where it is; four corners that fill space push where nothing is.
  for (const json& row : result["scans"]["rows"])
  {
    if (row["method"] == "occupancy")
    {
      const double phantom = row["phantom_newton"];
      EXPECT_TRUE(row["cloud"] == "vertices" ? phantom > 1.0 : phantom < 0.1) << row;
    }
  }
  const json other =
    json::parse(this->succeed({ "bench", "touch", "--quick", "--json", "--studies", "scans", "--methods",
      "surface-fit", "--stroke-set", "b", "--points", "5000", "--meshes", "stairs,gear", "--raw" }));
  ASSERT_EQ(other["scans"]["rows"].size(), 2u);
  EXPECT_EQ(other["scans"]["rows"][0]["mesh"], "stairs");
  EXPECT_EQ(other["scans"]["rows"][0]["points"], 5000);
  EXPECT_FALSE(other.contains("edges"));
  EXPECT_GT(other["scans"]["rows"][0]["first_contact_us"], 0.0);
  const json held = json::parse(this->succeed(
    { "bench", "touch", "--quick", "--json", "--studies", "scans", "--methods", "surface-fit", "--stroke-set",
      "b", "--points", "5000", "--meshes", "stairs,gear", "--raw", "--instructions", "baseline" }));
  EXPECT_EQ(held["scans"]["rows"][0]["instructions"], "baseline");
  EXPECT_EQ(held["scans"]["rows"][0]["rms_percent"], other["scans"]["rows"][0]["rms_percent"]);
  EXPECT_EQ(held["scans"]["rows"][1]["energy_joule"], other["scans"]["rows"][1]["energy_joule"]);
  this->refuse(2, { "bench", "touch", "--instructions", "mmx" }, { "bench touch", "--instructions", "avx2" });
  this->refuse(1, { "bench", "touch", "--quick", "--scans", "none.ply" }, { "none.ply" });
  this->refuse(2, { "bench", "touch", "--methods", "ball" }, { "bench touch", "--methods", "surface-fit" });
}

TEST_F(Bench, TouchIsTimedOnSmoothShapesAndScansOfEverySize)
{
  this->write("tetra.ply",
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const json result = json::parse(this->succeed({ "bench", "touch", "--quick", "--json", "--studies", "size",
    "--scans", "tetra.ply", "--sizes", "5000,3e4" }));
  const json& rows = result["size"]["rows"];
  ASSERT_EQ(rows.size(), 3u * 2u);
  const char* const meshes[] = { "sphere", "ellipsoid", "tetra.ply" };
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const json& row = rows[i];
    EXPECT_EQ(row["mesh"], meshes[i / 2]) << row;
    EXPECT_EQ(row["points"], i % 2 == 0 ? 5000 : 30000) << row;
    EXPECT_EQ(row["method"], "surface-fit") << row;
    EXPECT_GT(row["built_seconds"], 0.0) << row;
    EXPECT_GT(row["p50_us"], 0.0) << row;
    EXPECT_LE(row["first_contact_us"], row["max_us"]) << row;
    EXPECT_EQ(row["lost_percent"], 0.0) << row;
    EXPECT_LE(row["median_percent"], 1.0) << row << ": other points than the mesh's";
    EXPECT_TRUE(row["status_percent"].contains("around")) << row;
    EXPECT_GE(row["releases"], 1) << row;
  }
  const json sphere = json::parse(this->succeed({ "bench", "touch", "--quick", "--json", "--studies", "size",
    "--meshes", "none", "--sizes", "5000", "--methods", "sphere" }));
  ASSERT_EQ(sphere["size"]["rows"].size(), 2u);
  EXPECT_EQ(sphere["size"]["rows"][0]["method"], "sphere");
  this->refuse(2, { "bench", "touch", "--sizes", "0" }, { "bench touch", "--sizes" });
}

TEST_F(Bench, ScenesNearTheHandComeLate)
{
  const json late = json::parse(this->succeed({ "bench", "touch", "--quick", "--json", "--studies",
    "edges,local", "--methods", "surface-fit", "--points", "200000", "--meshes", "slot", "--late", "100" }));
  for (const json& row : late["edges"]["rows"])
  {
    EXPECT_LE(row["strokes_late"], row["strokes"]) << row;
    EXPECT_GE(row["to_100_um_newton"], 0.0) << row;
  }
  ASSERT_EQ(late["local"]["rows"].size(), 1u);
  const json& scenes = late["local"]["rows"][0];
  EXPECT_EQ(scenes["late_ms"], 100);
  EXPECT_GT(scenes["scenes"], 0);
  EXPECT_GT(scenes["p50_ms"], 0.0);
  EXPECT_LE(scenes["p50_ms"], scenes["p95_ms"]);
  EXPECT_LE(scenes["p95_ms"], scenes["max_ms"]);
  EXPECT_GT(scenes["coarse_percent_10_times"], 90.0) << "the hand is gone when the scene comes";
  const json whole = json::parse(this->succeed({ "bench", "touch", "--quick", "--json", "--studies", "local",
    "--meshes", "slot", "--points", "200000", "--whole" }));
  EXPECT_FALSE(whole.contains("local")) << "there are none";
  this->refuse(2, { "bench", "touch", "--late", "-1" }, { "bench touch", "--late" });
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
  const json result = json::parse(this->succeed({ "bench", "friction", "--quick", "--json" }));
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
  const json result =
    json::parse(this->succeed({ "bench", "io", "--quick", "--repetitions", "1", "--json" }));
  EXPECT_EQ(result["task"], "io");
  std::set<std::string> kinds;
  for (const char* study : { "read", "write" })
  {
    for (const json& row : result[study]["rows"])
    {
      EXPECT_EQ(row["right"], true) << row;
      EXPECT_GT(row["median_seconds"], 0.0) << row;
      EXPECT_GT(row["times_ours"], 0.0) << row;
      kinds.insert(row["file"].get<std::string>());
    }
  }
  EXPECT_EQ(kinds.size(), 11u);
  for (const json& row : result["memory"]["rows"])
  {
    EXPECT_TRUE(row["contestant"] != "ours" || row["beyond_bytes"] <= 64e6) << row;
  }
  const json alone = json::parse(this->succeed(
    { "bench", "io", "--quick", "--studies", "write", "--rivals", "none", "--points", "50", "--json" }));
  EXPECT_EQ(alone["write"]["rows"].size(), 6u);
  EXPECT_FALSE(alone.contains("read"));
}

TEST_F(Bench, ThePictureTurnsWithFewerPointsAndRestsWithAll)
{
  if (!std::getenv("DISPLAY"))
  {
    this->refuse(1, { "bench", "render", "--quick" }, { "bench render", "no display" });
    return;
  }
  const json result =
    json::parse(this->succeed({ "bench", "render", "--quick", "--points", "200000", "--no-f3d", "--json" }));
  ASSERT_EQ(result["turning"]["rows"].size(), 2u);
  for (const json& row : result["turning"]["rows"])
  {
    EXPECT_GT(row["frames_per_second"], 0.0) << row;
    EXPECT_EQ(row["drawn"] == row["all"], row["detail"] == false) << row;
  }
  ASSERT_EQ(result["first_picture"]["rows"].size(), 1u);
  EXPECT_EQ(result["first_picture"]["rows"][0]["failed"], false);
  EXPECT_GT(result["first_picture"]["rows"][0]["peak_bytes"], 1e7);
}

TEST_F(Bench, ThePictureOfAFileIsMeasuredEffectByEffect)
{
  this->refuse(1, { "bench", "render", "--quick", "--file", "none.ply" },
    { "bench render", std::getenv("DISPLAY") ? "none.ply" : "no display" });
  if (!std::getenv("DISPLAY"))
  {
    return;
  }
  this->succeed({ "generate", "torus", "-n", "60000", "-o", "ring.ply" });
  this->succeed({ "generate", "sphere", "-n", "500", "-o", "ball.ply" });
  const json result = json::parse(this->succeed({ "bench", "render", "--quick", "--file",
    this->path("ring.ply") + "," + this->path("ball.ply"), "--json" }));
  EXPECT_NE(result["command"].get<std::string>().find("--file ring.ply,ball.ply"), std::string::npos);
  ASSERT_EQ(result["files"]["rows"].size(), 2u);
  EXPECT_FALSE(result.contains("turning")) << "made points take minutes";
  for (const json& row : result["files"]["rows"])
  {
    EXPECT_EQ(row["kind"], "object") << row;
    EXPECT_GT(row["frames_per_second"], 0.0) << row;
    EXPECT_GT(row["discs_seconds"], 0.0) << row;
    for (const char* effect : { "sizes", "tilt", "shading" })
    {
      EXPECT_GT(row[std::string(effect) + "_seconds"], 0.0) << row;
    }
    EXPECT_GT(row["still_seconds"], 0.0) << row;
  }
  EXPECT_EQ(result["files"]["rows"][0]["file"], "ring.ply");
  EXPECT_EQ(result["files"]["rows"][0]["points"], 60000);
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
  this->refuse(2, { "bench", "bandwidth", "--rivals", "cgal" }, { "bench bandwidth", "--rivals", "vtk" });
  refuseOption("--points", "0", "from 1 to");
  refuseOption("--points", "1e9", "100000000");
  refuseOption("--points", "ten", "whole numbers");
  refuseOption("--dims", "2.5", "whole numbers");
  refuseOption("--threads", "100000", "from 1 to");
  refuseOption("--repetitions", "0", "from 1 to");
  refuseOption("--rivals", "cgal", "vtk");
  refuseOption("--studies", "speed", "accumulators");
  this->refuse(2, { "bench", "proxy", "--shapes", "idol" }, { "bench proxy", "idol", "torus" });
  this->refuse(2, { "bench", "proxy", "--strokes", "0" }, { "bench proxy", "--strokes" });
  this->refuse(2, { "bench" }, { "pointhaptics-bench: ", "resample", "proxy", "--help" });
  this->refuse(2, { "bench", "sorting" }, { "bench", "sorting" });
}

TEST_F(Bench, AFolderThatCannotBeMadeIsAFailureBeforeTheWork)
{
  this->write("file", "");
  this->refuse(1, { "bench", "resample", "--quick", "-o", "file" }, { "bench resample", "file", "folder" });
  this->refuse(1, { "bench", "resample", "--quick", "-o", "file/below" }, { "file/below" });
}

TEST_F(Bench, ServoLoopTouchesRightlyAndTellsItsTimes)
{
  const json result =
    json::parse(this->succeed({ "bench", "servo", "--quick", "--seconds", "0.5", "--json" }));
  EXPECT_EQ(result["task"], "servo");
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

TEST_F(Bench, ServoTimesTheRoundTripWhereAFalconCanBeEmulated)
{
  const std::filesystem::path program(POINTHAPTICS_PROGRAM);
  if (!std::filesystem::exists(program.parent_path() / "PointHapticsRoundTrip"))
  {
    GTEST_SKIP() << "built without umockdev (packages libumockdev-dev, umockdev)";
  }
  const json result = json::parse(this->succeed({ "bench", "servo", "--quick", "--seconds", "0.5", "--hands",
    "simulated", "--loads", "idle", "--rates", "1000", "--json" }));
  const json& rows = result["round_trip"]["rows"];
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["right"], true) << rows;
  EXPECT_GT(rows[0]["exchanges"], 5) << rows;
  const json& times = rows[0]["round_trip_seconds"];
  EXPECT_GT(times["p50"], 0.0);
  EXPECT_LE(times["p50"], times["max"]);
}

TEST_F(Bench, ServoLoopRunsOnlyTheRowsThatWereAskedFor)
{
  const json result = json::parse(this->succeed({ "bench", "servo", "--quick", "--seconds", "0.5", "--hands",
    "simulated", "--loads", "idle", "--rates", "10000", "--json" }));
  const json& rows = result["loop"]["rows"];
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["rate_hz"], 10000.0);
  EXPECT_EQ(rows[0]["load"], "idle");
  this->refuse(1, { "bench", "servo", "--quick", "--hands", "falcon", "--rates", "10000" },
    { "1000 Hz only", "--rates" });
}

} // namespace
