#include "Benchmark/Bandwidth/Rival.h"

#include "Benchmark/RivalModule.h"

#include <stdexcept>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

struct Module
{
  const char* word;
  const char* file;
};

constexpr Module kModules[] = {
#ifdef POINTHAPTICS_RIVAL_BANDWIDTH_PCL
  { "pcl", POINTHAPTICS_RIVAL_BANDWIDTH_PCL },
#endif
#ifdef POINTHAPTICS_RIVAL_BANDWIDTH_NANOFLANN
  { "nanoflann", POINTHAPTICS_RIVAL_BANDWIDTH_NANOFLANN },
#endif
  { "vtk", nullptr } // linked already
};

} // namespace

std::vector<std::string> rivalWords()
{
  std::vector<std::string> words;
  for (const Module& module : kModules)
  {
    words.emplace_back(module.word);
  }
  return words;
}

std::unique_ptr<Rival> makeRival(const std::string& word)
{
  for (const Module& module : kModules)
  {
    if (word == module.word && module.file)
    {
      return std::unique_ptr<Rival>(reinterpret_cast<MakeRival>(loadRivalModule(module.file, word))());
    }
    if (word == module.word)
    {
      return makeVtkStaticPointLocator();
    }
  }
  throw std::runtime_error("no rival is called " + word);
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
