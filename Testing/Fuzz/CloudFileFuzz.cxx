// Any bytes as a point cloud file. With POINTHAPTICS_BUILD_FUZZERS this becomes libFuzzer programs, one for
// all formats and one for each that has a corpus of its own; the test Fuzz.CloudFiles replays the same
// function on the files of Data/Fuzz.
//
// What must hold: either points, or a message of one line with a cure and no points; and what was read can be
// written and read again.
#include "CloudFileFuzz.h"

#include "../Unit/IO/E57/E57File.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace
{

void ignoreEvent(vtkObject*, unsigned long, void*, void*) {}

void require(bool condition, const char* what)
{
  if (!condition)
  {
    std::fprintf(stderr, "broken promise: %s\n", what);
    std::abort();
  }
}

/// A folder in memory where there is one, removed at the end.
class Scratch
{
public:
  Scratch()
  {
    const std::filesystem::path memory = "/dev/shm";
    const std::filesystem::path root =
      std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    folder_ = root / ("pointhaptics-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~Scratch()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }

private:
  std::filesystem::path folder_;
};

#ifdef POINTHAPTICS_FUZZ_START
constexpr std::string_view kStart = POINTHAPTICS_FUZZ_START;
#else
constexpr std::string_view kStart;
#endif

/// How much of a cloud optimised file is read: down to a resolution, to a number of points, in a box.
struct Part
{
  double resolution = 0.0;
  vtkIdType mostPoints = 0;
  double box[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
};
const Part kParts[] = { { 8.0 }, { 0.0, 50 }, { 0.0, 0, { 0.0, 600.0, 0.0, 600.0, 0.0, 600.0 } } };

vtkSmartPointer<vtkPolyData> read(const std::string& path, std::string& error, const Part& part = {})
{
  vtkNew<vtkCallbackCommand> silence;
  silence->SetCallback(&ignoreEvent);
  vtkNew<vtkPointCloudReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, silence);
  reader->SetFileName(path.c_str());
  reader->SetResolution(part.resolution);
  reader->SetMostPoints(part.mostPoints);
  reader->SetBox(part.box);
  reader->Update();
  error = reader->GetErrorMessage();
  return reader->GetOutput();
}

/// LAS holds no others.
vtkIdType finitePoints(vtkPolyData* cloud)
{
  vtkIdType count = 0;
  double p[3];
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    cloud->GetPoint(i, p);
    count += std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  }
  return count;
}

void writeAndReadAgain(vtkPolyData* cloud, const std::string& path)
{
  vtkNew<vtkCallbackCommand> silence;
  silence->SetCallback(&ignoreEvent);
  vtkNew<vtkPointCloudWriter> writer;
  writer->AddObserver(vtkCommand::ErrorEvent, silence);
  writer->SetInputData(cloud);
  writer->SetFileName(path.c_str());
  const bool isWritten = writer->Write() == 1;
  require(isWritten == std::string(writer->GetErrorMessage()).empty(), "writing fails with a message only");
  if (!isWritten)
  {
    return; // LAS holds no more than 65535 bytes per point
  }
  // LAS rounds coordinates, and that may pass the 1e30 which the reader takes for damage.
  constexpr double kFarFromTheLimit = 9e29;
  double bounds[6];
  cloud->GetBounds(bounds);
  for (const double bound : bounds)
  {
    if (std::abs(bound) > kFarFromTheLimit)
    {
      return;
    }
  }
  std::string error;
  const vtkSmartPointer<vtkPolyData> again = read(path, error);
  const bool isLas = path.find(".las") != std::string::npos || path.find(".laz") != std::string::npos;
  const vtkIdType written = isLas ? finitePoints(cloud) : cloud->GetNumberOfPoints();
  require(again->GetNumberOfPoints() == written, "what was written can be read");
}

/// @return the points; none where they were refused.
vtkSmartPointer<vtkPolyData> readAsPromised(const std::string& path, const Part& part = {})
{
  std::string error;
  vtkSmartPointer<vtkPolyData> cloud = read(path, error, part);
  require(error.empty() == (cloud->GetNumberOfPoints() > 0), "either points or a message");
  require(error.find('\n') == std::string::npos, "a message of one line");
  require(error.empty() || error.find("; ") != std::string::npos, "a message with a cure");
  return cloud;
}

/// An E57 file with right checksums and length: no change would get past these.
std::string mended(const std::string& bytes)
{
  constexpr std::size_t kLengthAt = 16;
  if (bytes.compare(0, 8, "ASTM-E57") != 0 || bytes.size() < kLengthAt + sizeof(std::uint64_t))
  {
    return bytes;
  }
  std::string logical = e57Logical(bytes);
  const std::uint64_t size = e57Physical(logical).size();
  logical.replace(kLengthAt, sizeof(size), reinterpret_cast<const char*>(&size), sizeof(size));
  return e57Physical(logical);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
  static const Scratch scratch;
  const std::string path = scratch.path("cloud");
  if (std::string_view(reinterpret_cast<const char*>(data), size).substr(0, kStart.size()) != kStart)
  {
    return 0; // another format
  }
  std::ofstream(path, std::ios::binary) << mended(std::string(reinterpret_cast<const char*>(data), size));
  const vtkSmartPointer<vtkPolyData> cloud = readAsPromised(path);
  if (size > 377 && data[377] == 'c') // the record that cloud optimised files begin with
  {
    for (const Part& part : kParts)
    {
      readAsPromised(path, part);
    }
  }
  constexpr vtkIdType kMostWritten = 200;
  if (cloud->GetNumberOfPoints() > 0 && cloud->GetNumberOfPoints() <= kMostWritten)
  {
    for (const char* name : { "again.ply", "again.pcd", "again.las", "again.laz" })
    {
      writeAndReadAgain(cloud, scratch.path(name));
    }
  }
  return 0;
}
