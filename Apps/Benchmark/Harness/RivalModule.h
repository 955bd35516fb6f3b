/// @file
/// Rivals' libraries are loaded when a benchmark runs, from modules of their own: the program's other
/// commands shall not load them. pointhaptics_benchmark_rival() of CMake builds the modules.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace pointhaptics::bench
{

/// Name of the export of a rival's module: an extern "C" function without arguments that makes the rival.
/// Each task has a face of its own for rivals: the function returns a pointer to a new one, the caller's.
constexpr const char* kMakeRival = "pointhapticsMakeRival";

/// That function of the module in @p file, which is found beside the program's libraries. @p word names the
/// rival in messages. Throws std::runtime_error where it cannot be loaded. The module stays loaded: libraries
/// with threads and registries of their own do not unload well.
void* loadRivalModule(const std::string& file, const std::string& word);

/// A rival's word on the command line and its module's file.
struct RivalFile
{
  std::string word;
  std::string file;
};

inline std::vector<std::string> wordsOf(const std::vector<RivalFile>& files)
{
  std::vector<std::string> words;
  for (const RivalFile& one : files)
  {
    words.push_back(one.word);
  }
  return words;
}

/// Throws std::runtime_error where the module cannot be loaded. @pre @p word is among the words of @p files.
template <class Rival>
std::unique_ptr<Rival> makeRival(const std::vector<RivalFile>& files, const std::string& word)
{
  for (const RivalFile& one : files)
  {
    if (one.word == word)
    {
      using Make = Rival* (*)();
      return std::unique_ptr<Rival>(reinterpret_cast<Make>(loadRivalModule(one.file, word))());
    }
  }
  throw std::runtime_error("no rival is called " + word);
}

} // namespace pointhaptics::bench
