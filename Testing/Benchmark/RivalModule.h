/// @file
/// Rivals' libraries are loaded when a benchmark runs, from modules of their own: the program's other
/// commands shall not load them. pointhaptics_benchmark_rival() of CMake builds the modules.
#pragma once

#include <string>

namespace pointhaptics
{
namespace bench
{

/// What a rival's module exports: an extern "C" function without arguments that makes the rival. Each task
/// has a face of its own for rivals, so it is the task that knows what the function returns.
constexpr const char* kMakeRival = "pointhapticsMakeRival";

/// That function of the module in @p file, which is found beside the program's libraries. @p word names the
/// rival in messages. Throws std::runtime_error where it cannot be loaded. The module stays loaded: libraries
/// with threads and registries of their own do not unload well.
void* loadRivalModule(const std::string& file, const std::string& word);

} // namespace bench
} // namespace pointhaptics
