/// @file
/// The steps the commands share: read, run a filter, write. Each gives one clean line where it fails.
#pragma once

#include "Core/Base/AffineTransform.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>

class vtkAlgorithm;
class vtkPointSet;
class vtkPolyData;

namespace pointhaptics
{
namespace app
{

struct Cloud
{
  vtkSmartPointer<vtkPolyData> points;
  std::string format; ///< As the reader calls it.
};

/// Reads @p fileName, down to @p resolution where it is a cloud optimised one (0: all of it). False: @p
/// message says what, where and the cure. A file without points is a fault.
bool readCloud(const std::string& fileName, Cloud& cloud, std::string& message, double resolution = 0.0);
/// Updates @p filter with a progress bar. False: @p message is the first error of any VTK class during the
/// update, or says that a remembered signal (StopSignals.h) ended it.
bool updateFilter(vtkAlgorithm* filter, const std::string& label, std::string& message);
/// False, and @p message, where no writer knows the extension of @p fileName. Worth asking before long work.
bool canWriteCloud(const std::string& fileName, std::string& message);
/// Writes what vtkPointCloudWriter writes; the file appears only when complete. What its format cannot hold
/// is shown as warnings of @p command. From here on a signal stops the writing: no unfinished file stays.
bool writeCloud(
  vtkPointSet* points, const std::string& fileName, const std::string& command, std::string& message);

/// The finite points of @p cloud, moved by @p transform, in double precision, without arrays; the others are
/// counted.
vtkSmartPointer<vtkPolyData> transformedPoints(
  vtkPolyData* cloud, const AffineTransform& transform, std::int64_t& invalid);

/// Shows what VTK classes warned of since the last call as warnings of @p command.
void showWarnings(const std::string& command);
/// Number of threads for VTK's parallel loops; 0 leaves the default.
void useThreads(std::int64_t threads);

} // namespace app
} // namespace pointhaptics
