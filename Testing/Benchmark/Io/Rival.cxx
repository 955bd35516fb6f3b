#include "Benchmark/Io/Rival.h"

#include "Benchmark/RivalModule.h"

#include <stdexcept>

namespace pointhaptics
{
namespace bench
{
namespace io
{

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
    case FileKind::Vtp:
      return "VTP";
  }
  return "";
}

std::vector<std::string> rivalWords()
{
  return {
#ifdef POINTHAPTICS_RIVAL_IO_PCL
    "pcl",
#endif
    "vtk"
  };
}

std::unique_ptr<Rival> makeRival(const std::string& word)
{
#ifdef POINTHAPTICS_RIVAL_IO_PCL
  if (word == "pcl")
  {
    return std::unique_ptr<Rival>(
      reinterpret_cast<MakeRival>(loadRivalModule(POINTHAPTICS_RIVAL_IO_PCL, word))());
  }
#endif
  if (word == "vtk")
  {
    return makeVtk();
  }
  throw std::runtime_error("no rival is called " + word);
}

} // namespace io
} // namespace bench
} // namespace pointhaptics
