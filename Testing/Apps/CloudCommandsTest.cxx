#include "RunProgram.h"

#include "Shapes/Shapes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <string>

namespace
{

using namespace pointhaptics;
using apptest::parseTable;
using apptest::Table;
using nlohmann::json;

class CloudCommands : public apptest::CommandLine
{
};

TEST_F(CloudCommands, GenerateWritesTheShapeExactlyInEveryFormat)
{
  std::vector<Vec3> points, normals;
  ASSERT_EQ(generateShape(Shape::Torus, 500, 3, 1e-5, points, &normals), Status::Ok);
  for (const char* extension : { "vtp", "ply", "pcd", "csv" })
  {
    const std::string name = std::string("torus.") + extension;
    this->succeed({ "generate", "torus", "-n", "500", "--seed", "3", "--noise", "1e-5", "-o", name });
    this->succeed({ "bandwidth", name, "-o", "back.csv" });
    const Table back = parseTable(this->read("back.csv"));
    ASSERT_EQ(back.at("x").size(), points.size()) << name;
    const auto stored = [&](double value) // of PCD, whose readers want floats
    { return name == "torus.pcd" ? double(float(value)) : value; };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (const auto& [column, value] : { std::pair<const char*, double>{ "x", points[i].x },
             { "y", points[i].y }, { "z", points[i].z }, { "Normals_2", normals[i].z } })
      {
        ASSERT_EQ(stored(back.at(column)[i]), stored(value)) << name;
      }
    }
  }
}

TEST_F(CloudCommands, GenerateIsTheSameForTheSameSeed)
{
  const auto cloud = [this](const char* seed, const char* name)
  {
    this->succeed({ "generate", "idol", "-n", "2000", "--seed", seed, "-o", name });
    return this->read(name);
  };
  EXPECT_EQ(cloud("5", "a.ply"), cloud("5", "b.ply"));
  EXPECT_NE(cloud("5", "a.ply"), cloud("6", "b.ply"));
}

TEST_F(CloudCommands, GenerateSaysWhatItMade)
{
  const json result =
    json::parse(this->succeed({ "generate", "saddle", "-n", "1e3", "--seed", "7", "-o", "s.ply", "--json" }));
  EXPECT_EQ(result["shape"], "saddle");
  EXPECT_EQ(result["points"], 1000);
  EXPECT_EQ(result["seed"], 7);
  EXPECT_EQ(result["output"], "s.ply");
}

TEST_F(CloudCommands, ResampleCountsEveryPointOnce)
{
  this->succeed({ "generate", "sphere", "-n", "20000", "-o", "in.ply" });
  const json counts = json::parse(
    this->succeed({ "resample", "in.ply", "-o", "out.csv", "--voxel", "0.002", "--covariance", "--json" }));
  EXPECT_EQ(counts["points_in"], 20000);
  EXPECT_EQ(counts["points_clipped"], 0);
  EXPECT_EQ(counts["points_invalid"], 0);
  const Table out = parseTable(this->read("out.csv"));
  const std::vector<double>& voxelCounts = out.at("VoxelPointCount");
  EXPECT_EQ(std::accumulate(voxelCounts.begin(), voxelCounts.end(), 0.0), 20000.0);
  EXPECT_EQ(counts["points_out"], voxelCounts.size());
  EXPECT_EQ(out.count("VoxelCovariance_0"), 1u);
  EXPECT_EQ(out.count("VoxelCovariance_5"), 1u);
}

TEST_F(CloudCommands, ResampleDropsWhatIsOutsideOrNotANumber)
{
  this->write("in.csv", "x,y,z\n0,0,0\n0.01,0,0\n5,0,0\nnan,0,0\n0,inf,0\n");
  const json counts = json::parse(this->succeed(
    { "resample", "in.csv", "-o", "out.csv", "--workspace=-0.05,0.05,-0.05,0.05,-0.05,0.05", "--json" }));
  EXPECT_EQ(counts["points_in"], 5);
  EXPECT_EQ(counts["points_out"], 2);
  EXPECT_EQ(counts["points_clipped"], 1);
  EXPECT_EQ(counts["points_invalid"], 2);
}

TEST_F(CloudCommands, ResampledLasKeepsItsScaleUnlessTheCloudIsTransformed)
{
  std::string rows = "x,y,z\n";
  for (int i = 0; i < 1000; ++i)
  {
    rows +=
      fmt::format("{:.2f},{:.2f},{:.2f}\n", 500000.0 + 0.37 * (i * i % 101), 17.31 * (i / 100), 0.01 * i);
  }
  this->write("in.csv", rows);
  EXPECT_EQ(this->run({ "bandwidth", "in.csv", "-o", "in.las" }).exitCode, 0);
  const auto scaleOf = [this](const std::string& name)
  {
    double scale = 0.0;
    std::memcpy(&scale, this->read(name).data() + 131, sizeof scale);
    return scale;
  };
  ASSERT_EQ(scaleOf("in.las"), 0.01);
  const auto resample = [this](std::vector<std::string> options)
  {
    options.insert(options.begin(), { "resample", "in.las", "-o", "out.las", "--dims", "20" });
    const apptest::Outcome outcome = this->run(options);
    EXPECT_EQ(outcome.exitCode, 0);
    return outcome.errors;
  };
  EXPECT_NE(resample({}).find("rounded to steps of 0.01, by at most 0.00"), std::string::npos);
  EXPECT_EQ(scaleOf("out.las"), 0.01);
  // Long enough for centimetres, but they are no longer those of the file.
  EXPECT_NE(resample({ "--scale", "0.1" }).find("rounded to steps of 1e-0"), std::string::npos);
  EXPECT_EQ(scaleOf("out.las"), 1e-4);
}

TEST_F(CloudCommands, ACloudWithoutAValidPointIsRefused)
{
  this->write("in.csv", "x,y,z\nnan,0,0\n0,inf,0\n");
  this->write("path.csv", "t,x,y,z\n0,0,0,0.03\n");
  const std::string why =
    ": in.csv: no point is finite: 2 points with a coordinate that is NaN or infinite; mend the file\n";
  this->refuse(1, { "bandwidth", "in.csv", "-o", "out.csv" }, { "bandwidth" + why });
  this->refuse(1, { "resample", "in.csv", "-o", "out.csv" }, { "resample" + why });
  this->refuse(1, { "feel", "in.csv", "-o", "out.csv", "--path", "path.csv" }, { "feel" + why });
  this->refuse(1, { "feel", "in.csv", "-o", "out.csv", "--path", "path.csv", "--raw" }, { "feel" + why });
  this->refuse(1, { "feel", "in.csv", "-o", "out.csv", "--path", "path.csv", "--fit" }, { "feel" + why });
}

TEST_F(CloudCommands, OnePointIsNotCalledPoints)
{
  this->write("in.csv", "x,y,z\n0,0,0\n");
  this->write("path.csv", "t,x,y,z\n0,0,0,0.03\n");
  EXPECT_EQ(this->succeed({ "resample", "in.csv", "-o", "out.csv" }),
    "1 point in, 1 out, 0 clipped, 0 invalid: out.csv\n");
  EXPECT_EQ(this->succeed({ "convert", "in.csv", "out.ply" }), "1 point: out.ply\n");
  const std::string shown = this->succeed({ "view", "in.csv", "--path", "path.csv", "--trace", "trace.csv" });
  EXPECT_EQ(shown.rfind("1 point, ", 0), 0u) << shown;
}

TEST_F(CloudCommands, InfoNamesTheCommandsThatTakeAUnit)
{
  this->write("in.csv", "x,y,z\n0,0,0\n");
  EXPECT_NE(this->succeed({ "info", "in.csv" })
              .find("nothing tells the unit; --unit of view, feel and resample does"),
    std::string::npos);
  for (const char* command : { "view", "feel", "resample" })
  {
    EXPECT_NE(this->succeed({ command, "--help" }).find("--unit"), std::string::npos) << command;
  }
}

TEST_F(CloudCommands, TransformsApplyInTheirOrder)
{
  this->write("in.csv", "x,y,z\n1,0,0\n");
  const auto moved = [this](std::vector<std::string> options)
  {
    std::vector<std::string> words = { "resample", "in.csv", "-o", "out.csv" };
    words.insert(words.end(), options.begin(), options.end());
    this->succeed(words);
    const Table out = parseTable(this->read("out.csv"));
    return Vec3(out.at("x").at(0), out.at("y").at(0), out.at("z").at(0));
  };
  const auto expectNear = [](const Vec3& a, const Vec3& b)
  { EXPECT_LT(norm(a - b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z; };
  expectNear(moved({ "--scale", "2", "--rotate", "90,0,0,1", "--translate", "5,0,0" }), { 5, 2, 0 });
  expectNear(moved({ "--translate", "5,0,0", "--rotate", "90,0,0,1", "--scale", "2,3,4" }), { 5, 2, 0 });
  expectNear(moved({ "--unit", "mm", "--translate", "0,0,1" }), { 0.001, 0, 1 });
  expectNear(moved({ "--matrix", "0,-2,0,5,2,0,0,0,0,0,2,0,0,0,0,1" }), { 5, 2, 0 });
}

TEST_F(CloudCommands, ResampleDoesNotDependOnTheNumberOfThreads)
{
  this->succeed({ "generate", "idol", "-n", "30000", "-o", "in.ply" });
  this->succeed({ "resample", "in.ply", "-o", "one.csv", "--covariance", "--threads", "1" });
  this->succeed({ "resample", "in.ply", "-o", "two.csv", "--covariance", "--threads", "2" });
  EXPECT_EQ(this->read("one.csv"), this->read("two.csv"));
}

TEST_F(CloudCommands, BandwidthFollowsTheDensityAndKeepsItsBounds)
{
  this->succeed({ "generate", "density-step", "-n", "17000", "-o", "in.ply" });
  const std::string said = this->succeed({ "bandwidth", "in.ply", "-o", "out.csv" });
  EXPECT_NE(said.find("17000 points"), std::string::npos);
  const Table out = parseTable(this->read("out.csv"));
  double sums[2] = {}, counts[2] = {};
  for (std::size_t i = 0; i < out.at("x").size(); ++i)
  {
    const double x = out.at("x")[i];
    if (std::abs(x) > 0.005)
    {
      sums[x > 0.0] += out.at("ProxyRadius")[i];
      counts[x > 0.0] += 1.0;
    }
  }
  // 16 times the density: a quarter of the spacing.
  EXPECT_NEAR(sums[0] / counts[0] / (sums[1] / counts[1]), 4.0, 0.4);

  this->succeed(
    { "bandwidth", "in.ply", "-o", "bounded.csv", "--r1", "0.002", "--r2", "0.003", "--rule", "scott" });
  const Table bounded = parseTable(this->read("bounded.csv"));
  for (const double radius : bounded.at("ProxyRadius"))
  {
    ASSERT_GE(radius, 0.002);
    ASSERT_LE(radius, 0.003);
  }
  EXPECT_EQ(bounded.count("Density"), 1u);

  this->succeed(
    { "bandwidth", "in.ply", "-o", "plain.csv", "--rule", "sheather-jones", "--density", "none" });
  const Table plain = parseTable(this->read("plain.csv"));
  EXPECT_EQ(plain.count("Density"), 0u);
  EXPECT_EQ(plain.at("ProxyRadius").size(), 17000u);
}

TEST_F(CloudCommands, ResampleKeepsPointsAndTellsTheVoxelOfEach)
{
  this->succeed({ "generate", "sphere", "-n", "3000", "--noise", "1e-3", "-o", "in.csv" });
  const Table in = parseTable(this->read("in.csv"));
  for (const char* representative : { "nearest-to-mean", "nearest-to-center", "median", "mean" })
  {
    this->succeed({ "resample", "in.csv", "-o", "out.csv", "--voxel", "0.005", "--representative",
      representative, "--minimum-points", "3", "--voxel-index", "index.csv" });
    const Table out = parseTable(this->read("out.csv"));
    const std::vector<double> index = parseTable(this->read("index.csv")).at("voxel");
    ASSERT_EQ(index.size(), 3000u);
    std::vector<double> counts(out.at("x").size(), 0.0);
    std::size_t own = 0;
    for (std::size_t i = 0; i < index.size(); ++i)
    {
      if (index[i] >= 0.0)
      {
        const auto v = std::size_t(index[i]);
        ++counts[v];
        own += in.at("x")[i] == out.at("x")[v] && in.at("y")[i] == out.at("y")[v] &&
          in.at("Normals_2")[i] == out.at("Normals_2")[v];
      }
    }
    EXPECT_EQ(counts, out.at("VoxelPointCount")) << representative;
    EXPECT_GE(*std::min_element(counts.begin(), counts.end()), 3.0);
    EXPECT_EQ(own == counts.size(), std::strncmp(representative, "nearest", 7) == 0) << representative;
  }
  this->refuse(
    1, { "resample", "in.csv", "-o", "none.csv", "--minimum-points", "100000" }, { "--minimum-points" });
  this->refuse(2, { "resample", "in.csv", "-o", "a.csv", "--voxel-index", "a.csv" }, { "--voxel-index" });
  this->refuse(
    2, { "resample", "in.csv", "-o", "a.csv", "--representative", "first" }, { "nearest-to-mean" });
}

TEST_F(CloudCommands, ResampleNamesThePointOfEachVoxelInEveryFormat)
{
  // Three decimals, which LAS keeps.
  std::mt19937 random(1);
  std::string text = "x,y,z,row\n";
  for (int row = 0; row < 2000; ++row)
  {
    const auto next = [&random] { return 0.001 * double(random() % 1000); };
    text += fmt::format("{:.3f},{:.3f},{:.3f},{}\n", next(), next(), next(), row);
  }
  this->write("in.csv", text);
  for (const char* representative : { "nearest-to-mean", "nearest-to-center" })
  {
    for (const char* extension : { "csv", "ply", "vtp", "pcd", "las", "laz", "xyz" })
    {
      const std::string name = std::string("out.") + extension;
      this->succeed({ "resample", "in.csv", "-o", name, "--voxel", "0.2", "--minimum-points", "3",
        "--original-ids", "--representative", representative });
      this->succeed({ "convert", name, "-o", "back.csv" });
      const Table out = parseTable(this->read("back.csv"));
      EXPECT_GE(out.at("row").size(), 100u);
      EXPECT_EQ(out.at("vtkOriginalPointIds"), out.at("row")) << name << ", " << representative;
    }
  }
  this->succeed({ "resample", "in.csv", "-o", "without.csv", "--representative", "nearest-to-mean" });
  EXPECT_EQ(parseTable(this->read("without.csv")).count("vtkOriginalPointIds"), 0u);
  for (const char* representative : { "mean", "median" })
  {
    this->refuse(2,
      { "resample", "in.csv", "-o", "none.csv", "--original-ids", "--representative", representative },
      { "--original-ids: ", "give --representative nearest-to-mean or nearest-to-center" });
  }
}

TEST_F(CloudCommands, LabelsAreKnownInAnyCase)
{
  this->write("in.csv", "x,y,z,CLASSIFICATION\n0,0,0,2\n0,0,0,2\n0,0,0,5\n");
  this->succeed({ "resample", "in.csv", "-o", "out.csv", "--dims", "1" });
  EXPECT_EQ(parseTable(this->read("out.csv")).at("CLASSIFICATION"), std::vector<double>{ 2 });
}

TEST_F(CloudCommands, AFailedWriteLeavesTheOldFileAsItWas)
{
  this->succeed({ "generate", "sphere", "-n", "50", "-o", "cloud.ply" });
  const std::string before = this->read("cloud.ply");
  this->write("out.ply", "old");
  this->refuse(1, { "resample", "cloud.ply", "-o", "out.ply", "--workspace", "1,2,1,2,1,2" }, { "clipped" });
  EXPECT_EQ(this->read("cloud.ply"), before);
  EXPECT_EQ(this->read("out.ply"), "old");
}

TEST_F(CloudCommands, InfoSaysWhatIsInAFile)
{
  this->write("in.csv", "x,y,z,depth\n0,0,0,1\n3,0,0,2\n0,4,0,nan\nnan,0,0,4\n");
  const json file = json::parse(this->succeed({ "info", "in.csv", "--json" }))["files"][0];
  EXPECT_EQ(file["file"], "in.csv");
  EXPECT_EQ(file["points"], 4);
  EXPECT_EQ(file["points_invalid"], 1);
  EXPECT_EQ(file["bounds"]["max"], json({ 3.0, 4.0, 0.0 }));
  EXPECT_EQ(file["spacing"], 3.0);
  ASSERT_EQ(file["arrays"].size(), 1u);
  EXPECT_EQ(file["arrays"][0]["name"], "depth");
  EXPECT_EQ(file["arrays"][0]["max"], json({ 4.0 }));
  const std::string text = this->succeed({ "info", "in.csv" });
  EXPECT_NE(text.find("depth"), std::string::npos);
  EXPECT_NE(text.find("--scale"), std::string::npos) << "4 m is no size for the hand: " << text;
}

TEST_F(CloudCommands, InfoTellsDuplicatesSpacingAndUnit)
{
  // A square grid with a step of 0.5, and its first two points again.
  std::string text = "x,y,z\n0,0,0\n0.5,0,0\n";
  for (int i = 0; i < 100; ++i)
  {
    text += std::to_string(0.5 * (i % 10)) + "," + std::to_string(0.5 * (i / 10)) + ",0\n";
  }
  this->write("grid.csv", text);
  const json grid = json::parse(this->succeed({ "info", "grid.csv", "--json" }))["files"][0];
  EXPECT_EQ(grid["points"], 102);
  EXPECT_EQ(grid["points_duplicate"], 2);
  EXPECT_EQ(grid["spacing_percentiles"]["5"], 0.5);
  EXPECT_EQ(grid["spacing_percentiles"]["95"], 0.5);
  EXPECT_EQ(grid["density_variation"], 1.0);
  EXPECT_EQ(grid["suggested_voxel"], 1.0);
  EXPECT_EQ(grid["unit"], "m");
  EXPECT_EQ(grid["unit_is_guess"], true);
  EXPECT_NE(this->succeed({ "info", "grid.csv" }).find("2 at the place of another"), std::string::npos);
  this->write("map.csv", "x,y,z\n684766.39,5017773.08,0\n684993.29,5018007.25,30\n");
  EXPECT_EQ(json::parse(this->succeed({ "info", "map.csv", "--json" }))["files"][0]["unit"], "m");
  this->write("part.csv", "x,y,z\n0,0,0\n400,200,150\n");
  EXPECT_EQ(json::parse(this->succeed({ "info", "part.csv", "--json" }))["files"][0]["unit"], "mm");
}

TEST_F(CloudCommands, InfoTellsCoordinatesAsTheFileHasThem)
{
  this->write("in.csv", "x,y,z\n-0.1,0.2,0.3\n0.7,0.2,0.4\n");
  const std::string text = this->succeed({ "info", "in.csv" });
  EXPECT_NE(text.find("bounds   x -0.1 .. 0.7  y 0.2 .. 0.2  z 0.3 .. 0.4\n"), std::string::npos) << text;
}

TEST_F(CloudCommands, InfoOfNoSpacingNamesNoVoxel)
{
  this->write("one.xyz", "1 2 3\n");
  const std::string one = this->succeed({ "info", "one.xyz" });
  EXPECT_NE(one.find("spacing  none"), std::string::npos) << one;
  EXPECT_EQ(one.find("voxel"), std::string::npos) << one;
  // More copies than neighbors are looked at.
  std::string copies;
  for (int i = 0; i < 40; ++i)
  {
    copies += "1 2 3\n1 2 5\n";
  }
  this->write("copies.xyz", copies);
  EXPECT_EQ(json::parse(this->succeed({ "info", "copies.xyz", "--json" }))["files"][0]["spacing"], 2.0);
  this->write("none.xyz", "nan nan nan\n");
  EXPECT_NE(this->succeed({ "info", "none.xyz" }).find("note     no point is finite"), std::string::npos);
}

TEST_F(CloudCommands, InfoTellsOfPointsFarFromAllOthers)
{
  this->succeed({ "generate", "sphere", "-n", "2000", "-o", "sphere.csv" });
  EXPECT_EQ(this->succeed({ "info", "sphere.csv" }).find("far from"), std::string::npos);
  this->write("far.csv", this->read("sphere.csv") + "1000000,0,0,0,0,1\n");
  const std::string far = this->succeed({ "info", "far.csv" });
  EXPECT_NE(far.find("1 of 2,001 points is far from all others"), std::string::npos) << far;
  EXPECT_NE(far.find("lattice and picture leave it out, a workspace of -1"), std::string::npos) << far;
}

TEST_F(CloudCommands, PointsWithoutDataAreFarWhateverTheirNumber)
{
  std::string table = "x,y,z\n";
  for (int i = 0; i < 2000; ++i)
  {
    const std::string height = i % 4 == 0 ? "-9999" : std::to_string(300 + i % 7);
    table += std::to_string(512345 + i % 50) + "," + std::to_string(5412347 + i / 50) + "," + height + "\n";
  }
  this->write("holes.csv", table);
  this->succeed({ "convert", "holes.csv", "holes.las" });
  for (const char* file : { "holes.csv", "holes.las" })
  {
    const std::string text = this->succeed({ "info", file });
    EXPECT_NE(text.find("500 of 2,000 points are far from all others"), std::string::npos) << text;
    const std::string output = this->run({ "resample", file, "-o", "means.csv" }).output;
    EXPECT_NE(output.find(" 500 clipped"), std::string::npos) << output;
    const std::string option = "a workspace of ";
    const std::size_t box = text.find(option) + option.size();
    const std::string all = this->succeed({ "resample", file, "-o", "means.csv", "--workspace",
      text.substr(box, text.find_first_of(" \n", box) - box) });
    EXPECT_NE(all.find(" 0 clipped"), std::string::npos) << text << all;
  }
}

TEST_F(CloudCommands, RaysThatDidNotReturnAreFarWhateverTheirNumber)
{
  std::string table = "x,y,z\n";
  for (int i = 0; i < 2000; ++i)
  {
    table += i % 4 == 0 ? "0,0,0\n"
                        : std::to_string(512345 + i % 50) + "," + std::to_string(5412347 + i / 50) + ",3\n";
  }
  this->write("zeros.csv", table);
  const std::string errors = this->run({ "resample", "zeros.csv", "-o", "means.csv" }).errors;
  EXPECT_NE(errors.find("500 of 2,000 points are far from all others"), std::string::npos) << errors;
  EXPECT_EQ(errors.find("(0, 0, 0)"), std::string::npos) << "it is said once";
}

TEST_F(CloudCommands, ResamplingSaysThatItTakesRaysThatDidNotReturn)
{
  this->write("in.csv", "x,y,z\n1,2,3\n0,0,0\n1,2,4\n0,0,0\n1,3,4\n");
  const auto errorsOf = [&](std::vector<std::string> more)
  {
    std::vector<std::string> arguments = { "resample", "in.csv", "-o", "means.csv" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    return this->run(arguments).errors;
  };
  EXPECT_NE(errorsOf({}).find("warning: in.csv: 2 points at (0, 0, 0), which scanners write for rays without "
                              "return, are resampled as others are\n"),
    std::string::npos);
  EXPECT_NE(errorsOf({ "--voxel", "1" }).find("2 points at"), std::string::npos);
  EXPECT_EQ(errorsOf({ "--workspace", "0.5,2,1,4,2,5" }), "");
  EXPECT_NE(errorsOf({ "--translate", "1,2,3", "--workspace", "0.5,2,1,4,2,5" }).find("2 points at"),
    std::string::npos);
  this->write("in.csv", "x,y,z\n1,2,3\n0,0,0\n1,2,4\n");
  EXPECT_EQ(errorsOf({}), "") << "one may well be a point";
}

TEST_F(CloudCommands, ResamplingLeavesFarPointsOutAndSaysHowTheyAreTakenIn)
{
  this->succeed({ "generate", "sphere", "-n", "2000", "-o", "sphere.csv" });
  this->write("far.csv", this->read("sphere.csv") + "1000000,0,0,0,0,1\n");
  const auto resampled = [&](std::vector<std::string> more)
  {
    std::vector<std::string> arguments = { "resample", "far.csv", "-o", "means.csv" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    return this->run(arguments);
  };
  const std::string of =
    "1 of 2,001 points is far from all others; lattice and picture leave it out, a workspace of ";
  for (const std::vector<std::string>& more : { std::vector<std::string>{}, { "--dims", "50" },
         { "--voxel", "0.001" }, { "--scale", "10", "--rotate", "90,0,0,1", "--translate", "0,0,1" } })
  {
    const auto outcome = resampled(more);
    const std::size_t box = outcome.errors.find(of);
    ASSERT_NE(box, std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.output.find(" 1 clipped"), std::string::npos) << outcome.output;
    std::vector<std::string> all = more;
    all.resize(more.size() == 2 ? 0 : more.size());
    const std::size_t numbers = box + of.size();
    all.insert(all.end(),
      { "--workspace", outcome.errors.substr(numbers, outcome.errors.find(' ', numbers) - numbers) });
    EXPECT_NE(resampled(all).output.find(" 0 clipped"), std::string::npos) << outcome.errors;
  }
  EXPECT_EQ(resampled({ "--voxel", "10" }).errors, "");
}

TEST_F(CloudCommands, TheUnitOfATextGoesWithItsPointsUntilTheyAreScaled)
{
  this->write("in.csv", "x [mm],y [mm],z [mm],h\n1,2,3,4\n5,6,7,8\n");
  for (const std::string file : { "out.ply", "out.pcd", "out.las", "out.csv", "out.xyz", "out.vtp" })
  {
    this->succeed({ "convert", "in.csv", "-o", file });
    const std::string text = this->succeed({ "info", file });
    EXPECT_NE(text.find("unit     mm (the file says so)"), std::string::npos) << text;
  }
  EXPECT_EQ(this->read("out.csv").substr(0, 23), "x [mm],y [mm],z [mm],h\n");
  const auto isSaid = [&](std::vector<std::string> more)
  {
    std::vector<std::string> words = { "resample", "in.csv", "-o", "means.ply" };
    words.insert(words.end(), more.begin(), more.end());
    this->succeed(words);
    return this->succeed({ "info", "means.ply" }).find("mm (the file says so)") != std::string::npos;
  };
  EXPECT_TRUE(isSaid({}));
  EXPECT_TRUE(isSaid({ "--translate", "1,0,0" }));
  EXPECT_FALSE(isSaid({ "--unit", "mm" }));
  EXPECT_FALSE(isSaid({ "--scale", "2" }));
}

TEST_F(CloudCommands, InfoTellsTheCoordinateSystemAndItsUnit)
{
  // VTK keeps strings as the codes of their letters: EPSG:2225 and foot.
  this->write("feet.vtp",
    "<VTKFile type=\"PolyData\"><PolyData><FieldData>"
    "<Array type=\"String\" Name=\"CoordinateSystem\" NumberOfTuples=\"1\" format=\"ascii\">"
    "69 80 83 71 58 50 50 50 53 0</Array>"
    "<Array type=\"String\" Name=\"LengthUnit\" NumberOfTuples=\"1\" format=\"ascii\">102 111 111 116 "
    "0</Array>"
    "</FieldData><Piece NumberOfPoints=\"2\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
    "format=\"ascii\">6000000 2000000 10 6000001 2000000 "
    "10</DataArray></Points></Piece></PolyData></VTKFile>\n");
  const json feet = json::parse(this->succeed({ "info", "feet.vtp", "--json" }))["files"][0];
  EXPECT_EQ(feet["coordinate_system"], "EPSG:2225");
  EXPECT_EQ(feet["unit"], "ft");
  EXPECT_EQ(feet["unit_is_guess"], false);
  const std::string text = this->succeed({ "info", "feet.vtp" });
  EXPECT_NE(text.find("EPSG:2225"), std::string::npos) << text;
  EXPECT_NE(text.find("the file says so"), std::string::npos) << text;
  EXPECT_NE(text.find("m; --unit ft as the file says, or --scale"), std::string::npos) << text;
  // Points that are moved are not where the system says.
  const auto resampled = [&](std::vector<std::string> more)
  {
    std::vector<std::string> words = { "resample", "feet.vtp", "-o", "means.vtp", "--dims", "3" };
    words.insert(words.end(), more.begin(), more.end());
    this->succeed(words);
    return this->succeed({ "info", "means.vtp" });
  };
  EXPECT_NE(resampled({}).find("EPSG:2225"), std::string::npos);
  const std::string moved = resampled({ "--translate", "-6000000,-2000000,0" });
  EXPECT_EQ(moved.find("EPSG:2225"), std::string::npos) << moved;
  EXPECT_NE(moved.find("ft (the file says so)"), std::string::npos) << moved;
}

TEST_F(CloudCommands, WhatAFormatCannotHoldIsSaid)
{
  this->succeed({ "generate", "torus", "-n", "500", "-o", "torus.ply" });
  const apptest::Outcome las = this->run({ "bandwidth", "torus.ply", "-o", "torus.las" });
  EXPECT_EQ(las.exitCode, 0);
  EXPECT_NE(las.errors.find("bandwidth: warning: torus.las: coordinates are rounded"), std::string::npos)
    << las.errors;
  const apptest::Outcome vtp = this->run({ "bandwidth", "torus.ply", "-o", "torus.vtp" });
  EXPECT_EQ(vtp.errors.find("torus.vtp: "), std::string::npos) << vtp.errors;
  const json info = json::parse(this->succeed({ "info", "torus.las", "--json" }))["files"][0];
  EXPECT_EQ(info["points"], 500);
}

TEST_F(CloudCommands, InfoHintsOnlyWhereTheSizeIsOdd)
{
  this->succeed({ "generate", "idol", "-n", "500", "-o", "idol.ply" });
  EXPECT_EQ(this->succeed({ "info", "idol.ply" }).find("hint"), std::string::npos);
  this->succeed({ "resample", "idol.ply", "-o", "mm.ply", "--scale", "1000" });
  EXPECT_NE(this->succeed({ "info", "mm.ply" }).find("--unit mm"), std::string::npos);
}

TEST_F(CloudCommands, InfoGoesOnAfterABadFile)
{
  this->succeed({ "generate", "sphere", "-n", "50", "-o", "good.ply" });
  const apptest::Outcome outcome = this->run({ "info", "bad.ply", "good.ply" });
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_NE(outcome.errors.find("bad.ply"), std::string::npos);
  EXPECT_NE(outcome.output.find("good.ply"), std::string::npos);
  const apptest::Outcome asJson = this->run({ "info", "bad.ply", "good.ply", "--json" });
  EXPECT_EQ(asJson.exitCode, 1);
  const json files = json::parse(asJson.output)["files"];
  ASSERT_EQ(files.size(), 2u);
  EXPECT_TRUE(files[0].contains("error"));
  EXPECT_EQ(files[1]["points"], 50);
}

} // namespace
