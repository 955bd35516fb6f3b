/// @file
/// Rivals' libraries are loaded when a benchmark runs, from modules of their own: the program's other
/// commands shall not load them. pointhaptics_benchmark_rival() of CMake builds the modules.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{

/// What a rival's module exports: an extern "C" function without arguments that makes the rival. Each task
/// has a face of its own for rivals: the function returns a pointer to a new one, the caller's.
constexpr const char* kMakeRival = "pointhapticsMakeRival";

/// That function of the module in @p file, which is found beside the program's libraries. @p word names the
/// rival in messages. Throws std::runtime_error where it cannot be loaded. The module stays loaded: libraries
/// with threads and registries of their own do not unload well.
void* loadRivalModule(const std::string& file, const std::string& word);

/// One rival of a task: made by a function that is linked already, or by the module in a file.
template <class Rival>
struct RivalChoice
{
  const char* word;
  const char* file;                 ///< Null where @p make is given.
  std::unique_ptr<Rival> (*make)(); ///< Null where @p file is given.
};

template <class Rival, std::size_t Count>
std::vector<std::string> wordsOf(const RivalChoice<Rival> (&choices)[Count])
{
  std::vector<std::string> words;
  for (const RivalChoice<Rival>& choice : choices)
  {
    words.emplace_back(choice.word);
  }
  return words;
}

/// Throws std::runtime_error where there is no such word or its module cannot be loaded.
template <class Rival, std::size_t Count>
std::unique_ptr<Rival> makeRival(const RivalChoice<Rival> (&choices)[Count], const std::string& word)
{
  for (const RivalChoice<Rival>& choice : choices)
  {
    if (word == choice.word)
    {
      using Make = Rival* (*)();
      return choice.make
        ? choice.make()
        : std::unique_ptr<Rival>(reinterpret_cast<Make>(loadRivalModule(choice.file, word))());
    }
  }
  throw std::runtime_error("no rival is called " + word);
}

} // namespace bench
} // namespace pointhaptics
