// Signals sent to the real program in the middle of its work.
#include "RunProgram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

namespace
{

using namespace pointhaptics;
using apptest::Outcome;

/// How a program runs on until it is stopped: long enough for most machines, then longer and longer.
constexpr const char* kSizes[] = { "200000", "800000", "3200000", "12800000" };

class Stop : public apptest::CommandLine
{
protected:
  /// Sends @p signal to the program once @p isTime(process).
  Outcome runAndStop(
    const std::vector<std::string>& arguments, int signal, const std::function<bool(pid_t)>& isTime) const
  {
    const pid_t child = this->start(arguments);
    while (!isTime(child) && !hasEnded(child))
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(child, signal);
    return this->finish(child);
  }
  std::ptrdiff_t unfinishedFiles() const
  {
    const std::vector<std::string> names = this->files();
    return std::count_if(names.begin(), names.end(),
      [](const std::string& name) { return name.find(".part") != std::string::npos; });
  }
  /// True if the program remembers SIGINT by now.
  static bool remembers(pid_t child)
  {
    const std::string mask = statusOf(child, "SigCgt:");
    return !mask.empty() && (std::stoull(mask, nullptr, 16) >> (SIGINT - 1) & 1) != 0;
  }
  static bool hasEnded(pid_t child) { return statusOf(child, "State:").rfind("Z", 0) == 0; }

  void expectStopped(const Outcome& outcome, int exitCode, const std::string& said) const
  {
    EXPECT_EQ(outcome.exitCode, exitCode);
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find(said), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("stopped on request"), std::string::npos) << outcome.errors;
  }

private:
  static std::string statusOf(pid_t child, const std::string& field)
  {
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    std::string word;
    while (status >> word)
    {
      if (word == field)
      {
        status >> word;
        return word;
      }
    }
    return {};
  }
};

TEST_F(Stop, InTheMiddleOfWritingLeavesNoFileBehind)
{
  for (const int signal : { SIGINT, SIGTERM })
  {
    Outcome outcome;
    for (const char* size : kSizes)
    {
      this->write("out.csv", "old");
      outcome = this->runAndStop({ "generate", "sphere", "-n", size, "-o", "out.csv" }, signal,
        [this](pid_t) { return this->unfinishedFiles() > 0; });
      if (outcome.exitCode != 0)
      {
        break;
      }
    }
    this->expectStopped(outcome, 128 + signal, "pointhaptics generate: out.csv: writing was");
    EXPECT_EQ(this->files(), std::vector<std::string>{ "out.csv" });
    EXPECT_EQ(this->read("out.csv"), "old");
  }
}

TEST_F(Stop, InTheMiddleOfReadingOrFilteringLeavesNoFileBehind)
{
  for (const char* command : { "bandwidth", "resample" })
  {
    Outcome outcome;
    for (const char* size : kSizes)
    {
      this->succeed({ "generate", "idol", "-n", size, "-o", "in.ply" });
      outcome = this->runAndStop({ command, "in.ply", "-o", "out.csv" }, SIGINT, &remembers);
      if (outcome.exitCode != 0)
      {
        break;
      }
    }
    this->expectStopped(outcome, 130, std::string("pointhaptics ") + command + ": ");
    EXPECT_EQ(this->files(), std::vector<std::string>{ "in.ply" });
  }
}

TEST_F(Stop, InTheMiddleOfFeelingLeavesNoFileBehind)
{
  this->succeed({ "generate", "sphere", "-n", "5000", "-o", "in.ply" });
  this->write("path.csv", "t,x,y,z\n0,0,0,0.03\n36000,0,0,0.02\n");
  for (const char* device : { "none", "simulated" })
  {
    const Outcome outcome = this->runAndStop(
      { "feel", "in.ply", "--unit", "m", "--path", "path.csv", "--device", device, "-o", "out.csv" }, SIGINT,
      [this](pid_t) { return this->unfinishedFiles() > 0; });
    this->expectStopped(outcome, 130, "pointhaptics feel: out.csv: feeling was");
    EXPECT_EQ(this->files(), (std::vector<std::string>{ "in.ply", "path.csv" }));
  }
}

/// Runs the program into a pipe whose reader ends at once, as `| head` does.
class Reader : public Stop
{
protected:
  Outcome runWithoutReader(const std::vector<std::string>& arguments) const
  {
    int ends[2];
    EXPECT_EQ(pipe2(ends, O_CLOEXEC), 0);
    close(ends[0]);
    const Outcome outcome = this->finish(this->start(arguments, ends[1]));
    close(ends[1]);
    return outcome;
  }
};

TEST_F(Reader, ThatEndsTakesNoFileFromTheUser)
{
  this->succeed({ "generate", "sphere", "-n", "5000", "-o", "in.ply" });
  this->write("path.csv", "t,x,y,z\n0,0,0,0.03\n0.1,0,0,0.02\n");
  const std::vector<std::string> commands[] = { { "generate", "sphere", "-n", "1000", "-o", "out.csv" },
    { "resample", "in.ply", "--unit", "m", "-o", "out.csv" },
    { "feel", "in.ply", "--unit", "m", "--path", "path.csv", "--device", "simulated", "-o", "out.csv" } };
  for (const std::vector<std::string>& command : commands)
  {
    SCOPED_TRACE(command[0]);
    this->write("out.csv", "old");
    const Outcome outcome = this->runWithoutReader(command);
    EXPECT_EQ(outcome.exitCode, 128 + SIGPIPE);
    EXPECT_EQ(outcome.errors, "");
    EXPECT_EQ(this->files(), (std::vector<std::string>{ "in.ply", "out.csv", "path.csv" }));
    EXPECT_NE(this->read("out.csv"), "old");
  }
}

TEST_F(Reader, ThatEndsInTheMiddleOfAStreamIsNoFault)
{
  this->succeed({ "generate", "sphere", "-n", "50000", "-o", "in.ply" });
  for (const char* format : { "csv", "ply", "las", "vtp" })
  {
    const Outcome outcome = this->runWithoutReader({ "convert", "in.ply", "-", "--output-format", format });
    EXPECT_EQ(outcome.exitCode, 128 + SIGPIPE) << format;
    EXPECT_EQ(outcome.errors, "") << format;
  }
  EXPECT_EQ(this->files(), std::vector<std::string>{ "in.ply" });
}

TEST_F(Stop, ByKillLeavesAPartThatTheNextWriteRemoves)
{
  Outcome outcome;
  for (const char* size : kSizes)
  {
    outcome = this->runAndStop({ "generate", "sphere", "-n", size, "-o", "out.csv" }, SIGKILL,
      [this](pid_t) { return this->unfinishedFiles() > 0; });
    if (outcome.exitCode != 0)
    {
      break;
    }
  }
  ASSERT_EQ(outcome.exitCode, 128 + SIGKILL);
  ASSERT_EQ(this->files(), std::vector<std::string>{ ".out.csv.1.part" });
  this->succeed({ "generate", "sphere", "-n", "10", "-o", "other.csv" });
  EXPECT_EQ(this->unfinishedFiles(), 1);
  this->succeed({ "generate", "sphere", "-n", "10", "-o", "out.csv" });
  EXPECT_EQ(this->files(), (std::vector<std::string>{ "other.csv", "out.csv" }));
}

} // namespace
