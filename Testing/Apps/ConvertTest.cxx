#include "RunProgram.h"

#include "../Unit/IO/E57/E57File.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace
{

using namespace pointhaptics;
using apptest::InputFrom;
using apptest::parseTable;
using apptest::Table;
using nlohmann::json;

class Convert : public apptest::CommandLine
{
protected:
  void SetUp() override { this->write("in.csv", "x,y,z,Intensity\n1,2,3,10\n4,5.25,6,20\n"); }
  /// Two scans, the second one turned by half about x and lifted.
  std::string twoScans() const
  {
    E57TestScan first{ { e57Double("cartesianX", { 1, 2 }), e57Double("cartesianY", { 3, 4 }),
                         e57Double("cartesianZ", { 5, 6 }) },
      "<name type=\"String\">door</name>", "" };
    E57TestScan second = first;
    second.xml = e57Pose({ 0, 1, 0, 0 }, { 0, 0, 5017906.07 });
    E57TestFile file{ { first, second } };
    file.xml = "<e57LibraryVersion type=\"String\">a test</e57LibraryVersion>"
               "<images2D type=\"Vector\"><vectorChild type=\"Structure\"/></images2D>";
    return file.bytes();
  }
};

TEST_F(Convert, GoesThroughEveryFormatAndBack)
{
  std::string last = "in.csv";
  for (const char* extension : { "vtp", "ply", "pcd", "las", "xyz", "csv" })
  {
    const std::string next = std::string("next.") + extension;
    ASSERT_EQ(this->run({ "convert", last, next }).exitCode, 0) << next;
    last = next;
  }
  const Table table = parseTable(this->read("next.csv"));
  EXPECT_EQ(table.at("x"), (std::vector<double>{ 1, 4 }));
  EXPECT_EQ(table.at("y"), (std::vector<double>{ 2, 5.25 }));
  EXPECT_EQ(table.at("Intensity"), (std::vector<double>{ 10, 20 }));
}

TEST_F(Convert, SaysWhatItWrote)
{
  EXPECT_EQ(this->succeed({ "convert", "in.csv", "out.ply" }), "2 points: out.ply\n");
  const json result = json::parse(this->succeed({ "convert", "in.csv", "-o", "out.ply", "--json" }));
  EXPECT_EQ(result["inputs"], json::array({ "in.csv" }));
  EXPECT_EQ(result["points"], 2);
}

TEST_F(Convert, CountsThePointsInTheFileItWrote)
{
  this->write("holes.csv", "x,y,z\n1,2,3\nnan,5,6\n7,8,9\n");
  EXPECT_EQ(this->run({ "convert", "holes.csv", "out.las" }).output, "2 points: out.las\n");
  EXPECT_EQ(json::parse(this->run({ "convert", "holes.csv", "out.laz", "--json" }).output)["points"], 2);
  EXPECT_EQ(this->succeed({ "convert", "holes.csv", "out.ply" }), "3 points: out.ply\n");
}

TEST_F(Convert, TakesStandardInputAndOutput)
{
  this->succeed({ "convert", "in.csv", "in.vtp" });
  {
    const InputFrom input(this->path("in.vtp"));
    const std::string ply = this->succeed({ "convert", "-", "-", "--output-format", "ply" });
    this->write("back.ply", ply);
  }
  this->succeed({ "convert", "back.ply", "back.csv" });
  EXPECT_EQ(parseTable(this->read("back.csv")), parseTable(this->read("in.csv")));
  this->write("shape", "o shape\nv 1 2 3\n");
  const InputFrom input(this->path("shape"));
  EXPECT_EQ(this->succeed({ "convert", "-", "-", "--input-format", "obj", "--output-format", "csv" }),
    "x,y,z\n1,2,3\n");
}

TEST_F(Convert, TakesItsOutputAsOtherCommandsDo)
{
  EXPECT_EQ(this->succeed({ "convert", "in.csv", "-o", "a.ply" }), "2 points: a.ply\n");
  this->succeed({ "convert", "in.csv", "b.ply" });
  EXPECT_EQ(this->read("a.ply"), this->read("b.ply"));
  EXPECT_EQ(
    this->succeed({ "convert", "--together", "in.csv", "b.ply", "-o", "c.ply" }), "4 points: c.ply\n");
  EXPECT_EQ(this->succeed({ "convert", "in.csv", "-o", "-", "--output-format", "ply" }), this->read("b.ply"));
  this->refuse(
    2, { "convert", "in.csv" }, { "in.csv: nothing says what to write; give a second name, or -o" });
  this->refuse(2, { "convert", "in.csv", "b.ply", "-o", "d.ply" }, { "d.ply: 2 inputs and one output" });
}

TEST_F(Convert, NamesStandardInputInItsMessages)
{
  this->write("odd", std::string("\1\2\3\0odd", 7));
  const InputFrom input(this->path("odd"));
  this->refuse(1, { "convert", "-", "out.ply" }, { "standard input: unknown format" });
  EXPECT_FALSE(this->exists("out.ply"));
}

TEST_F(Convert, OutputFormatGoesBeforeTheExtension)
{
  this->succeed({ "convert", "in.csv", "out", "--output-format", "pcd" });
  EXPECT_EQ(this->read("out").substr(0, 6), "# .PCD");
  this->refuse(2, { "convert", "in.csv", "out.e57" }, { "out.e57: unknown extension \".e57\"", ".las" });
}

TEST_F(Convert, MergesWithEveryArrayOfEach)
{
  this->write("b.csv", "x,y,z,Class\n7,8,9,2\n");
  const apptest::Outcome outcome = this->run({ "convert", "in.csv", "b.csv", "out.csv", "--together" });
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.errors.find("1 of 2 inputs, 'in.csv', have no Class: their points have 0 there"),
    std::string::npos)
    << outcome.errors;
  const Table table = parseTable(this->read("out.csv"));
  EXPECT_EQ(table.at("x"), (std::vector<double>{ 1, 4, 7 }));
  EXPECT_EQ(table.at("Intensity"), (std::vector<double>{ 10, 20, 0 }));
  EXPECT_EQ(table.at("Class"), (std::vector<double>{ 0, 0, 2 })) << "labels stay integers";
}

TEST_F(Convert, RefusesWhatWouldLoseAFile)
{
  this->write("b.csv", "x,y,z\n7,8,9\n");
  this->refuse(2, { "convert", "in.csv", "b.csv", "out.csv" }, { "2 inputs and one output", "--merge" });
  this->refuse(2, { "convert", "in.csv", "in.csv", "b.csv", "--together" }, { "b.csv: is there already" });
  EXPECT_EQ(this->read("b.csv"), "x,y,z\n7,8,9\n");
  this->refuse(2, { "convert", "in.csv", "-" }, { "--output-format" });
  EXPECT_EQ(this->run({ "convert", "in.csv", "-", "--output-format", "ply", "--json" }).exitCode, 2);
}

TEST_F(Convert, ScansComeTogetherOrStayWithTheirScanners)
{
  this->write("scans.e57", this->twoScans());
  const apptest::Outcome outcome = this->run({ "convert", "scans.e57", "out.csv" });
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.errors.find("1 image is not read"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("ScanPoses"), std::string::npos) << outcome.errors;
  EXPECT_EQ(
    parseTable(this->read("out.csv")).at("z"), (std::vector<double>{ 5, 6, 5017906.07 - 5, 5017906.07 - 6 }));
  EXPECT_EQ(this->run({ "convert", "scans.e57", "kept.csv", "--keep-poses" }).exitCode, 0);
  EXPECT_EQ(parseTable(this->read("kept.csv")).at("z"), (std::vector<double>{ 5, 6, 5, 6 }));
}

TEST_F(Convert, InfoTellsGeneratorScansAndPoses)
{
  this->write("scans.e57", this->twoScans());
  const std::string text = this->succeed({ "info", "scans.e57" });
  for (const char* part :
    { "format   E57 1.0", "written  by a test", "scan 1   door: 2 points, scanner at 0 0 0",
      "scan 2   scan 2: 2 points, scanner at 0 0 5017906.07, quaternion 0 1 0 0",
      "note     1 image is not read" })
  {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  const json file = json::parse(this->succeed({ "info", "scans.e57", "--json" }))["files"][0];
  EXPECT_EQ(file["generator"], "a test");
  EXPECT_EQ(file["scans"][1]["translation"][2], 5017906.07);
}

TEST_F(Convert, InfoOfAValidFileWithoutPointsSaysSo)
{
  this->write("empty.e57", E57TestFile{}.bytes());
  EXPECT_NE(this->succeed({ "info", "empty.e57" }).find("valid, but it holds no scan"), std::string::npos);
  this->refuse(1, { "convert", "empty.e57", "out.ply" },
    { "empty.e57: E57 1.0: the file is valid, but it holds no scan" });
}

TEST_F(Convert, FilesOfUnlikeUnitsAreMergedInOne)
{
  this->write("m.csv", "x_m,y_m,z_m\n1,2,3\n");
  this->write("mm.csv", "x [mm],y [mm],z [mm]\n4000,5000,6000\n");
  const auto outcome = this->run({ "convert", "m.csv", "mm.csv", "--merge", "-o", "all.csv" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("the coordinates of 'mm.csv' are converted from mm to m"), std::string::npos)
    << outcome.errors;
  EXPECT_EQ(this->read("all.csv"), "x,y,z\n1,2,3\n4,5,6\n");
}

TEST_F(Convert, EachFileThatIsConvertedIsNamed)
{
  this->write("m.csv", "x_m,y_m,z_m\n1,2,3\n");
  this->write("scan1.csv", "x [mm],y [mm],z [mm]\n4000,5000,6000\n");
  this->write("scan2.csv", "x [in],y [in],z [in]\n0,0,100\n");
  const auto outcome =
    this->run({ "convert", "m.csv", "scan1.csv", "scan2.csv", "--merge", "-o", "all.csv" });
  for (const char* part :
    { "'scan1.csv' are converted from mm to m\n", "'scan2.csv' are converted from in to m\n" })
  {
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
  }
  EXPECT_EQ(this->read("all.csv"), "x,y,z\n1,2,3\n4,5,6\n0,0,2.54\n");
  EXPECT_NE(outcome.errors.find("does not say that the unit is 'm':"), std::string::npos) << outcome.errors;
}

TEST_F(Convert, FeetThatDifferAreConvertedWithAWord)
{
  const auto cloudIn = [](const std::string& unit)
  {
    std::string codes;
    for (const char letter : unit)
    {
      codes += std::to_string(int(letter)) + " ";
    }
    return "<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData><FieldData><Array type=\"String\" "
           "Name=\"LengthUnit\" NumberOfTuples=\"1\" format=\"ascii\">" +
      codes +
      "0</Array></FieldData><Piece NumberOfPoints=\"1\"><PointData><DataArray type=\"Float64\" "
      "Name=\"ProxyRadius\" format=\"ascii\">5</DataArray></PointData><Points><DataArray type=\"Float64\" "
      "NumberOfComponents=\"3\" format=\"ascii\">3000000 0 "
      "0</DataArray></Points></Piece></PolyData></VTKFile>";
  };
  this->write("foot.vtp", cloudIn("foot"));
  this->write("survey.vtp", cloudIn("US survey foot"));
  const auto outcome = this->run({ "convert", "foot.vtp", "survey.vtp", "--merge", "-o", "all.csv" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_NE(
    outcome.errors.find("'survey.vtp' are converted from us-ft to ft, its arrays are not"), std::string::npos)
    << outcome.errors;
  EXPECT_NE(this->read("all.csv").find("\n3000006"), std::string::npos) << this->read("all.csv");
}

TEST_F(Convert, AVoxelIsSaidToBeInTheUnitOfTheFile)
{
  this->write("mm.csv", "x [mm],y [mm],z [mm]\n4,5,6\n");
  const auto errorsOf = [&](std::vector<std::string> more)
  {
    more.insert(more.begin(), { "resample", "mm.csv", "-o", "out.csv", "--voxel", "5" });
    return this->run(more).errors;
  };
  EXPECT_NE(errorsOf({}).find("--voxel 5 is 5 mm, the unit of the file; --unit mm makes metres of both"),
    std::string::npos);
  EXPECT_EQ(errorsOf({ "--unit", "mm" }), "");
}

TEST_F(Convert, AFileThatIsMergedTwiceIsSaid)
{
  this->write("a.csv", "x,y,z\n1,2,3\n");
  std::filesystem::create_symlink("a.csv", this->path("link.csv"));
  const auto outcome = this->run({ "convert", "a.csv", "link.csv", "--merge", "-o", "all.csv" });
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("link.csv: is the same file as a.csv"), std::string::npos) << outcome.errors;
}

TEST_F(Convert, LengthsAreInTheUnitOfTheFileOrInMetresAndThatIsSaid)
{
  std::string cloud = "x [mm],y [mm],z [mm]\n";
  for (int i = 0; i < 100; ++i)
  {
    cloud += fmt::format("{},{},0\n", i % 10, i / 10);
  }
  this->write("mm.csv", cloud);
  const auto radii = [&](std::vector<std::string> words, const std::string& said)
  {
    words.insert(words.begin(), { "bandwidth", "mm.csv", "-o", "out.csv", "--density", "none" });
    const auto outcome = this->run(words);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_NE((outcome.errors + outcome.output).find(said), std::string::npos)
      << said << ": " << outcome.errors << outcome.output;
    return parseTable(this->read("out.csv")).at("ProxyRadius");
  };
  const std::string word = "--radius 3.5 is 3.5 mm, the unit of the file; --unit mm makes metres of both";
  const std::vector<double> millimetres = radii({ "--radius", "3.5" }, word);
  const std::vector<double> metres = radii({ "--unit", "mm", "--radius", "0.0035" }, "proxy radius 0.00");
  ASSERT_EQ(metres.size(), 100u);
  for (std::size_t i = 0; i < metres.size(); ++i)
  {
    EXPECT_NEAR(1e3 * metres[i], millimetres.at(i), 1e-9);
  }
  radii({ "--unit", "mm", "--radius", "0.0035" }, "out.csv, in metres\n");
  radii({ "--r2", "3" }, "--r2 3 is 3 mm, the unit of the file");
  EXPECT_EQ(this->succeed({ "resample", "mm.csv", "--unit", "mm", "-o", "out.csv" }),
    "100 points in, 100 out, 0 clipped, 0 invalid: out.csv, in metres\n");
}

TEST_F(Convert, FeetOfTheUsSurveyAreFeetOfTheirOwn)
{
  this->write(
    "feet.csv", "x [US survey foot],y [US survey foot],z [US survey foot]\n3937000,0,0\n0,3937000,1\n");
  for (const std::string file : { "feet.ply", "feet.pcd", "feet.vtp", "feet.las", "feet.xyz", "again.csv" })
  {
    this->succeed({ "convert", "feet.csv", "-o", file });
    const std::string text = this->succeed({ "info", file });
    EXPECT_NE(text.find("us-ft (the file says so)"), std::string::npos) << text;
    EXPECT_NE(text.find("--unit us-ft as the file says"), std::string::npos) << text;
    EXPECT_EQ(this->run({ "resample", file, "--unit", "us-ft", "-o", "m.csv", "--force" }).exitCode, 0);
    EXPECT_NE(this->read("m.csv").find("\n1200000,"), std::string::npos) << this->read("m.csv");
  }
}

TEST_F(Convert, TheBoundsThatInfoPrintsHoldEveryPoint)
{
  // Neighbours of decimal numbers, as sums of steps make them; and floats, which --clip reads as doubles.
  this->write("double.xyz",
    "0.30000000000000004 -0.7999999999999999 1234567.1\n0.1 0.1 0.1\n0.7999999999999999 0.30000000000000004 "
    "-0.30000000000000004\n");
  this->write("float.xyz", "0.1 -0.1 0.3\n0.7 16777.2 0.9\n-0.6 -5.3 -0.3\n");
  this->succeed({ "convert", "float.xyz", "-o", "float.ply" });
  for (const std::string file : { "double.xyz", "float.ply" })
  {
    const std::string text = this->succeed({ "info", file });
    char words[6][40];
    ASSERT_EQ(
      std::sscanf(text.c_str() + text.find("bounds"), "bounds x %39s .. %39s y %39s .. %39s z %39s .. %39s",
        words[0], words[1], words[2], words[3], words[4], words[5]),
      6)
      << text;
    const std::string box =
      fmt::format("{},{},{},{},{},{}", words[0], words[1], words[2], words[3], words[4], words[5]);
    EXPECT_EQ(
      this->succeed({ "convert", file, "-o", "part.ply", "--clip", box, "--force" }), "3 points: part.ply\n")
      << text;
  }
}

TEST_F(Convert, TheBoxOfAFlatCloudKeepsAllItsPoints)
{
  this->write("flat.csv", "x,y,z\n0,0,0\n1,0,0\n1,2,0\n");
  for (const std::string file : { "flat.csv", "flat.ply", "flat.las", "flat.vtp", "flat.pcd" })
  {
    if (!this->exists(file))
    {
      this->succeed({ "convert", "flat.csv", file });
    }
    EXPECT_EQ(this->succeed({ "convert", file, "-o", "part.csv", "--clip", "0,1,0,2,0,0", "--force" }),
      "3 points: part.csv\n")
      << file;
  }
  this->refuse(2, { "convert", "flat.csv", "-o", "x.csv", "--clip", "0,1,0,2,0,-1" }, { "no box" });
}

TEST_F(Convert, AllLengthsInTheUnitOfTheFileAreSaidInOneNote)
{
  std::string cloud = "x [mm],y [mm],z [mm]\n";
  for (int i = 0; i < 100; ++i)
  {
    cloud += fmt::format("{},{},0\n", i % 10, i / 10);
  }
  this->write("mm.csv", cloud);
  const auto errorsOf = [&](std::vector<std::string> more)
  {
    more.insert(more.begin(), { "bandwidth", "mm.csv", "-o", "out.csv", "--density", "none" });
    const auto outcome = this->run(more);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    return outcome.errors;
  };
  EXPECT_NE(errorsOf({ "--r1", "2", "--r2", "3" })
              .find("--r1 2 is 2 mm, --r2 3 is 3 mm, the unit of the file; --unit mm makes metres of all"),
    std::string::npos);
  EXPECT_EQ(errorsOf({ "--r2", "3", "--unit", "mm" }), "");
}

TEST_F(Convert, AUnitThatContradictsTheFileIsSaid)
{
  std::string cloud = "x [ftUS],y [ftUS],z [ftUS]\n";
  for (int i = 0; i < 100; ++i)
  {
    cloud += fmt::format("{},{},0\n", i % 10, i / 10);
  }
  this->write("feet.csv", cloud);
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.03\n0.05,0,0,0.019\n");
  for (std::vector<std::string> words :
    { std::vector<std::string>{ "bandwidth", "feet.csv", "-o", "out.csv", "--density", "none" },
      { "resample", "feet.csv", "-o", "out.csv", "--voxel", "1" },
      { "feel", "feet.csv", "--path", "hip.csv", "-o", "out.csv" },
      { "view", "feet.csv", "--path", "hip.csv", "--trace", "out.csv", "--dims", "9" } })
  {
    words.insert(words.end(), { "--force", "--unit", "us-ft" });
    EXPECT_EQ(this->run(words).errors.find("its unit is"), std::string::npos) << words.front();
    words.back() = "ft";
    const auto outcome = this->run(words);
    EXPECT_NE(outcome.errors.find("the file says that its unit is us-ft, and ft is taken"), std::string::npos)
      << words.front() << ": " << outcome.errors;
  }
}

/// What info says of a file's unit is what --unit takes, and what is written says the unit that it has.
TEST_F(Convert, AUnitHasItsNamesReadAndWritten)
{
  this->write("feet.ply",
    "ply\nformat ascii 1.0\ncomment LengthUnit foot\nelement vertex 2\nproperty double x\n"
    "property double y\nproperty double z\nend_header\n10 0 0\n0 10 5\n");
  const auto unit = [this](const std::string& file) {
    return json::parse(this->succeed({ "info", file, "--json" }))["files"][0]["unit"].get<std::string>();
  };
  const std::string said = unit("feet.ply");
  EXPECT_EQ(said, "ft");
  for (const std::string& name : { said, std::string("ft"), std::string("Feet") })
  {
    this->succeed({ "resample", "feet.ply", "--unit", name, "-o", "m.ply", "--force" });
    EXPECT_EQ(unit("m.ply"), "m") << name;
    this->succeed({ "bandwidth", "feet.ply", "--unit", name, "-o", "b.ply", "--force" });
    EXPECT_EQ(unit("b.ply"), "m") << name;
  }
  this->succeed({ "resample", "feet.ply", "--unit", "ft", "--scale", "2", "-o", "m.ply", "--force" });
  EXPECT_NE(unit("m.ply"), "ft");
  const auto refused = this->run({ "resample", "feet.ply", "--unit", "ell", "-o", "x.ply" });
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.errors.find("us-ft"), std::string::npos) << refused.errors;
}

} // namespace
