#include "Benchmark/Resample/Rival.h"

#include "Benchmark/RivalModule.h"

#include <stdexcept>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

struct Module
{
  const char* word;
  const char* file;
};

constexpr Module kModules[] = {
#ifdef POINTHAPTICS_RIVAL_RESAMPLE_PCL
  { "pcl", POINTHAPTICS_RIVAL_RESAMPLE_PCL },
#endif
#ifdef POINTHAPTICS_RIVAL_RESAMPLE_OPEN3D
  { "open3d", POINTHAPTICS_RIVAL_RESAMPLE_OPEN3D },
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
      return makeVtkVoxelGrid();
    }
  }
  throw std::runtime_error("no rival is called " + word);
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
