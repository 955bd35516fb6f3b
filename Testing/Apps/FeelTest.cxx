#include "RunProgram.h"

#include "Shapes/Shapes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace
{

using namespace pointhaptics;
using apptest::parseTable;
using apptest::Table;

constexpr const char* kSpherePath = POINTHAPTICS_DATA "/Paths/sphere-press-slide.csv";
constexpr double kStiffness = 800.0;

Vec3 vectorOf(const Table& table, const std::string& name, std::size_t row)
{
  return { table.at(name + "_x")[row], table.at(name + "_y")[row], table.at(name + "_z")[row] };
}

/// RMS of |force - ideal| over RMS of the ideal, in ticks where program and ideal both have contact.
double relativeForceError(const Table& table, Shape shape, std::size_t& contacts)
{
  double error2 = 0.0, ideal2 = 0.0;
  contacts = 0;
  for (std::size_t row = 0; row < table.at("t").size(); ++row)
  {
    const Vec3 hip = vectorOf(table, "hip", row);
    const SurfacePoint foot = closestPoint(shape, hip);
    if (table.at("contact")[row] == 1.0 && foot.distance < 0.0)
    {
      const Vec3 ideal = kStiffness * (foot.point - hip);
      error2 += norm2(vectorOf(table, "force", row) - ideal);
      ideal2 += norm2(ideal);
      ++contacts;
    }
  }
  return std::sqrt(error2 / ideal2);
}

std::string digits(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

/// The text without its last column, update_us.
std::string withoutTimes(const std::string& text)
{
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);)
  {
    result += line.substr(0, line.rfind(',')) + "\n";
  }
  return result;
}

class Feel : public apptest::CommandLine
{
protected:
  Table feel(const std::string& cloud, const std::string& path, std::vector<std::string> options = {}) const
  {
    std::vector<std::string> words = { "feel", cloud, "--path", path, "-o", "out.csv" };
    words.insert(words.end(), options.begin(), options.end());
    this->succeed(words);
    return parseTable(this->read("out.csv"));
  }
};

/// The 16 bit samples of a WAV file.
std::vector<int> samplesOf(const std::string& bytes)
{
  std::vector<int> samples;
  for (std::size_t i = 44; i + 1 < bytes.size(); i += 2)
  {
    const auto value = static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) |
      static_cast<unsigned>(static_cast<unsigned char>(bytes[i + 1])) << 8;
    samples.push_back(value < 32768 ? int(value) : int(value) - 65536);
  }
  return samples;
}

TEST_F(Feel, WritesTheTouchAsSoundThatIsSilentWhereNothingIsTouched)
{
  this->succeed({ "generate", "sphere", "-n", "20000", "-o", "sphere.ply" });
  const Table felt = this->feel("sphere.ply", kSpherePath, { "--sound-file", "touch.wav" });
  const std::string bytes = this->read("touch.wav");
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  const std::vector<int> samples = samplesOf(bytes);
  constexpr std::size_t kPerTick = 48;
  const std::size_t ticks = felt.at("t").size();
  ASSERT_EQ(samples.size(), kPerTick * ticks);
  const auto loudest = [&samples](std::size_t begin, std::size_t end)
  {
    int most = 0;
    for (std::size_t i = kPerTick * begin; i < kPerTick * end; ++i)
    {
      most = std::max(most, std::abs(samples[i]));
    }
    return most;
  };
  const std::vector<double>& contact = felt.at("contact");
  const auto first = std::size_t(std::find(contact.begin(), contact.end(), 1.0) - contact.begin());
  ASSERT_LT(first + 100, ticks);
  EXPECT_EQ(loudest(0, first), 0);
  EXPECT_GT(loudest(first, first + 10), 2000) << "the click";
  // As loud as the force where that has been felt for a while.
  std::size_t most = first + 60;
  const auto force = [&felt](std::size_t tick) { return norm(vectorOf(felt, "force", tick)); };
  for (std::size_t tick = most; tick < ticks; ++tick)
  {
    most = contact[tick] == 1.0 && force(tick) > force(most) ? tick : most;
  }
  EXPECT_NEAR(loudest(most - 5, most + 1), 32767.0 * 0.2 * force(most) / (force(most) + 1.0), 600.0);
  this->refuse(2, { "feel", "sphere.ply", "--path", kSpherePath, "-o", "o.csv", "--sound-file", "touch.mp3" },
    { "--sound-file", "touch.mp3", ".wav" });
  this->refuse(1,
    { "feel", "sphere.ply", "--path", kSpherePath, "-o", "o.csv", "--sound-file", "nowhere/touch.wav" },
    { "nowhere/touch.wav: cannot be written" });
}

TEST_F(Feel, SaysHowFarAHandThatTouchesNothingStaysAway)
{
  this->succeed({ "generate", "plane", "-n", "4000", "-o", "plane.ply" });
  this->write("above.csv", "t,x,y,z\n0,0,0,0.4\n0.5,0,0,0.31\n1,0,0,0.5\n");
  const std::string said = this->succeed({ "feel", "plane.ply", "--path", "above.csv", "-o", "out.csv" });
  EXPECT_NE(
    said.find("0 of 1001 ticks in contact; nearest point 0.31 m away; --fit brings"), std::string::npos)
    << said;
  const std::string placed =
    this->succeed({ "feel", "plane.ply", "--path", "above.csv", "-o", "out.csv", "--scale", "1" });
  EXPECT_EQ(placed.find("--fit"), std::string::npos) << placed;
  const auto told = nlohmann::json::parse(
    this->succeed({ "feel", "plane.ply", "--path", "above.csv", "-o", "out.csv", "--json" }));
  EXPECT_NEAR(told.at("nearest_point_m").get<double>(), 0.31, 0.003);
  this->write("deep.csv", "t,x,y,z\n0,0,0,0.01\n1,0,0,-0.002\n");
  const std::string touched = this->succeed({ "feel", "plane.ply", "--path", "deep.csv", "-o", "out.csv" });
  EXPECT_EQ(touched.find("nearest point"), std::string::npos) << touched;
  this->succeed({ "generate", "sphere", "-n", "4000", "-o", "sphere.ply" });
  this->write("inside.csv", "t,x,y,z\n0,0,0,0.024\n0.1,0,0,0.01\n");
  const std::string inside = this->succeed({ "feel", "sphere.ply", "--path", "inside.csv", "-o", "out.csv" });
  EXPECT_NE(inside.find("begin it outside"), std::string::npos) << inside;
}

TEST_F(Feel, RoundingErrorsAreNoForce)
{
  this->write("one.xyz", "1 2 3\n");
  this->write("down.csv", "t,x,y,z\n0,0,0,0.1\n1,0,0,0\n");
  const std::string output =
    this->succeed({ "feel", "one.xyz", "--fit", "--path", "down.csv", "-o", "felt.csv" });
  EXPECT_NE(output.find(" 1 in contact, max force 0 N,"), std::string::npos) << output;
}

TEST_F(Feel, TheSphereOfThePaperIsFeltWithinATwentiethOfAPercent)
{
  this->succeed({ "generate", "sphere", "-n", "543652", "-o", "sphere.ply" });
  std::size_t contacts = 0;
  const double moments = relativeForceError(this->feel("sphere.ply", kSpherePath), Shape::Sphere, contacts);
  EXPECT_GT(contacts, 4000u);
  EXPECT_LT(moments, 0.0005);
  const double means =
    relativeForceError(this->feel("sphere.ply", kSpherePath, { "--no-covariance" }), Shape::Sphere, contacts);
  EXPECT_GT(contacts, 4000u);
  EXPECT_LT(means, 0.0005);
  EXPECT_LT(moments, means);
  this->RecordProperty("rms_percent", digits(100.0 * moments));
  this->RecordProperty("rms_percent_no_covariance", digits(100.0 * means));
}

TEST_F(Feel, RawPointsAreFeltToo)
{
  this->succeed({ "generate", "sphere", "-n", "47516", "-o", "sphere.ply" });
  std::size_t contacts = 0;
  EXPECT_LT(
    relativeForceError(this->feel("sphere.ply", kSpherePath, { "--raw" }), Shape::Sphere, contacts), 0.0005);
  EXPECT_GT(contacts, 4000u);
}

TEST_F(Feel, TheIdolIsTouchedAndFollowed)
{
  this->succeed({ "generate", "idol", "-n", "200000", "-o", "idol.ply" });
  const Table out = this->feel("idol.ply", apptest::kIdolPath);
  // The hand is nearly a radius of curvature deep in places: there the direction to the nearest point is
  // anybody's guess, but its distance is not, nor that the contact point lies on the surface.
  double contacts = 0.0, offSurface2 = 0.0, depthError2 = 0.0, depth2 = 0.0;
  for (std::size_t row = 0; row < out.at("t").size(); row += 5)
  {
    if (out.at("contact")[row] == 1.0)
    {
      const Vec3 hip = vectorOf(out, "hip", row), proxy = vectorOf(out, "proxy", row);
      const double offSurface = closestPoint(Shape::Idol, proxy).distance;
      const double depth = closestPoint(Shape::Idol, hip).distance;
      offSurface2 += offSurface * offSurface;
      depthError2 += std::pow(norm(proxy - hip) - std::abs(depth), 2);
      depth2 += depth * depth;
      contacts += 1.0;
    }
  }
  EXPECT_GT(contacts, 800.0);
  // Eight rows make nearly all of both, where the ball speaks and two places are nearly as near: the hand
  // keeps to the one that it touched.
  EXPECT_LT(std::sqrt(offSurface2 / contacts), 8e-6);
  EXPECT_LT(std::sqrt(depthError2 / depth2), 0.006);
  this->RecordProperty("rms_off_surface_metres", digits(std::sqrt(offSurface2 / contacts)));
  this->RecordProperty("rms_percent", digits(100.0 * std::sqrt(depthError2 / depth2)));
}

TEST_F(Feel, NearTheHandScenesAreAsFineAsThePointsUnlessALatticeIsAskedFor)
{
  this->succeed({ "generate", "idol", "-n", "300000", "-o", "idol.ply" });
  const auto medianOffSurface = [this](const std::vector<std::string>& options, nlohmann::json& summary)
  {
    std::vector<std::string> words = { "feel", "idol.ply", "--path", apptest::kIdolPath, "-o", "out.csv",
      "--json" };
    words.insert(words.end(), options.begin(), options.end());
    summary = nlohmann::json::parse(this->succeed(words));
    const Table out = parseTable(this->read("out.csv"));
    std::vector<double> off;
    for (std::size_t row = 0; row < out.at("t").size(); row += 5)
    {
      if (out.at("contact")[row] == 1.0)
      {
        off.push_back(std::abs(closestPoint(Shape::Idol, vectorOf(out, "proxy", row)).distance));
      }
    }
    EXPECT_GT(off.size(), 800u);
    std::sort(off.begin(), off.end());
    return off.empty() ? 0.0 : off[off.size() / 2];
  };
  nlohmann::json fine, coarse, raw, means;
  const double off = medianOffSurface({}, fine);
  const double offWhole = medianOffSurface({ "--dims", "300" }, coarse);
  EXPECT_GT(fine["local_scenes"].get<int>(), 5);
  EXPECT_EQ(coarse["local_scenes"], 0);
  EXPECT_EQ(fine["points_felt"], coarse["points_felt"]);
  EXPECT_LT(fine["finest_cell_m"].get<double>(), 0.6 * coarse["finest_cell_m"].get<double>());
  EXPECT_LT(off, 0.2 * offWhole);
  medianOffSurface({ "--raw" }, raw);
  EXPECT_EQ(raw["local_scenes"], 0);
  medianOffSurface({ "--no-covariance" }, means);
  EXPECT_EQ(means["local_scenes"], 0);
  this->RecordProperty("median_off_surface_metres", digits(off));
  this->RecordProperty("median_off_surface_metres_whole", digits(offWhole));
}

TEST_F(Feel, TheTableIsWhatItsHeaderSays)
{
  this->succeed({ "generate", "plane", "-n", "20000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n1,0,0,0.002\n1.5,0.001,0,-0.002\n");
  const Table out = this->feel("plane.ply", "hip.csv", { "--rate", "100" });
  EXPECT_EQ(this->read("out.csv").substr(0, this->read("out.csv").find('\n')),
    "t,hip_x,hip_y,hip_z,proxy_x,proxy_y,proxy_z,normal_x,normal_y,normal_z,force_x,force_y,force_z,radius,"
    "contact,"
    "update_us");
  ASSERT_EQ(out.at("t").size(), 51u);
  EXPECT_EQ(out.at("t").front(), 1.0);
  EXPECT_EQ(out.at("t").back(), 1.5);
  for (std::size_t row = 0; row < 51; ++row)
  {
    const Vec3 hip = vectorOf(out, "hip", row), proxy = vectorOf(out, "proxy", row);
    EXPECT_NEAR(out.at("t")[row], 1.0 + 0.01 * double(row), 1e-12);
    EXPECT_NEAR(hip.z, 0.002 - 0.00008 * double(row), 1e-12);
    EXPECT_GT(out.at("radius")[row], 0.0);
    EXPECT_GT(out.at("update_us")[row], 0.0); // a tick takes some nanoseconds at least
    EXPECT_NEAR(norm(vectorOf(out, "normal", row)), 1.0, 1e-12);
    const bool contact = out.at("contact")[row] == 1.0;
    if (std::abs(hip.z) > 1e-9)
    {
      EXPECT_EQ(contact, hip.z < 0.0) << row;
    }
    EXPECT_NEAR(norm(vectorOf(out, "force", row) - kStiffness * (proxy - hip)), 0.0, 1e-12);
    if (!contact)
    {
      EXPECT_EQ(proxy, hip);
    }
  }
}

TEST_F(Feel, OnePointOfAPathIsOneTick)
{
  this->succeed({ "generate", "plane", "-n", "5000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.01\n");
  EXPECT_EQ(this->feel("plane.ply", "hip.csv").at("t").size(), 1u);
}

TEST_F(Feel, TheLastTickFallsOnTheEndOfThePath)
{
  this->succeed({ "generate", "plane", "-n", "5000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0.1,0,0,0.01\n0.4,0,0,0.02\n"); // 0.3 s times 1 kHz is not exact in binary
  const Table out = this->feel("plane.ply", "hip.csv");
  EXPECT_EQ(out.at("t").size(), 301u);
  EXPECT_NEAR(out.at("hip_z").back(), 0.02, 1e-15);
}

TEST_F(Feel, SameInputSameOutput)
{
  this->succeed({ "generate", "idol", "-n", "50000", "-o", "idol.ply" });
  for (const std::vector<std::string>& options :
    { std::vector<std::string>{ "--mu-d", "0.2" }, std::vector<std::string>{ "--method", "gradient-steps" },
      std::vector<std::string>{ "--method", "sphere" } })
  {
    this->feel("idol.ply", apptest::kIdolPath, options);
    const std::string first = withoutTimes(this->read("out.csv"));
    this->feel("idol.ply", apptest::kIdolPath, options);
    EXPECT_EQ(withoutTimes(this->read("out.csv")), first);
  }
}

TEST_F(Feel, SameOutputWhateverTheThreads)
{
  this->succeed({ "generate", "idol", "-n", "200000", "-o", "idol.ply" });
  std::string texts[2];
  for (const int threads : { 1, 2 })
  {
    ASSERT_EQ(setenv("VTK_SMP_MAX_THREADS", std::to_string(threads).c_str(), 1), 0);
    const auto summary = nlohmann::json::parse(
      this->succeed({ "feel", "idol.ply", "--path", apptest::kIdolPath, "-o", "out.csv", "--json" }));
    EXPECT_GT(summary["local_scenes"].get<int>(), 5) << "those are made by threads, too";
    texts[threads - 1] = withoutTimes(this->read("out.csv"));
  }
  unsetenv("VTK_SMP_MAX_THREADS");
  EXPECT_EQ(texts[0], texts[1]);
}

TEST_F(Feel, StiffnessScalesTheForce)
{
  this->succeed({ "generate", "plane", "-n", "20000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.002\n0.2,0,0,-0.001\n");
  EXPECT_NEAR(this->feel("plane.ply", "hip.csv").at("force_z").back(), 0.8, 1e-6);
  EXPECT_NEAR(this->feel("plane.ply", "hip.csv", { "--stiffness", "200" }).at("force_z").back(), 0.2, 1e-6);
}

TEST_F(Feel, SlidingFrictionIsMuTimesTheNormalForce)
{
  this->succeed({ "generate", "plane", "-n", "100000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0,-0.02,0,0.001\n0.2,-0.02,0,-0.001\n1.2,0.02,0,-0.001\n");
  const Table out = this->feel("plane.ply", "hip.csv", { "--mu-s", "0.4", "--mu-d", "0.3" });
  double peak = 0.0;
  for (std::size_t row = 0; row < out.at("t").size(); ++row)
  {
    if (out.at("contact")[row] == 1.0)
    {
      const double ratio =
        std::hypot(out.at("force_x")[row], out.at("force_y")[row]) / out.at("force_z")[row];
      peak = std::max(peak, ratio);
      if (out.at("t")[row] > 0.5)
      {
        ASSERT_NEAR(ratio, 0.3, 0.003) << out.at("t")[row];
        ASSERT_LT(out.at("force_x")[row], 0.0) << "friction pulls back";
      }
    }
  }
  EXPECT_GT(peak, 0.37);
  EXPECT_LE(peak, 0.405);
}

TEST_F(Feel, DynamicFrictionAloneSetsTheStaticOne)
{
  this->succeed({ "generate", "plane", "-n", "20000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0,-0.02,0,0.001\n0.2,-0.02,0,-0.001\n1.2,0.02,0,-0.001\n");
  const Table out = this->feel("plane.ply", "hip.csv", { "--mu-d", "0.3" });
  EXPECT_NEAR(-out.at("force_x").back() / out.at("force_z").back(), 0.3, 0.003);
}

TEST_F(Feel, APresetWithoutItsMethodIsWarnedOf)
{
  this->succeed({ "generate", "plane", "-n", "5000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.002\n0.01,0,0,0.001\n");
  const std::vector<std::string> words = { "feel", "plane.ply", "--path", "hip.csv", "-o", "out.csv" };
  const auto errorsWith = [&](std::vector<std::string> options)
  {
    options.insert(options.begin(), words.begin(), words.end());
    const auto outcome = this->run(options);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    return outcome.errors;
  };
  EXPECT_NE(errorsWith({ "--preset", "tuned" }).find("--method gradient-steps"), std::string::npos);
  EXPECT_EQ(errorsWith({ "--preset", "paper", "--method", "gradient-steps" }), "");
  EXPECT_EQ(errorsWith({}), "");
}

TEST_F(Feel, TheSummaryTellsTicksContactForceAndTime)
{
  this->succeed({ "generate", "plane", "-n", "20000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.002\n0.2,0,0,-0.001\n");
  const nlohmann::json summary = nlohmann::json::parse(
    this->succeed({ "feel", "plane.ply", "--path", "hip.csv", "-o", "out.csv", "--json" }));
  EXPECT_EQ(summary["ticks"], 201);
  EXPECT_NEAR(summary["contact_ticks"].get<double>(), 67.0, 1.0);
  EXPECT_NEAR(summary["max_force_n"].get<double>(), 0.8, 1e-6);
  EXPECT_LE(summary["update_us"]["p50"].get<double>(), summary["update_us"]["max"].get<double>());
}

TEST_F(Feel, TransformAndPathShareTheWorkspaceFrame)
{
  this->succeed({ "generate", "sphere", "-n", "100000", "-o", "sphere.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0.5,0,0.05\n0.2,0.5,0,0.039\n");
  // The paper's second sphere: radius 0.04, here also moved.
  const Table out = this->feel("sphere.ply", "hip.csv", { "--scale", "1.6", "--translate", "0.5,0,0" });
  EXPECT_EQ(out.at("contact").back(), 1.0);
  EXPECT_NEAR(out.at("proxy_z").back(), 0.04, 1e-6);
  const Table raw =
    this->feel("sphere.ply", "hip.csv", { "--scale", "1.6", "--translate", "0.5,0,0", "--raw" });
  EXPECT_NEAR(raw.at("proxy_z").back(), 0.04, 1e-6);
}

TEST_F(Feel, ATableOfForcesIsAPathAgain)
{
  this->succeed({ "generate", "sphere", "-n", "20000", "-o", "sphere.ply" });
  this->write("hip.csv", "t,x,y,z\n0.3,0,0.001,0.03\n0.5,0.0007,0,0.021\n");
  this->feel("sphere.ply", "hip.csv");
  const std::string felt = this->read("out.csv");
  this->write("felt.csv", felt);
  const Table again = this->feel("sphere.ply", "felt.csv");
  EXPECT_EQ(again.at("t").size(), 201u);
  EXPECT_EQ(again.at("contact").back(), 1.0);
  EXPECT_EQ(withoutTimes(this->read("out.csv")), withoutTimes(felt));
}

TEST_F(Feel, ATraceOfTheViewerIsAPathOfBoth)
{
  this->succeed({ "generate", "sphere", "-n", "20000", "-o", "sphere.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0,0.001,0.03\n0.1,0.0007,0,0.021\n");
  const auto view = [this](const std::string& path, const std::string& trace)
  {
    return this->run({ "view", "sphere.ply", "--unit", "m", "--size", "64x48", "--path", path, "--screenshot",
      "picture.png", "--trace", trace });
  };
  const apptest::Outcome outcome = view("hip.csv", "trace.csv");
  if (outcome.errors.find("DISPLAY") != std::string::npos)
  {
    GTEST_SKIP() << outcome.errors;
  }
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  const std::string trace = this->read("trace.csv");
  ASSERT_EQ(parseTable(trace).at("t").size(), 101u);
  EXPECT_EQ(parseTable(trace).at("contact").back(), 1.0);
  ASSERT_EQ(view("trace.csv", "again.csv").exitCode, 0);
  EXPECT_EQ(withoutTimes(this->read("again.csv")), withoutTimes(trace));
  const Table felt = this->feel("sphere.ply", "trace.csv");
  for (const char* column : { "t", "hip_x", "hip_y", "hip_z" })
  {
    EXPECT_EQ(felt.at(column), parseTable(trace).at(column)) << column;
  }
  this->feel("sphere.ply", "hip.csv");
  this->write("felt.csv", this->read("out.csv"));
  ASSERT_EQ(view("felt.csv", "again.csv").exitCode, 0);
  EXPECT_EQ(withoutTimes(this->read("again.csv")), withoutTimes(trace));
}

TEST_F(Feel, ASimulatedHandYieldsToTheForceOnItsPath)
{
  this->succeed({ "generate", "plane", "-n", "100000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.01\n0.2,0,0,-0.005\n2,0,0,-0.005\n");
  const Table out = this->feel("plane.ply", "hip.csv", { "--device", "simulated" });
  // A person of 200 N/m who wants to be 5 mm below a wall of 800 N/m rests at 1 mm.
  EXPECT_NEAR(out.at("hip_z").back(), -0.001, 1e-6);
  EXPECT_NEAR(out.at("force_z").back(), 0.8, 1e-3);
  EXPECT_NEAR(out.at("t").back(), 2.0, 1e-9);
}

TEST_F(Feel, DevicesAndPathsThatDoNotFitAreRefused)
{
  this->succeed({ "generate", "plane", "-n", "20000", "-o", "plane.ply" });
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.01\n0.2,0,0,-0.005\n");
  this->refuse(2, { "feel", "plane.ply", "-o", "out.csv" }, { "--path", "--device falcon" });
  this->refuse(2, { "feel", "plane.ply", "--path", "hip.csv", "--device", "falcon", "-o", "out.csv" },
    { "--path hip.csv", "leave out" });
  this->refuse(1,
    { "feel", "plane.ply", "--path", "hip.csv", "--device", "simulated", "--stiffness", "20000", "-o",
      "out.csv" },
    { "20000 N/m", "at most 18000 N/m" });
  EXPECT_FALSE(this->exists("out.csv"));
}

TEST_F(Feel, CountsPointsThatAreInvalidOrDidNotReturn)
{
  this->succeed({ "generate", "sphere", "-n", "2000", "-o", "sphere.csv" });
  const auto feel = [&](std::vector<std::string> more)
  {
    std::vector<std::string> words = { "feel", "in.csv", "--path", kSpherePath, "-o", "out.csv" };
    words.insert(words.end(), more.begin(), more.end());
    return this->run(words);
  };
  this->write(
    "in.csv", this->read("sphere.csv") + "nan,0,0,0,0,1\n0,0,0,0,0,1\n0,0,0,0,0,1\n1,2,inf,0,0,1\n");
  for (const std::vector<std::string>& more : { std::vector<std::string>{}, { "--raw" }, { "--fit" } })
  {
    const apptest::Outcome outcome = feel(more);
    EXPECT_EQ(outcome.output.rfind("2 points are NaN or infinite and left out\n", 0), 0u) << outcome.output;
    EXPECT_NE(
      outcome.errors.find("warning: in.csv: 2 points at (0, 0, 0), which scanners write for rays without "
                          "return, are felt\n"),
      std::string::npos)
      << outcome.errors;
  }
  EXPECT_EQ(nlohmann::json::parse(feel({ "--json" }).output)["points_invalid"], 2);
  this->write("in.csv", this->read("sphere.csv"));
  EXPECT_EQ(feel({}).output.find("NaN"), std::string::npos);
  EXPECT_EQ(feel({}).errors, "");
}

TEST_F(Feel, AMeshIsClosedUnlessItsVerticesAreAskedFor)
{
  this->write("box.off",
    "OFF\n8 6 0\n-.03 -.02 -.005\n.03 -.02 -.005\n.03 .02 -.005\n-.03 .02 -.005\n-.03 -.02 .005\n.03 -.02 "
    ".005\n.03 .02 .005\n-.03 .02 .005\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 "
    "7\n");
  this->write("path.csv", "t,x,y,z\n0,.01,.005,.01\n.5,.01,.005,.003\n1.5,-.02,-.01,.003\n");
  apptest::Outcome outcome = this->run({ "feel", "box.off", "--path", "path.csv", "-o", "out.csv" });
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.errors.find("box.off: 200,000 samples of 6 faces"), std::string::npos) << outcome.errors;
  const Table table = parseTable(this->read("out.csv"));
  int held = 0;
  for (std::size_t row = 500; row < table.at("t").size(); ++row)
  {
    const Vec3 force = vectorOf(table, "force", row);
    held += norm(force - Vec3(0.0, 0.0, 0.002 * kStiffness)) < 0.05 * 0.002 * kStiffness ? 1 : 0;
  }
  EXPECT_EQ(held, 1001);
  outcome = this->run({ "feel", "box.off", "--vertices", "--path", "path.csv", "-o", "out.csv" });
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.errors.find("the points are the vertices of 6 faces"), std::string::npos)
    << outcome.errors;
  EXPECT_EQ(parseTable(this->read("out.csv")).at("contact").back(), 0.0);
}

TEST_F(Feel, ACloudWhoseUnitWasChosenIsNotDoubted)
{
  this->write("cloud.xyz", "50 0 0\n50 0 1\n50 1 0\n50 1 1\n");
  this->write("hip.csv", "t,x,y,z\n0,0,0,0.03\n0.05,0,0,0.029\n");
  const auto errorsOf = [this](std::vector<std::string> more)
  {
    more.insert(more.begin(), { "feel", "cloud.xyz", "--path", "hip.csv", "-o", "out.csv", "--force" });
    return this->run(more).errors;
  };
  EXPECT_NE(errorsOf({}).find("give --unit"), std::string::npos) << errorsOf({});
  EXPECT_EQ(errorsOf({ "--unit", "m" }).find("give --unit"), std::string::npos);
}

} // namespace
