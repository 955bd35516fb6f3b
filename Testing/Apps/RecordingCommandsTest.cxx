// feel --record, feel --replay, view --replay and compare, as a user meets them.
#include "RunProgram.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace
{

using namespace pointhaptics;
using apptest::parseTable;

/// The first 15 columns of a table: all but how long a tick took, and what a recording has beside them.
std::string felt(const std::string& text)
{
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);)
  {
    if (!line.empty() && line[0] != '#')
    {
      std::size_t end = 0;
      for (int column = 0; column < 15; ++column)
      {
        end = line.find(',', end + 1);
      }
      result += line.substr(0, end) + "\n";
    }
  }
  return result;
}

class RecordingCommands : public apptest::CommandLine
{
protected:
  void record(const std::vector<std::string>& options = {}) const
  {
    this->succeed({ "generate", "idol", "-n", "300000", "-o", "idol.ply" });
    std::vector<std::string> words = { "feel", "idol.ply", "--path", apptest::kIdolPath, "-o", "out.csv",
      "--record", "rec.csv" };
    words.insert(words.end(), options.begin(), options.end());
    this->succeed(words);
  }
};

TEST_F(RecordingCommands, ARecordingIsFeltAgainToTheLastBit)
{
  this->record({ "--mu-d", "0.3", "--damping", "0.5" });
  const std::string recording = this->read("rec.csv");
  EXPECT_NE(recording.find("kind=fine"), std::string::npos) << "no scene near the hand was felt";
  EXPECT_EQ(recording.rfind("t,hip_x,hip_y,hip_z,proxy_x,proxy_y,proxy_z,normal_x,normal_y,normal_z,force_x,"
                            "force_y,force_z,radius,contact,update_us,buttons,marker\n# pointhaptics "
                            "recording: 2\n",
              0),
    0u);
  EXPECT_EQ(felt(recording), felt(this->read("out.csv")));
  const std::string said = this->succeed({ "feel", "--replay", "rec.csv", "-o", "again.csv" });
  EXPECT_NE(said.find("to the last bit"), std::string::npos) << said;
  EXPECT_EQ(felt(this->read("again.csv")), felt(recording));
  // A named cloud is as good, and a path is what the hand of a recording went.
  this->succeed({ "feel", "idol.ply", "--replay", "rec.csv", "-o", "named.csv" });
  EXPECT_EQ(felt(this->read("named.csv")), felt(recording));
  this->succeed({ "feel", "idol.ply", "--path", "rec.csv", "-o", "path.csv" });
  EXPECT_EQ(parseTable(this->read("path.csv")).at("hip_x"), parseTable(felt(recording)).at("hip_x"));
}

TEST_F(RecordingCommands, TheViewerFeelsARecordingAsFeelDoes)
{
  this->record();
  const apptest::Outcome outcome = this->run({ "view", "--replay", "rec.csv", "--trace", "trace.csv" });
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("to the last bit"), std::string::npos) << outcome.output;
  EXPECT_EQ(felt(this->read("trace.csv")), felt(this->read("rec.csv")));
}

TEST_F(RecordingCommands, ViewAndFeelFeelAPathAlike)
{
  this->succeed({ "generate", "idol", "-n", "300000", "-o", "idol.ply" });
  const std::vector<std::vector<std::string>> options = { { "--scale", "0.8", "--mu-d", "0.2" },
    { "--unit", "m", "--no-covariance" }, { "--translate", "0.001,0,0", "--voxel", "0.0006" },
    { "--unit", "m", "--method", "gradient-steps" }, { "--unit", "m", "--clip", "-1,1,-1,1,-1,0.02" }, {} };
  for (const std::vector<std::string>& some : options)
  {
    std::vector<std::string> view = { "view", "idol.ply", "--path", apptest::kIdolPath, "--trace",
      "trace.csv" };
    std::vector<std::string> feel = { "feel", "idol.ply", "--path", apptest::kIdolPath, "-o", "out.csv" };
    view.insert(view.end(), some.begin(), some.end());
    feel.insert(feel.end(), some.begin(), some.end());
    if (some.empty())
    {
      feel.push_back("--fit");
    }
    this->succeed(view);
    this->succeed(feel);
    const std::string trace = felt(this->read("trace.csv"));
    EXPECT_TRUE(trace == felt(this->read("out.csv"))) << (some.empty() ? "--fit" : some.front());
    EXPECT_NE(trace.find(",1\n"), std::string::npos) << "nothing was touched";
  }
}

TEST_F(RecordingCommands, ARecordingOfAClippedCloudIsFeltInItsBox)
{
  this->succeed({ "generate", "idol", "-n", "50000", "-o", "idol.ply" });
  const std::vector<std::string> feel = { "feel", "idol.ply", "--path", apptest::kIdolPath, "--record",
    "rec.csv", "-o" };
  std::vector<std::string> whole = feel;
  whole.emplace_back("whole.csv");
  this->succeed(whole);
  std::vector<std::string> clipped = feel;
  clipped.insert(clipped.end(), { "clipped.csv", "--clip", "-1,1,-1,1,-1,0.02", "--force" });
  this->succeed(clipped);
  const std::string expected = felt(this->read("clipped.csv"));
  EXPECT_NE(felt(this->read("whole.csv")), expected) << "the box changes nothing that is touched";
  this->succeed({ "feel", "--replay", "rec.csv", "-o", "again.csv" });
  EXPECT_TRUE(felt(this->read("again.csv")) == expected);
  this->succeed({ "view", "--replay", "rec.csv", "--trace", "trace.csv" });
  EXPECT_TRUE(felt(this->read("trace.csv")) == expected);
}

TEST_F(RecordingCommands, ARecordingIsNotReplaced)
{
  this->record();
  const std::string before = this->read("rec.csv");
  const std::vector<std::string> again = { "feel", "idol.ply", "--path", apptest::kIdolPath, "-o", "out.csv",
    "--record", "rec.csv" };
  this->refuse(2, again, { "--record rec.csv", "--force" });
  EXPECT_TRUE(this->read("rec.csv") == before);
  std::vector<std::string> other = again;
  other.back() = "other.csv";
  this->write("other.csv.part", "of a run that was ended");
  this->refuse(2, other, { "other.csv.part is there", "--force" });
}

TEST_F(RecordingCommands, ARecordingThatWasCutIsFeltAsFarAsItGoes)
{
  this->record();
  const std::string recording = this->read("rec.csv");
  const std::string expected = felt(recording);
  for (const std::size_t size : { recording.size() / 2, recording.size() - 3, recording.size() / 3 })
  {
    this->write("cut.csv.part", recording.substr(0, size));
    const apptest::Outcome outcome = this->run({ "feel", "--replay", "cut.csv.part", "-o", "again.csv" });
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("cut.csv.part: it was not ended"), std::string::npos) << outcome.errors;
    const std::string again = felt(this->read("again.csv"));
    EXPECT_GT(again.size(), expected.size() / 4);
    EXPECT_TRUE(expected.compare(0, again.size(), again) == 0);
  }
}

TEST_F(RecordingCommands, AReplayRefusesWhatItsRecordingDecides)
{
  this->record();
  this->refuse(
    2, { "feel", "--replay", "rec.csv", "-o", "again.csv", "--stiffness", "3" }, { "leave out --stiffness" });
  for (const std::vector<std::string>& option :
    { std::vector<std::string>{ "--beta", "3" }, { "--voxel", "1" }, { "--mu-d", "1" }, { "--columns", "x" },
      { "--path-unit", "mm" }, { "--device", "none" }, { "--record", "other.csv" } })
  {
    for (std::vector<std::string> words : { std::vector<std::string>{ "feel", "-o", "again.csv" },
           std::vector<std::string>{ "view", "--trace", "again.csv" } })
    {
      words.insert(words.end(), { "--replay", "rec.csv" });
      words.insert(words.end(), option.begin(), option.end());
      this->refuse(2, words, { "leave out " + option.front() });
    }
  }
  EXPECT_NE(this->succeed({ "feel", "--replay", "rec.csv", "-o", "a.csv", "--dry-run" }).find("idol.ply"),
    std::string::npos);
  EXPECT_NE(this->succeed({ "compare", "rec.csv", "--dry-run" }).find("idol.ply"), std::string::npos);
}

TEST_F(RecordingCommands, ACloudIsReadForItsReplayAsItWasRecorded)
{
  std::string rows;
  for (int i = 0; i < 400; ++i)
  {
    rows += "7 " + std::to_string(1e-4 * (i % 20)) + " 9 " + std::to_string(1e-4 * (i / 20)) + " 0\n";
  }
  this->write("odd.xyz", rows);
  this->write("in.csv", "t,x,y,z\n0,0.001,0.001,0.01\n0.1,0.001,0.001,-0.001\n");
  this->succeed({ "feel", "odd.xyz", "--columns", "-,x,-,y,z", "--path", "in.csv", "-o", "out.csv",
    "--record", "rec.csv" });
  this->succeed({ "feel", "--replay", "rec.csv", "-o", "again.csv" });
  EXPECT_TRUE(felt(this->read("again.csv")) == felt(this->read("out.csv")));
  EXPECT_NE(this->succeed({ "view", "--replay", "rec.csv", "--trace", "trace.csv" }).find("to the last bit"),
    std::string::npos);
  this->succeed({ "compare", "rec.csv" });
}

TEST_F(RecordingCommands, ACloudFromAStreamIsKeptForTheReplay)
{
  this->succeed({ "generate", "idol", "-n", "20000", "-o", "idol.ply" });
  const apptest::InputFrom input(this->path("idol.ply"));
  this->succeed({ "feel", "-", "--path", apptest::kIdolPath, "-o", "out.csv", "--record", "rec.csv" });
  EXPECT_EQ(this->read("rec.cloud"), this->read("idol.ply"));
  this->succeed({ "feel", "--replay", "rec.csv", "-o", "again.csv" });
  EXPECT_TRUE(felt(this->read("again.csv")) == felt(this->read("out.csv")));
}

TEST_F(RecordingCommands, OneForceLimitHoldsInEveryMode)
{
  this->succeed({ "generate", "sphere", "-n", "20000", "-o", "sphere.ply" });
  this->write("in.csv", "t,x,y,z\n0,0,0,0.03\n0.1,0,0,0.015\n");
  const std::vector<std::string> feel = { "feel", "sphere.ply", "--path", "in.csv", "-o", "out.csv", "--json",
    "--stiffness", "3000" };
  struct Case
  {
    std::vector<std::string> options;
    double limit;
    std::string name;
  };
  for (const Case& each : { Case{ { "--max-force", "1" }, 1.0, "user" },
         Case{ { "--force-limit", "2", "--max-force", "3" }, 2.0, "user" }, Case{ {}, 8.0, "program" },
         Case{ { "--force-limit", "inf", "--device", "simulated", "--stiffness", "800" }, 8.0, "device" } })
  {
    std::vector<std::string> words = feel;
    if (each.name == "device")
    {
      words.resize(words.size() - 2);
    }
    words.insert(words.end(), each.options.begin(), each.options.end());
    const nlohmann::json said = nlohmann::json::parse(this->succeed(words));
    EXPECT_LE(said["max_force_n"].get<double>(), each.limit * (1.0 + 1e-12)) << each.limit;
    EXPECT_EQ(said["force_limit_n"], each.limit);
    EXPECT_EQ(said["force_limit_of"], each.name);
  }
}

/// As Recordings.md says.
TEST_F(RecordingCommands, NumPyReadsARecording)
{
  const std::string python = "/usr/bin/python3";
  if (std::system((python + " -c 'import numpy' 2> /dev/null").c_str()) != 0)
  {
    GTEST_SKIP() << "no NumPy";
  }
  this->record();
  this->write("read.py",
    "import numpy, sys\n"
    "table = numpy.genfromtxt(sys.argv[1], delimiter=',', names=True)\n"
    "assert table.dtype.names[0] == 't' and table.dtype.names[-2:] == ('buttons', 'marker'), "
    "table.dtype.names\n"
    "assert len(table.dtype.names) == 18 and numpy.isfinite(table['force_z']).all()\n"
    "print(len(table), table['contact'].sum() > 0)\n");
  const std::string command = python + " '" + this->path("read.py") + "' '" + this->path("rec.csv") +
    "' > '" + this->path("said") + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::size_t rows = parseTable(felt(this->read("rec.csv"))).at("t").size();
  EXPECT_EQ(this->read("said"), std::to_string(rows) + " True\n");
}

TEST_F(RecordingCommands, FeelTakesAConfigurationOfTheViewer)
{
  this->succeed({ "generate", "idol", "-n", "50000", "-o", "idol.ply" });
  this->write(
    "view.json", R"({"stiffness": 500, "scale": 0.9, "device": "auto", "camera": "0,0,1,0,0,0,0,1,0",
    "axes": true, "color-by": "Height"})");
  this->succeed(
    { "feel", "idol.ply", "--config", "view.json", "--path", apptest::kIdolPath, "-o", "configured.csv" });
  this->succeed({ "feel", "idol.ply", "--stiffness", "500", "--scale", "0.9", "--path", apptest::kIdolPath,
    "-o", "out.csv" });
  EXPECT_EQ(felt(this->read("configured.csv")), felt(this->read("out.csv")));
  this->succeed({ "feel", "idol.ply", "--config", "view.json", "--stiffness", "800", "--path",
    apptest::kIdolPath, "-o", "overruled.csv" });
  EXPECT_NE(felt(this->read("overruled.csv")), felt(this->read("out.csv")));
  this->write("bad.json", R"({"stifness": 500})");
  this->refuse(2,
    { "feel", "idol.ply", "--config", "bad.json", "--path", apptest::kIdolPath, "-o", "out.csv" },
    { "bad.json", "stifness" });
}

TEST_F(RecordingCommands, TwoMethodsAreCompared)
{
  this->record();
  const auto figures = nlohmann::json::parse(this->succeed(
    { "compare", "rec.csv", "--methods", "surface-fit,sphere", "--csv", "both.csv", "--json" }));
  const apptest::Table out = parseTable(this->read("out.csv"));
  const apptest::Table both = parseTable(this->read("both.csv"));
  EXPECT_EQ(figures["ticks"], out.at("t").size());
  EXPECT_EQ(both.at("first_x"), out.at("force_x")) << "the recorded method is one of the two";
  EXPECT_EQ(both.at("first_contact"), out.at("contact"));
  EXPECT_NE(both.at("second_x"), out.at("force_x"));
  EXPECT_GT(figures["rms_difference_n"].get<double>(), 0.0);
  EXPECT_GE(figures["max_difference_n"].get<double>(), figures["rms_difference_n"].get<double>());
  this->refuse(2, { "compare", "rec.csv", "--methods", "sphere" }, { "--methods", "two methods" });
}

TEST_F(RecordingCommands, WhatCannotBeReplayedIsRefused)
{
  this->record();
  this->succeed({ "generate", "sphere", "-n", "300000", "-o", "sphere.ply" });
  this->refuse(1, { "feel", "sphere.ply", "--replay", "rec.csv", "-o", "again.csv" },
    { "sphere.ply", "others", "idol.ply" });
  const apptest::Outcome view =
    this->run({ "view", "sphere.ply", "--replay", "rec.csv", "--trace", "again.csv" });
  EXPECT_EQ(view.exitCode, 1);
  EXPECT_EQ(view.errors.rfind("pointhaptics view: sphere.ply: ", 0), 0u) << view.errors;
  this->refuse(1, { "feel", "--replay", "out.csv", "-o", "again.csv" }, { "out.csv:1", "no recording" });
  this->refuse(1, { "compare", "idol.ply" }, { "idol.ply:1", "no recording" });
  this->refuse(
    2, { "feel", "--replay", "rec.csv", "--path", apptest::kIdolPath, "-o", "again.csv" }, { "--replay" });
  this->refuse(2, { "view", "--replay", "rec.csv", "--path", apptest::kIdolPath }, { "--replay" });
  this->refuse(2,
    { "feel", "idol.ply", "--raw", "--path", apptest::kIdolPath, "-o", "x.csv", "--record", "r.csv" },
    { "--record", "--raw" });
  this->refuse(2, { "feel", "-o", "x.csv" }, { "FILE" });
  this->refuse(2, { "view" }, { "FILE" });
  EXPECT_FALSE(this->exists("again.csv"));
}

TEST_F(RecordingCommands, ARecordingWithHiddenPointsIsFeltWithoutThem)
{
  // As a window writes it that hides a fifth of the points: those are no part of the recorded cloud.
  this->succeed({ "generate", "idol", "-n", "20000", "-o", "idol.csv" });
  std::istringstream rows(this->read("idol.csv"));
  std::string whole = "x,y,z,Classification\n";
  std::string part = whole;
  std::string row;
  std::getline(rows, row); // the names
  for (int i = 0; std::getline(rows, row); ++i)
  {
    row.resize(row.find(',', row.find(',', row.find(',') + 1) + 1));
    whole += row + (i % 5 == 0 ? ",5\n" : ",2\n");
    part += i % 5 == 0 ? "" : row + ",2\n";
  }
  this->write("idol.csv", part);
  this->succeed({ "feel", "idol.csv", "--path", apptest::kIdolPath, "--record", "rec.csv", "-o", "out.csv" });
  this->write("idol.csv", whole);
  std::string recording = this->read("rec.csv");
  const std::string settings = "# settings: {";
  recording.insert(recording.find(settings) + settings.size(), "\"hide\":\"classification=5\",");
  this->write("rec.csv", recording);
  this->succeed({ "feel", "--replay", "rec.csv", "-o", "again.csv" });
  EXPECT_TRUE(felt(this->read("again.csv")) == felt(recording));
  this->succeed({ "view", "--replay", "rec.csv", "--trace", "trace.csv" });
  EXPECT_TRUE(felt(this->read("trace.csv")) == felt(recording));
  this->refuse(1, { "view", "idol.csv", "--hide", "bogus=3", "--screenshot", "bogus.png" },
    { "--hide bogus", "Classification", "height" });
}

TEST_F(RecordingCommands, AMeshIsFeltAgainByItsVerticesOrBySamples)
{
  this->succeed({ "generate", "idol", "-n", "20000", "-o", "idol.csv" });
  std::istringstream rows(this->read("idol.csv"));
  std::string vertices;
  std::string row;
  std::getline(rows, row); // the names
  while (std::getline(rows, row))
  {
    const std::size_t second = row.find(',', row.find(',') + 1);
    row.resize(row.find(',', second + 1)); // the coordinates
    std::replace(row.begin(), row.end(), ',', ' ');
    vertices += row + "\n";
  }
  this->write("mesh.off", "OFF\n20000 1 0\n" + vertices + "3 0 1 2\n");
  for (const bool isByVertices : { true, false })
  {
    std::vector<std::string> words = { "feel", "mesh.off", "--path", apptest::kIdolPath, "-o", "out.csv",
      "--record", "rec.csv", "--force" };
    words.insert(words.end(), isByVertices ? 1 : 0, "--vertices");
    EXPECT_EQ(this->run(words).exitCode, 0); // it warns of faces
    const apptest::Outcome replay =
      this->run({ "feel", "--replay", "rec.csv", "-o", "again.csv", "--force" });
    EXPECT_NE(replay.output.find("to the last bit"), std::string::npos) << replay.output << replay.errors;
    EXPECT_EQ(felt(this->read("again.csv")), felt(this->read("out.csv")));
  }
}

TEST_F(RecordingCommands, UnlikelyUnitsAreSaidByFeelAndView)
{
  this->succeed({ "generate", "sphere", "-n", "20000", "-o", "sphere.ply" });
  std::string cloud = "x,y,z\n";
  constexpr int kCount = 5000;
  for (int i = 0; i < kCount; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / kCount;
    const double ring = 25.0 * std::sqrt(1.0 - z * z);
    cloud += std::to_string(ring * std::cos(2.4 * i)) + "," + std::to_string(ring * std::sin(2.4 * i)) + "," +
      std::to_string(25.0 * z) + "\n";
  }
  this->write("mm.csv", cloud);
  this->write("path-mm.csv", "t,x,y,z\n0,-40,0,30\n1,0,0,23\n2,40,0,30\n");
  this->write("path.csv", "t,x,y,z\n0,-0.04,0,0.03\n1,0,0,0.023\n2,0.04,0,0.03\n");
  struct Case
  {
    std::string cloud, path, cure;
  };
  for (const Case& each : { Case{ "mm.csv", "path-mm.csv", "give --unit mm --path-unit mm" },
         Case{ "sphere.ply", "path-mm.csv", "give --path-unit mm" },
         Case{ "mm.csv", "path.csv", "give --unit mm" } })
  {
    const std::vector<std::string> touch = { each.cloud, "--path", each.path, "--dims", "50" };
    std::vector<std::string> feel = { "feel", "-o", "out.csv" };
    std::vector<std::string> view = { "view", "--trace", "trace.csv", "--workspace", "-50,50,-50,50,-50,50" };
    for (std::vector<std::string>* words : { &feel, &view })
    {
      words->insert(words->end(), touch.begin(), touch.end());
      const std::string said = this->run(*words).errors;
      EXPECT_NE(said.find(each.cure), std::string::npos)
        << words->front() << ": " << each.cure << ": " << said;
    }
  }
}

using Places = std::vector<std::array<int, 2>>;

/// Pixels of about this color between the axes of a chart.
Places placesOf(const std::string& fileName, const std::array<int, 3>& color)
{
  constexpr double kNear = 40.0;
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  vtkImageData* picture = reader->GetOutput();
  const int width = picture->GetDimensions()[0];
  Places places;
  for (int i = 0; i < int(picture->GetNumberOfPoints()); ++i)
  {
    double distance = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      const double value = picture->GetPointData()->GetScalars()->GetComponent(i, c);
      distance = std::max(distance, std::abs(value - color[std::size_t(c)]));
    }
    const double across = double(i % width) / width;
    if (distance < kNear && across > 0.06 && across < 0.79)
    {
      places.push_back({ i % width, i / width });
    }
  }
  return places;
}

/// Charts of a path, and of its recording, which was felt with other parameters than the viewer has.
TEST_F(RecordingCommands, TheIdealForceOfAChartObeysTheLimitThatHeld)
{
  constexpr std::array<int, 3> kForce = { 205, 85, 0 };
  constexpr std::array<int, 3> kIdeal = { 20, 90, 200 };
  this->succeed({ "generate", "sphere", "-n", "100000", "-o", "sphere.ply" });
  this->write("in.csv", "t,x,y,z\n0,0,0,0.03\n1,0,0,0.023\n");
  for (const std::string limit : { "3", "inf" })
  {
    const std::vector<std::string> touch = { "--unit", "m", "--path", "in.csv", "--stiffness", "5000",
      "--force-limit", limit };
    std::vector<std::string> view = { "view", "sphere.ply", "--force-chart", "path.png" };
    std::vector<std::string> feel = { "feel", "sphere.ply", "-o", "out.csv", "--record", "rec.csv",
      "--force" };
    view.insert(view.end(), touch.begin(), touch.end());
    feel.insert(feel.end(), touch.begin(), touch.end());
    const apptest::Outcome outcome = this->run(view);
    if (outcome.errors.find("DISPLAY") != std::string::npos)
    {
      GTEST_SKIP() << "no display";
    }
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    this->succeed(feel);
    this->succeed({ "view", "--replay", "rec.csv", "--force-chart", "replay.png" });
    for (const std::string chart : { "path.png", "replay.png" })
    {
      const Places force = placesOf(this->path(chart), kForce);
      const Places ideal = placesOf(this->path(chart), kIdeal);
      EXPECT_GT(ideal.size(), 50u) << chart;
      // Dashes of the one curve lie between those of the other.
      const auto isBesideForce = [&force](const std::array<int, 2>& place)
      {
        return std::any_of(force.begin(), force.end(),
          [&place](const std::array<int, 2>& other)
          { return std::abs(other[0] - place[0]) < 20 && std::abs(other[1] - place[1]) < 4; });
      };
      EXPECT_EQ(std::count_if(ideal.begin(), ideal.end(), isBesideForce), std::ptrdiff_t(ideal.size()))
        << chart << ", limit " << limit;
    }
  }
}

TEST_F(RecordingCommands, AHandThatWasFoundAnewTouchesNothingOnItsWayInAPath)
{
  this->succeed({ "generate", "sphere", "-n", "20000", "-o", "sphere.ply" });
  const auto contacts = [this](const std::string& between)
  {
    this->write(
      "in.csv", "t,hip_x,hip_y,hip_z\n# tick 1: begins\n0,0,0,0.06\n" + between + "0.1,0,0,-0.06\n");
    const std::vector<std::string> words = { "feel", "sphere.ply", "--path", "in.csv", "-o", "out.csv",
      "--force", "--record", "rec.csv", "--json" };
    const nlohmann::json said = nlohmann::json::parse(this->succeed(words));
    this->succeed({ "feel", "--replay", "rec.csv", "-o", "again.csv", "--force" });
    EXPECT_TRUE(felt(this->read("again.csv")) == felt(this->read("out.csv")));
    return said["contact_ticks"].get<int>();
  };
  EXPECT_GT(contacts(""), 20);
  EXPECT_EQ(contacts("# tick 101: new-hand\n"), 0);
  EXPECT_NE(this->read("rec.csv").find("# tick 101: new-hand"), std::string::npos);
}

TEST_F(RecordingCommands, ARecordingComesThroughAPipeAsWell)
{
  this->succeed({ "generate", "sphere", "-n", "5000", "-o", "sphere.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.03\n0.05,0,0,0.019\n");
  this->succeed({ "feel", "sphere.ply", "--path", "hip.csv", "-o", "out.csv", "--record", "rec.csv" });
  const std::string expected = felt(this->read("out.csv"));
  const auto expectSame = [&](const std::vector<std::string>& words)
  {
    const apptest::InputFrom input(this->path("rec.csv"));
    this->succeed(words);
    EXPECT_EQ(felt(this->read("again.csv")), expected) << words.front();
    std::filesystem::remove(this->path("again.csv"));
  };
  expectSame({ "feel", "--replay", "-", "-o", "again.csv" });
  expectSame({ "view", "--replay", "-", "--trace", "again.csv" });
  expectSame({ "view", "--replay", "-", "sphere.ply", "--trace", "again.csv" });
  expectSame({ "feel", "--replay", "/dev/stdin", "sphere.ply", "-o", "again.csv" });
  std::filesystem::rename(this->path("sphere.ply"), this->path("moved.ply"));
  const apptest::Outcome lost = this->run({ "feel", "--replay", "rec.csv", "-o", "again.csv" });
  EXPECT_NE(lost.errors.find("sphere.ply is not there; name where it is now"), std::string::npos)
    << lost.errors;
  expectSame({ "feel", "moved.ply", "--replay", "rec.csv", "-o", "again.csv" });
}

} // namespace
