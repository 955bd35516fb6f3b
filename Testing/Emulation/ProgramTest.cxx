// The program itself, on an emulated machine: it inherits umockdev's library and test bed.
#include "EmulatedFalcon.h"
#include "UnderUmockdev.h"

#include "../Unit/Devices/FalconBench.h"

#include "../Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{
constexpr const char* kDirections[] = {
  "   pushed to the right:", "   pushed up:", "   pushed towards you:"
};

/// The first line of @p text that begins with @p begin; empty where there is none.
std::string lineWith(const std::string& text, const std::string& begin)
{
  const std::size_t at = text.find("\n" + begin);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

class EmulatedMachine : public UnderUmockdev
{
protected:
  EmulatedMachine()
    : file(madeUpFirmware())
    , falcon(bed())
    , folder(std::filesystem::path(::testing::TempDir()) / ("pointhaptics-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(folder);
    falcon.with(
      [](FalconModel& model)
      {
        model.expectedFirmware = madeUpFirmware();
        model.hand.wanted = model.hand.position = falcon::kCenter + Vec3(0.0, 0.0, 0.030);
      });
  }
  ~EmulatedMachine() override { std::filesystem::remove_all(folder); }

  pid_t begin(std::vector<std::string> words)
  {
    words.insert(words.begin(), POINTHAPTICS_PROGRAM);
    const pid_t child = fork();
    if (child == 0)
    {
      std::vector<char*> arguments;
      for (std::string& word : words)
      {
        arguments.push_back(word.data());
      }
      arguments.push_back(nullptr);
      const int out = talk >= 0 ? talk : open(path("out.txt").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      std::signal(SIGPIPE, SIG_DFL); // as a shell starts it
      const int none = input >= 0 ? input : open("/dev/null", O_RDONLY);
      dup2(out, 1);
      dup2(out, 2);
      dup2(none, 0);
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    return child;
  }
  static int finish(pid_t child)
  {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int run(std::vector<std::string> words) { return finish(begin(std::move(words))); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string output() const { return read("out.txt"); }
  std::string read(const std::string& name) const
  {
    std::ifstream stream(path(name));
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  /// Once it pushes, nobody reads any more what the program says, and the device gives it something to say:
  /// it goes on, until it is asked to end, and lets go in order.
  void goOnWithoutAReader(std::vector<std::string> words)
  {
    falcon.plugIn();
    ASSERT_EQ(run({ "generate", "sphere", "-n", "20000", "-o", path("sphere.ply") }), 0) << output();
    int ends[2];
    ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
    talk = ends[1];
    words.insert(words.end(), { "--falcon-firmware", file.path() });
    const pid_t child = begin(std::move(words));
    close(ends[1]);
    const auto pushes = [&](int frames)
    {
      return falcon.with([&](FalconModel& model)
        { return (model.command.leds & kFalconLedGreen) != 0 && model.frames > frames; });
    };
    EXPECT_TRUE(eventually([&] { return pushes(300); }));
    close(ends[0]);
    const auto loseHoming = [](FalconModel& model)
    {
      model.homesByItself = false;
      model.loseHoming();
    };
    falcon.with(loseHoming); // "falcon: blue LED ..."
    EXPECT_TRUE(eventually([&] { return !pushes(0); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "it has ended";
    falcon.with([](FalconModel& model) { model.home(); });
    const int frames = falcon.with([](FalconModel& model) { return model.frames; });
    EXPECT_TRUE(eventually([&] { return pushes(frames + 50); }, 20.0));
    kill(child, SIGTERM);
    EXPECT_EQ(finish(child), 128 + SIGPIPE) << "nobody reads";
    falcon.with(
      [](FalconModel& model)
      {
        EXPECT_GE(model.frozenFrames, 3);
        EXPECT_EQ(model.command.leds, kFalconLedNone);
      });
    EXPECT_FALSE(falcon.claimed());
  }

  FirmwareFile file;
  int input = -1; ///< Standard input of the program; below 0: /dev/null.
  int talk = -1;  ///< Descriptor of its output; below 0: into out.txt.
  EmulatedFalcon falcon;
  std::filesystem::path folder;
};
}

TEST_F(EmulatedMachine, ListsItsFalcon)
{
  ASSERT_EQ(run({ "devices" }), 0) << output();
  EXPECT_EQ(output().find("falcon"), std::string::npos) << output();
  EXPECT_NE(output().find("no Falcon was found: plug in its power supply"), std::string::npos) << output();
  EXPECT_NE(output().find("simulated"), std::string::npos);
  falcon.plugIn();
  ASSERT_EQ(run({ "devices" }), 0) << output();
  EXPECT_NE(output().find("bus 1 device 2: can be used"), std::string::npos) << output();
  EXPECT_EQ(output().find("no Falcon"), std::string::npos) << output();
  EXPECT_NE(output().find("no SpaceMouse was found"), std::string::npos) << output();
}

TEST_F(EmulatedMachine, SaysWhatTheFirmwareIsWhereItIsMissing)
{
  falcon.plugIn();
  ASSERT_EQ(run({ "generate", "sphere", "-n", "2000", "-o", path("sphere.ply") }), 0) << output();
  const std::vector<std::string> feel = { "feel", path("sphere.ply"), "--device", "falcon", "-o",
    path("out.csv") };
  EXPECT_EQ(run(feel), 1);
  for (const char* part : { "licence", "--falcon-firmware", "POINTHAPTICS_FALCON_FIRMWARE" })
  {
    EXPECT_NE(output().find(part), std::string::npos) << output();
  }
  EXPECT_FALSE(std::filesystem::exists(path("out.csv"))) << "no half-made file";
}

TEST_F(EmulatedMachine, FeelsASphereUntilTheUserEndsItAndLetsGoInOrder)
{
  falcon.with([](FalconModel& model) { model.homesByItself = false; });
  falcon.plugIn();
  ASSERT_EQ(run({ "generate", "sphere", "-n", "40000", "-o", path("sphere.ply") }), 0) << output();
  const pid_t child = begin({ "feel", path("sphere.ply"), "--device", "falcon", "--falcon-firmware",
    file.path(), "-o", path("out.csv") });
  // The person homes it when asked to.
  ASSERT_TRUE(eventually([&] { return output().find("blue LED") != std::string::npos; })) << output();
  falcon.with([](FalconModel& model) { model.home(); });
  ASSERT_TRUE(eventually(
    [&]
    {
      return falcon.with(
        [](FalconModel& model) { return (model.command.leds & kFalconLedGreen) != 0 && model.frames > 20; });
    }))
    << output();
  const int homed = falcon.with([](FalconModel& model) { return model.frames; });
  // Again where the machine stood still for a second on the way: the loop then takes the hand as new, inside.
  const auto touches = [&]
  {
    falcon.with(
      [](FalconModel& model)
      {
        model.hand.position = falcon::kCenter + Vec3(0.0, 0.0, 0.030);
        model.hand.velocity = {};
        model.hand.wanted = falcon::kCenter + Vec3(0.0, 0.0, 0.019);
      });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return falcon.with([](FalconModel& model) { return model.force.z > 0.02; });
  };
  EXPECT_TRUE(touches() || touches() || touches()) << output();
  // 200 N/m towards 6 mm below the surface against 800 N/m: at rest at 1.2 mm, where both give 0.96 N.
  const double expected = 0.025 - 0.0012;
  EXPECT_TRUE(eventually(
    [&]
    {
      return falcon.with(
        [&](FalconModel& model)
        {
          return std::abs(model.hand.position.z - falcon::kCenter.z - expected) < 60e-6 &&
            norm(model.hand.velocity) < 1e-4 && std::abs(model.force.z - 0.96) < 0.03;
        });
    }))
    << output();
  EXPECT_TRUE(
    eventually([&] { return falcon.with([&](FalconModel& model) { return model.frames > homed + 600; }); }));
  kill(child, SIGINT);
  EXPECT_EQ(finish(child), 0) << output();
  falcon.with(
    [](FalconModel& model)
    {
      EXPECT_GE(model.frozenFrames, 3) << "commands without force, answered";
      EXPECT_EQ(model.command.leds, kFalconLedNone);
    });
  EXPECT_FALSE(falcon.claimed());
  const std::string table = read("out.csv");
  EXPECT_EQ(table.rfind("t,hip_x,", 0), 0u);
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 500);
}

TEST_F(EmulatedMachine, TheWindowFeelsWithTheFalconAndLetsGoInOrder)
{
  SKIP_WITHOUT_DISPLAY();
  falcon.plugIn();
  ASSERT_EQ(run({ "generate", "sphere", "-n", "20000", "-o", path("sphere.ply") }), 0) << output();
  const pid_t child = begin({ "view", path("sphere.ply"), "--device", "auto", "--falcon-firmware",
    file.path(), "--size", "320x240" });
  EXPECT_TRUE(eventually(
    [&]
    {
      return falcon.with(
        [](FalconModel& model) { return (model.command.leds & kFalconLedGreen) != 0 && model.frames > 300; });
    }))
    << output();
  kill(child, SIGTERM);
  EXPECT_EQ(finish(child), 128 + SIGTERM) << output();
  falcon.with(
    [](FalconModel& model)
    {
      EXPECT_GE(model.frozenFrames, 3);
      EXPECT_EQ(model.command.leds, kFalconLedNone);
    });
  EXPECT_NE(output().find("falcon: green LED"), std::string::npos) << output();
}

TEST_F(EmulatedMachine, FeelingGoesOnWhenNobodyReadsWhatItSays)
{
  goOnWithoutAReader({ "feel", path("sphere.ply"), "--device", "falcon", "-o", path("out.csv") });
  const std::string table = read("out.csv");
  EXPECT_EQ(table.rfind("t,hip_x,", 0), 0u);
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 100) << "what was felt is there";
}

TEST_F(EmulatedMachine, TheWindowGoesOnWhenNobodyReadsWhatItSays)
{
  SKIP_WITHOUT_DISPLAY();
  goOnWithoutAReader({ "view", path("sphere.ply"), "--device", "auto", "--size", "320x240" });
}

TEST_F(EmulatedMachine, RefusesASpringTheFalconCannotBear)
{
  falcon.plugIn();
  ASSERT_EQ(run({ "generate", "sphere", "-n", "2000", "-o", path("sphere.ply") }), 0) << output();
  EXPECT_EQ(run({ "feel", path("sphere.ply"), "--device", "falcon", "--falcon-firmware", file.path(),
              "--stiffness", "3000", "-o", path("out.csv") }),
    1);
  EXPECT_NE(output().find("at most 1666 N/m"), std::string::npos) << output();
}

TEST_F(EmulatedMachine, DiagnosesAFalconAndWritesTheReport)
{
  falcon.plugIn();
  falcon.with([](FalconModel& model) { model.hand.wanted = model.hand.position = falcon::kCenter; });
  ASSERT_EQ(run({ "devices", "--diagnose", "--yes", "--falcon-firmware", file.path(), "--report",
              path("report.txt") }),
    0)
    << output();
  const std::string report = read("report.txt");
  for (const char* part :
    { "1. LEDs", "homing bits 111", "\n   homed\n", "3. Encoders", "4. Rate", "0 timeouts", "5. Motors" })
  {
    EXPECT_NE(report.find(part), std::string::npos) << part << "\n" << report;
  }
  // The model's motors push where they should, with no more than was promised.
  EXPECT_EQ(report.find("NOT"), std::string::npos) << report;
  for (const char* direction : kDirections)
  {
    EXPECT_TRUE(endsWith(lineWith(report, direction), ": as expected")) << direction << "\n" << report;
  }
  EXPECT_LT(falcon.with([](FalconModel& model) { return model.largestForce; }), 0.51);
}

TEST_F(EmulatedMachine, FindsMotorsThatPushTheWrongWay)
{
  falcon.plugIn();
  falcon.with(
    [](FalconModel& model)
    {
      model.hand.wanted = model.hand.position = falcon::kCenter;
      model.motorSign = -1.0;
    });
  EXPECT_EQ(run({ "devices", "--diagnose", "--yes", "--falcon-firmware", file.path(), "--report",
              path("report.txt") }),
    1);
  const std::string report = read("report.txt");
  for (const char* direction : kDirections)
  {
    EXPECT_TRUE(endsWith(lineWith(report, direction), ": NOT as expected")) << direction << "\n" << report;
  }
  EXPECT_NE(output().find("3 checks found something wrong"), std::string::npos) << output();
}

TEST_F(EmulatedMachine, EndsADiagnosisThatWaitsForAnAnswer)
{
  falcon.plugIn();
  int answers[2];
  ASSERT_EQ(pipe(answers), 0); // nobody answers
  input = answers[0];
  const pid_t child =
    begin({ "devices", "--diagnose", "--falcon-firmware", file.path(), "--report", path("report.txt") });
  EXPECT_TRUE(eventually([&] { return output().find("Which LED is on?") != std::string::npos; })) << output();
  kill(child, SIGINT);
  EXPECT_EQ(finish(child), 130) << output();
  close(answers[0]);
  close(answers[1]);
  EXPECT_NE(read("report.txt").find("stopped on request"), std::string::npos);
}

TEST_F(EmulatedMachine, EndsAStartThatNobodyAnswers)
{
  falcon.plugIn();
  falcon.with([](FalconModel& model) { model.deafGreetings = 1 << 30; });
  ASSERT_EQ(run({ "generate", "sphere", "-n", "2000", "-o", path("sphere.ply") }), 0) << output();
  const pid_t child = begin({ "feel", path("sphere.ply"), "--device", "falcon", "--falcon-firmware",
    file.path(), "-o", path("out.csv") });
  EXPECT_TRUE(eventually(
    [&] { return falcon.with([](FalconModel& model) { return model.deafGreetings < (1 << 30) - 2; }); }));
  kill(child, SIGINT);
  EXPECT_EQ(finish(child), 130) << output();
  EXPECT_LT((1 << 30) - falcon.with([](FalconModel& model) { return model.deafGreetings; }), 100);
  EXPECT_FALSE(falcon.claimed());
}

TEST_F(EmulatedMachine, TheWindowOpensWithoutTheFirmwareOnASimulatedHand)
{
  SKIP_WITHOUT_DISPLAY();
  falcon.plugIn();
  ASSERT_EQ(run({ "generate", "sphere", "-n", "2000", "-o", path("sphere.ply") }), 0) << output();
  const pid_t child =
    begin({ "view", path("sphere.ply"), "--size", "320x240", "--trace", path("trace.csv") });
  EXPECT_TRUE(
    eventually([&] { return output().find("the simulated hand takes its place") != std::string::npos; }))
    << output();
  kill(child, SIGTERM);
  EXPECT_EQ(finish(child), 128 + SIGTERM) << output();
  EXPECT_NE(output().find("--falcon-firmware"), std::string::npos) << output();
  EXPECT_NE(output().find("trace: "), std::string::npos) << "the window was there\n" << output();
}

TEST_F(EmulatedMachine, SaysOnceWhatAReplugMisses)
{
  falcon.plugIn();
  ASSERT_EQ(run({ "generate", "sphere", "-n", "2000", "-o", path("sphere.ply") }), 0) << output();
  const pid_t child = begin({ "feel", path("sphere.ply"), "--device", "falcon", "--falcon-firmware",
    file.path(), "-o", path("out.csv") });
  EXPECT_TRUE(eventually([&] { return output().find("green LED") != std::string::npos; })) << output();
  falcon.unplug();
  EXPECT_TRUE(eventually([&] { return output().find("0403:cb48") != std::string::npos; })) << output();
  std::this_thread::sleep_for(std::chrono::milliseconds(1200)); // two more looks for it
  falcon.refuseClaims(EBUSY);
  falcon.plugIn();
  EXPECT_TRUE(eventually([&] { return output().find("another program") != std::string::npos; })) << output();
  kill(child, SIGINT);
  EXPECT_EQ(finish(child), 0) << output();
  const std::string said = output();
  EXPECT_EQ(said.find("0403:cb48"), said.rfind("0403:cb48")) << said;
  EXPECT_EQ(said.find("not there"), std::string::npos) << said;
  EXPECT_EQ(said.find("lost;"), said.rfind("lost;")) << said;
}
