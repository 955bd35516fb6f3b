#include "Benchmark/Io/Rival.h"

#include "Benchmark/Harness/RivalModule.h"

namespace pointhaptics
{
namespace bench
{
namespace io
{
namespace
{

constexpr RivalChoice<Rival> kRivals[] = {
#ifdef POINTHAPTICS_RIVAL_IO_PCL
  { "pcl", POINTHAPTICS_RIVAL_IO_PCL, nullptr },
#endif
  { "vtk", nullptr, makeVtk }
};

} // namespace

const char* nameOf(FileKind kind)
{
  switch (kind)
  {
    case FileKind::BinaryPly:
      return "PLY binary";
    case FileKind::AsciiPly:
      return "PLY ascii";
    case FileKind::BinaryPcd:
      return "PCD binary";
    case FileKind::CompressedPcd:
      return "PCD compressed";
    case FileKind::AsciiPcd:
      return "PCD ascii";
    case FileKind::Csv:
      return "CSV";
    case FileKind::Xyz:
      return "XYZ";
    case FileKind::Las:
      return "LAS";
    case FileKind::Laz:
      return "LAZ";
    case FileKind::E57:
      return "E57";
    case FileKind::Vtp:
      return "VTP";
  }
  return "";
}

std::vector<std::string> rivalWords()
{
  return wordsOf(kRivals);
}

std::unique_ptr<Rival> makeRival(const std::string& word)
{
  return bench::makeRival(kRivals, word);
}

} // namespace io
} // namespace bench
} // namespace pointhaptics
