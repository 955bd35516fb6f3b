/// @file
/// Which seeds a fuzz test runs: the same ones every time, unless the environment asks for others.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace trial
{

struct FuzzRuns
{
  std::uint64_t first = number("POINTHAPTICS_FUZZ_SEED", 1);
  std::uint64_t count;

  explicit FuzzRuns(std::uint64_t usual)
    : count(number("POINTHAPTICS_FUZZ_RUNS", usual))
  {
  }
  static std::uint64_t number(const char* name, std::uint64_t otherwise)
  {
    const char* text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
  }
};

} // namespace trial
