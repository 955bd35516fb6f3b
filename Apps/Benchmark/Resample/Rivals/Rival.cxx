#include "Benchmark/Resample/Rivals/Rival.h"

#include "Benchmark/Harness/RivalModule.h"

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

constexpr RivalChoice<Rival> kRivals[] = {
#ifdef POINTHAPTICS_RIVAL_RESAMPLE_PCL
  { "pcl", POINTHAPTICS_RIVAL_RESAMPLE_PCL, nullptr },
#endif
#ifdef POINTHAPTICS_RIVAL_RESAMPLE_OPEN3D
  { "open3d", POINTHAPTICS_RIVAL_RESAMPLE_OPEN3D, nullptr },
#endif
  { "vtk", nullptr, makeVtkVoxelGrid }
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

} // namespace resample
} // namespace bench
} // namespace pointhaptics
