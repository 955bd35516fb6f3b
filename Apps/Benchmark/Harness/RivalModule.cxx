#include "Benchmark/Harness/RivalModule.h"

#include <stdexcept>

#include <dlfcn.h>

namespace pointhaptics::bench
{

void* loadRivalModule(const std::string& file, const std::string& word)
{
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* symbol = library ? dlsym(library, kMakeRival) : nullptr;
  if (!symbol)
  {
    throw std::runtime_error(
      "the rival " + word + " cannot be loaded (" + dlerror() + "); leave it out with --rivals");
  }
  return symbol;
}

} // namespace pointhaptics::bench
