#include "Recording.h"

#include "PolyDataAccess.h"
#include "RecordingLines.h"
#include "VirtualTouch.h"

#include "vtkPointSet.h"
#include "vtkPoints.h"

#include "Core/Base/OutputFile.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>

namespace pointhaptics
{
namespace
{

/// Not to be broken: it finds out that a file is another one, or in another order.
template <typename Real>
std::uint64_t checksumOf(const Real* numbers, std::int64_t count)
{
  constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t sum = 0xcbf29ce484222325;
  for (std::int64_t i = 0; i < count; ++i)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, numbers + i, sizeof(Real));
    sum = (sum ^ bits) * kPrime;
    sum ^= sum >> 29;
  }
  return sum;
}

} // namespace

std::uint64_t checksumOf(vtkPointSet* cloud)
{
  const PointAccess access(cloud ? cloud->GetPoints() : nullptr);
  const PointView view = access.view();
  return view.size() == 0 ? 0
    : view.floats()       ? checksumOf(view.floats(), 3 * view.size())
                          : checksumOf(view.doubles(), 3 * view.size());
}

std::string recordedColumns()
{
  std::string line;
  for (const char* column : kFeltColumns)
  {
    line += std::string(column) + ",";
  }
  return line + "buttons,marker";
}

RecordingHeader headerOf(const std::vector<std::string>& files, double resolution, vtkPointSet* cloud)
{
  RecordingHeader header;
  for (const std::string& file : files)
  {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::absolute(file, error);
    header.cloud.files.push_back(error ? file : path.string());
  }
  header.cloud.resolution = resolution;
  header.cloud.points = cloud->GetNumberOfPoints();
  header.cloud.checksum = checksumOf(cloud);
  return header;
}

bool isOf(const Recording& recording, vtkPointSet* cloud, std::string& message)
{
  const RecordedFiles& felt = recording.header.cloud;
  const vtkIdType points = cloud ? cloud->GetNumberOfPoints() : 0;
  const bool hasPoints = points == felt.points;
  const bool isSame = hasPoints && checksumOf(cloud) == felt.checksum;
  message = isSame
    ? ""
    : fmt::format("{}; give that cloud ({})",
        hasPoints ? "its points are others than those the recording was made with"
                  : fmt::format("it has {} points, and the recording was made with {}", points, felt.points),
        felt.files.front());
  return isSame;
}

std::string keptCloudName(const std::string& recording)
{
  return std::filesystem::path(recording).replace_extension(".cloud").string();
}

bool keepCloud(const std::string& from, const std::string& to, std::string& message)
{
  constexpr std::size_t kBlock = 1 << 20;
  std::ifstream input(from, std::ios::binary);
  std::string block(kBlock, '\0');
  OutputFile output;
  static_cast<void>(output.open(to)); // commit() tells
  while (input)
  {
    input.read(block.data(), std::streamsize(block.size()));
    static_cast<void>(output.write({ block.data(), std::size_t(input.gcount()) }));
  }
  if (output.commit() != Status::Ok)
  {
    message = fmt::format(
      "{}: the cloud cannot be kept for the recording: {}; {}", to, output.reason(), output.cure());
    return false;
  }
  return true;
}

} // namespace pointhaptics
