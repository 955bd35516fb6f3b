/// @file
/// The steps the commands share: read, run a filter, write. Each gives one clean line where it fails.
#pragma once

#include "Options/Files.h"

#include "Core/Base/AffineTransform.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <cstdint>
#include <string>
#include <vector>

namespace CLI
{
class App;
}
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
  std::string name;               ///< Of the file, as it was given.
  std::string format;             ///< Name of the format, as the reader gives it.
  std::vector<std::string> notes; ///< Parts of the file that the points lack.
  bool isValidWithoutPoints = false;
  std::int64_t bytesRead = 0;
};

struct ReadOptions
{
  std::string extension;    ///< Extension for a name that has none; empty: the name's.
  bool applyPoses = true;   ///< Applies the poses of scans (E57).
  double resolution = 0.0;  ///< Resolution to which a cloud optimised file is read, in its units; 0: all of
                            ///< it.
  std::vector<double> clip; ///< Box of the points that are read, in the file's coordinates: XMIN, XMAX, YMIN,
                            ///< ...; empty: all.
  std::vector<std::string> columns; ///< Names for the columns of a text; empty: as the file says.
  bool salvage = false;             ///< A file that is cut is read as far as it goes.
  std::int64_t samples = 0;         ///< Samples of the faces of a mesh, as vtkPointCloudReader takes them.
  Ranks* ranks = nullptr; ///< Ranks that read it together, each its part of the points; null: this process
                          ///< alone.
};

/// Reads @p fileName, a pipe or standard input. False: @p message says
/// what, where and the cure. A file without points is a fault; where it is a valid one, @p cloud says so and
/// has its field data. Where ranks read together and another one has a fault, @p message stays empty.
bool readCloud(
  const std::string& fileName, Cloud& cloud, std::string& message, const ReadOptions& options = {});
/// Updates @p filter with a progress bar. False: @p message is the first error of any VTK class during the
/// update, or says that a remembered signal (StopSignals.h) ended it.
bool updateFilter(vtkAlgorithm* filter, const std::string& label, std::string& message);
/// The extensions that can be written, without their dots.
std::vector<std::string> writableExtensions();
/// Options for writing a cloud.
struct WriteOptions
{
  std::string format;        ///< Extension for a name that has none; empty: the name's.
  bool keepsDoubles = false; ///< Types and names of arrays in PCD.
  double lasScale = 0.0;     ///< Step of the coordinates of LAS, in their unit; 0: see vtkPointCloudWriter.

  /// Adds --output-format, --las-scale and --double.
  void addTo(CLI::App& command);
};

/// Writes @p fileName, one of the outputs among @p files, as vtkPointCloudWriter does. What its format cannot
/// hold is shown as warnings of @p command. From here on a signal stops the writing: no unfinished file
/// stays.
/// @p written gets the number of points in the file.
bool writeCloud(vtkPointSet* points, const std::string& fileName, Files& files, const std::string& command,
  std::string& message, const WriteOptions& options = {}, vtkIdType* written = nullptr);
/// Merges @p clouds, which are empty then, into one. Notes are shown as warnings of @p command.
Cloud mergedCloud(const std::string& command, std::vector<Cloud>& clouds);

/// That no length can be computed of @p cloud, as x and y are degrees and z is a length, which @p transform
/// does not change; empty: there can.
std::string whyNoLengths(vtkPolyData* cloud, const AffineTransform& transform = {});

/// The finite points of @p cloud, moved by @p transform, in double precision, without arrays.
vtkSmartPointer<vtkPolyData> transformedPoints(vtkPolyData* cloud, const AffineTransform& transform);

/// Message that all @p count points are NaN or infinite.
std::string noFinitePoint(const std::string& fileName, std::int64_t count);

/// Shows the notes of a cloud that was read from @p fileName as warnings of @p command.
void showNotes(const std::string& command, const std::string& fileName, const Cloud& cloud);
/// Shows the warnings of VTK classes since the last call as warnings of @p command.
void showWarnings(const std::string& command);
/// Number of threads for VTK's parallel loops; 0 leaves the default.
void useThreads(std::int64_t threads);

} // namespace app
} // namespace pointhaptics
