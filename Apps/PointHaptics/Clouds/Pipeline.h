/// @file
/// The steps the commands share: read, run a filter, write. Each gives one clean line where it fails.
#pragma once

#include "Core/Base/AffineTransform.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkPointSet;
class vtkPolyData;

namespace pointhaptics
{
class Ranks;
namespace app
{

struct Cloud
{
  vtkSmartPointer<vtkPolyData> points;
  std::string format;             ///< As the reader calls it.
  std::vector<std::string> notes; ///< What the file has and the points have not.
  bool isValidWithoutPoints = false;
  std::int64_t bytesRead = 0;
};

/// Standard input or output in place of a file.
constexpr const char* kStandardStream = "-";

struct ReadOptions
{
  std::string extension;   ///< Of a name that does not say it; empty: the name's.
  bool applyPoses = true;  ///< Of scans (E57).
  double resolution = 0.0; ///< How far a cloud optimised one is read, in its units; 0: all of it.
  Ranks* ranks = nullptr;  ///< That read it together, each its part of the points; null: this process alone.
};

/// Reads @p fileName, or standard input, which is kept in a temporary file meanwhile. False: @p message says
/// what, where and the cure. A file without points is a fault; where it is a valid one, @p cloud says so and
/// has its field data. Where ranks read together and another one has a fault, @p message stays empty.
bool readCloud(
  const std::string& fileName, Cloud& cloud, std::string& message, const ReadOptions& options = {});
/// Updates @p filter with a progress bar. False: @p message is the first error of any VTK class during the
/// update, or says that a remembered signal (StopSignals.h) ended it.
bool updateFilter(vtkAlgorithm* filter, const std::string& label, std::string& message);
/// False, and @p message, where no writer knows the extension of @p fileName. Worth asking before long work.
bool canWriteCloud(const std::string& fileName, std::string& message);
/// The extensions that can be written, without their dots.
std::vector<std::string> writableExtensions();
/// Writes what vtkPointCloudWriter writes; the file appears only when complete. What its format cannot hold
/// is shown as warnings of @p command. From here on a signal stops the writing: no unfinished file stays.
/// @p extension: of a name that does not say it, as that of standard output; empty: the name's. @p written
/// gets the number of points in the file.
bool writeCloud(vtkPointSet* points, const std::string& fileName, const std::string& command,
  std::string& message, const std::string& extension = {}, vtkIdType* written = nullptr);

/// The finite points of @p cloud, moved by @p transform, in double precision, without arrays.
vtkSmartPointer<vtkPolyData> transformedPoints(vtkPolyData* cloud, const AffineTransform& transform);

/// That all of so many points are NaN or infinite.
std::string noFinitePoint(const std::string& fileName, std::int64_t count);

/// Shows the notes of a cloud that was read from @p fileName as warnings of @p command.
void showNotes(const std::string& command, const std::string& fileName, const Cloud& cloud);
/// Shows what VTK classes warned of since the last call as warnings of @p command.
void showWarnings(const std::string& command);
/// Number of threads for VTK's parallel loops; 0 leaves the default.
void useThreads(std::int64_t threads);

} // namespace app
} // namespace pointhaptics
