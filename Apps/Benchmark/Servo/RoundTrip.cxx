#include "Benchmark/Servo/RoundTrip.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace pointhaptics
{
namespace bench
{
namespace servo
{
namespace
{

/// What @p command prints; empty where it fails.
std::string outputOf(const std::string& command)
{
  std::string text;
  FILE* const pipe = popen(command.c_str(), "r");
  char buffer[512];
  while (pipe && std::fgets(buffer, sizeof(buffer), pipe))
  {
    text += buffer;
  }
  return pipe && pclose(pipe) == 0 ? text : std::string();
}

std::string quoted(const std::string& path)
{
  std::string result = "'";
  for (const char c : path)
  {
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result + "'";
}

} // namespace

bool roundTripStudy(double seconds, ReportPart& part, bool& right)
{
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path program = self.parent_path() / kRoundTripProgram;
  if (error || !std::filesystem::exists(program, error))
  {
    return false;
  }
  part.key = "round_trip";
  part.title = "Round trip against an emulated Falcon";
  part.text = fmt::format(
    "From the driver's command to its whole answer, one a millisecond for {:g} s, through the real libusb: "
    "umockdev hands its transfers to the emulated Falcon over a socket, and there is no wire. A real one "
    "adds "
    "what full-speed USB takes, frames of 1 ms. The thread has no real-time priority.",
    seconds);
  part.table.header = { "exchanges", "us: p50 / p99 / p99.9 / max", "later than 100 ms", "answers" };
  const nlohmann::ordered_json found = nlohmann::ordered_json::parse(
    outputOf(quoted(program.string()) + " " + std::to_string(seconds)), nullptr, false);
  if (!found.is_object())
  {
    right = false;
    part.remarks.push_back("The program that measures it failed; run it by hand: " + program.string());
    return true;
  }
  const bool isRight = found["exchanges"] > 0 && found["wrong"] == 0;
  const auto microseconds = [&](const char* name) { return brief(1e6 * found[name].get<double>()); };
  part.table.rows.push_back({ grouped(found["exchanges"].get<long long>()),
    fmt::format("{} / {} / {} / {}", microseconds("p50"), microseconds("p99"), microseconds("p999"),
      microseconds("max")),
    grouped(found["lost"].get<long long>()), isRight ? "right" : "wrong" });
  part.rows.push_back({ { "exchanges", found["exchanges"] }, { "lost", found["lost"] },
    { "round_trip_seconds",
      { { "p50", found["p50"] }, { "p99", found["p99"] }, { "p999", found["p999"] },
        { "max", found["max"] } } },
    { "right", isRight } });
  right = right && isRight;
  return true;
}

} // namespace servo
} // namespace bench
} // namespace pointhaptics
