#include "Benchmark/Bandwidth/Rivals/Rival.h"

#include "Benchmark/Harness/RivalModule.h"

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

constexpr RivalChoice<Rival> kRivals[] = {
#ifdef POINTHAPTICS_RIVAL_BANDWIDTH_PCL
  { "pcl", POINTHAPTICS_RIVAL_BANDWIDTH_PCL, nullptr },
#endif
#ifdef POINTHAPTICS_RIVAL_BANDWIDTH_NANOFLANN
  { "nanoflann", POINTHAPTICS_RIVAL_BANDWIDTH_NANOFLANN, nullptr },
#endif
  { "vtk", nullptr, makeVtkStaticPointLocator }
};

} // namespace

std::vector<std::string> rivalWords()
{
  return wordsOf(kRivals);
}

std::unique_ptr<Rival> makeRival(const std::string& word)
{
  return bench::makeRival(kRivals, word);
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
