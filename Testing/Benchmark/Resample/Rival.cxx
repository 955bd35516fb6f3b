#include "Benchmark/Resample/Rival.h"

#include <stdexcept>

#include <dlfcn.h>

namespace pointhaptics
{
namespace bench
{
namespace
{

struct Module
{
  const char* word;
  const char* file; ///< Found beside the program's libraries.
};

constexpr Module kModules[] = {
#ifdef POINTHAPTICS_RIVAL_PCL
  { "pcl", POINTHAPTICS_RIVAL_PCL },
#endif
#ifdef POINTHAPTICS_RIVAL_OPEN3D
  { "open3d", POINTHAPTICS_RIVAL_OPEN3D },
#endif
  { "vtk", nullptr } // linked already
};

/// The module stays loaded: libraries with threads and registries of their own do not unload well.
std::unique_ptr<Rival> makeFromModule(const Module& module)
{
  void* library = dlopen(module.file, RTLD_NOW | RTLD_LOCAL);
  void* symbol = library ? dlsym(library, kMakeRival) : nullptr;
  if (!symbol)
  {
    throw std::runtime_error(std::string("the rival ") + module.word + " cannot be loaded (" + dlerror() +
      "); leave it out with --rivals");
  }
  return std::unique_ptr<Rival>(reinterpret_cast<MakeRival>(symbol)());
}

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
    if (word == module.word)
    {
      return module.file ? makeFromModule(module) : makeVtkVoxelGrid();
    }
  }
  throw std::runtime_error("no rival is called " + word);
}

} // namespace bench
} // namespace pointhaptics
