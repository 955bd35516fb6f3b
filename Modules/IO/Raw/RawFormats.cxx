#include "IO/Formats/FormatList.h"

#include "Bytes/LittleEndian.h"
#include "Bytes/NumericType.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"
#include "ReadTask.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kFloat = 4;
constexpr std::size_t kSplat = 32;
constexpr std::size_t kLooked = 4096; ///< Records.
constexpr std::size_t kFewest = 8;    ///< Records that a file without the extension must have.

/// A length in metres as sensors measure it; bytes of other kinds are tiny, huge or no number.
bool isLength(float value)
{
  constexpr float kMost = 2000.0f;
  constexpr float kLeast = 1e-7f;
  return value == 0.0f || (std::abs(value) <= kMost && std::abs(value) >= kLeast);
}

/// Files that are cut have the extension.
bool areScans(const FormatStart& start, std::size_t floats)
{
  const std::size_t record = kFloat * floats;
  const std::size_t records = start.bytes.size() / record;
  const bool isNamed = start.extension == "bin";
  const bool isCut = start.size % record != 0;
  if (start.isText || (isCut && !isNamed) || records < (isNamed && !isCut ? 1 : kFewest))
  {
    return false;
  }
  float farthest = 0.0f;
  for (std::size_t i = 0; i < std::min(records, kLooked); ++i)
  {
    const auto at = [&](std::size_t k) { return numberAt<float>(start.bytes, i * record + k * kFloat); };
    const float ring = floats > 4 ? at(4) : 0.0f;
    if (!isLength(at(0)) || !isLength(at(1)) || !isLength(at(2)) || !(at(3) >= 0.0f && at(3) <= 65535.0f) ||
      !(ring >= 0.0f && ring <= 255.0f && ring == std::floor(ring)))
    {
      return false;
    }
    farthest = std::max({ farthest, std::abs(at(0)), std::abs(at(1)) });
  }
  return farthest > 0.0f;
}

/// Records of the numbers of @p planned, one behind the other.
void readRecords(ReadTask& task, const std::vector<Column>& planned, vtkPolyData* cloud)
{
  std::vector<StoredColumn> stored;
  std::size_t record = 0;
  for (std::size_t i = 0; i < planned.size(); ++i)
  {
    for (int component = 0; component < planned[i].components; ++component)
    {
      stored.push_back(
        { { task.bytes.data() + record, 0, planned[i].type }, i, component, !kIsLittleEndianHost });
      record += static_cast<std::size_t>(sizeOfType(planned[i].type));
    }
  }
  for (StoredColumn& each : stored)
  {
    each.source.stride = static_cast<std::ptrdiff_t>(record);
  }
  const std::size_t count = task.bytes.size() / record;
  CloudColumns columns(planned,
    static_cast<vtkIdType>(task.bytes.size() % record == 0
        ? count
        : task.endAt(count, count + 1, "the file ends within its record " + std::to_string(count + 1))));
  columns.fill(stored, task);
  columns.moveTo(cloud, task);
}

/// Leaves out what lets through nearly all light.
template <typename Opacity>
void leaveOutFaint(ReadTask& task, vtkPolyData* cloud, Opacity opacity)
{
  constexpr double kFaint = 0.05;
  vtkNew<vtkIdList> kept;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    if (opacity(i) >= kFaint)
    {
      kept->InsertNextId(i);
    }
  }
  const std::int64_t count = task.sumOfRanks(cloud->GetNumberOfPoints());
  const std::int64_t faint = count - task.sumOfRanks(kept->GetNumberOfIds());
  if (faint > 0 && faint < count)
  {
    keepPoints(cloud, kept);
    task.notes.push_back(std::to_string(faint) + " of " + std::to_string(count) +
      " splats are left out: their opacity is below 0.05");
  }
}

} // namespace

bool looksLikeKitti(const FormatStart& start)
{
  return areScans(start, 4);
}

bool looksLikeNuScenes(const FormatStart& start)
{
  return areScans(start, 5);
}

bool looksLikeSplat(const FormatStart& start)
{
  const std::size_t records = start.bytes.size() / kSplat;
  const bool isNamed = start.extension == "splat"; // one that is cut, too
  if (start.isText || (start.size % kSplat != 0 && !isNamed) || records < (isNamed ? 1 : kFewest))
  {
    return false;
  }
  for (std::size_t i = 0; i < std::min(records, kLooked); ++i)
  {
    double squares = 0.0; // of the rotation, a quaternion
    bool isRight = true;
    for (std::size_t k = 0; k < 4; ++k)
    {
      const double part = (static_cast<unsigned char>(start.bytes[i * kSplat + 28 + k]) - 128.0) / 128.0;
      squares += part * part;
      isRight = isRight && (k == 3 || std::isfinite(numberAt<float>(start.bytes, i * kSplat + k * kFloat))) &&
        (k == 3 || numberAt<float>(start.bytes, i * kSplat + 12 + k * kFloat) >= 0.0f);
    }
    if (!isRight || std::abs(squares - 1.0) > 0.1)
    {
      return false;
    }
  }
  return true;
}

/// Scans of KITTI.
void readKitti(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "KITTI (float32 x y z intensity)";
  readRecords(task, columnsCalled({ "x", "y", "z", "intensity" }), cloud);
}

/// Scans of nuScenes.
void readNuScenes(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "nuScenes (float32 x y z intensity ring)";
  readRecords(task, columnsCalled({ "x", "y", "z", "intensity", "ring" }), cloud);
}

/// Splats of 32 bytes.
void readSplat(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "Gaussian splats (.splat)";
  readRecords(task,
    { { "x" }, { "y" }, { "z" }, { "scale", VTK_FLOAT, 3 }, { "RGBA", VTK_UNSIGNED_CHAR, 4 },
      { "rotation", VTK_UNSIGNED_CHAR, 4 } },
    cloud);
  vtkDataArray* colors = cloud->GetPointData()->GetArray("RGBA");
  leaveOutFaint(task, cloud, [=](vtkIdType i) { return colors->GetComponent(i, 3) / 255.0; });
}

void finishSplats(ReadTask& task, vtkPolyData* cloud)
{
  vtkPointData* data = cloud->GetPointData();
  vtkDataArray* harmonics = data->GetArray("f_dc");
  vtkDataArray* opacity = data->GetArray("opacity");
  if (!harmonics || !opacity || harmonics->GetNumberOfComponents() != 3 || data->GetArray("RGB"))
  {
    return;
  }
  constexpr double kOfConstant = 0.28209479177387814; // the spherical harmonic of degree 0
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(cloud->GetNumberOfPoints());
  for (vtkIdType i = 0; i < colors->GetNumberOfValues(); ++i)
  {
    const double value = 0.5 + kOfConstant * harmonics->GetComponent(i / 3, static_cast<int>(i % 3));
    colors->SetValue(i, static_cast<unsigned char>(value > 0.0 ? std::min(255.0 * value + 0.5, 255.0) : 0.0));
  }
  data->AddArray(colors);
  leaveOutFaint(
    task, cloud, [=](vtkIdType i) { return 1.0 / (1.0 + std::exp(-opacity->GetComponent(i, 0))); });
  setActiveAttributes(cloud);
}

} // namespace pointhaptics::io
