#include "RunProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>

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
    page.find("pointhaptics bench resample --repetitions 1 --studies zoom --quick --output Documentation"),
    std::string::npos)
    << page;
  EXPECT_NE(page.find("| 0.100 |"), std::string::npos);
  const bool hasDisplay = std::getenv("DISPLAY") != nullptr;
  EXPECT_EQ(this->exists("doc/Images/resample-zoom.png"), hasDisplay);
  EXPECT_EQ(page.find("](Images/resample-zoom.png)") != std::string::npos, hasDisplay);
  EXPECT_EQ(outcome.errors.find("without pictures") == std::string::npos, hasDisplay);
}

TEST_F(Bench, HelpAndVersionWorkOnBothLevels)
{
  EXPECT_NE(this->succeed({ "--help" }).find("bench"), std::string::npos);
  EXPECT_NE(this->succeed({ "bench", "--help" }).find("resample"), std::string::npos);
  EXPECT_NE(this->succeed({ "bench", "resample", "--help" }).find("--rivals"), std::string::npos);
  EXPECT_EQ(this->succeed({ "bench", "--version" }).rfind("pointhaptics ", 0), 0u);
  EXPECT_EQ(this->succeed({ "bench", "resample", "--version" }).rfind("pointhaptics ", 0), 0u);
}

TEST_F(Bench, BadOptionsAreUsageErrors)
{
  const auto refuseOption = [this](const char* option, const char* value, const char* part) {
    this->refuse(2, { "bench", "resample", option, value }, { "bench resample", option, value, part });
  };
  refuseOption("--points", "0", "from 1 to");
  refuseOption("--points", "1e9", "100000000");
  refuseOption("--points", "ten", "whole numbers");
  refuseOption("--dims", "2.5", "whole numbers");
  refuseOption("--threads", "100000", "from 1 to");
  refuseOption("--repetitions", "0", "from 1 to");
  refuseOption("--rivals", "cgal", "vtk");
  refuseOption("--studies", "speed", "accumulators");
  this->refuse(2, { "bench" }, { "pointhaptics bench: ", "resample", "--help" });
  this->refuse(2, { "bench", "sorting" }, { "bench", "sorting" });
}

TEST_F(Bench, AFolderThatCannotBeMadeIsAFailureBeforeTheWork)
{
  this->write("file", "");
  this->refuse(1, { "bench", "resample", "--quick", "-o", "file" }, { "bench resample", "file", "folder" });
  this->refuse(1, { "bench", "resample", "--quick", "-o", "file/below" }, { "file/below" });
}

} // namespace
