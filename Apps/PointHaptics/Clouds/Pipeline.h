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
  bool mayBeEmpty = false;          ///< A valid file may have no points: a note says so.
  Ranks* ranks = nullptr; ///< Ranks that read it together, each its part of the points; null: this process
                          ///< alone.
};

/// Reads @p fileName, a pipe or standard input. Where ranks read together and another one has a fault, the
/// cloud is empty. @throws Failure that says what, where and the cure, also where there are no points.
Cloud readCloud(const std::string& fileName, const ReadOptions& options = {});
/// Updates @p filter, which works on @p input, with a progress bar. @throws Failure with the first error of
/// any VTK class during the update, or where a remembered signal (StopSignals.h) ended it.
void updateFilter(vtkAlgorithm* filter, const std::string& label, const std::string& input);
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
/// hold is shown as warnings. From here on a signal stops the writing: no unfinished file stays.
/// @return the number of points in the file. @throws Failure
vtkIdType writeCloud(
  vtkPointSet* points, const std::string& fileName, Files& files, const WriteOptions& options = {});
/// Merges @p clouds, which are empty then, into one. Notes are shown as warnings. @throws Failure
Cloud mergedCloud(std::vector<Cloud>& clouds);

/// That no length can be computed of @p cloud, as x and y are degrees and z is a length, which @p transform
/// does not change; empty: there can.
std::string whyNoLengths(vtkPolyData* cloud, const AffineTransform& transform = {});

/// Makes the field data of @p cloud say that all its coordinates are in metres.
void sayMetres(vtkPolyData* cloud);

/// Message that all @p count points are NaN or infinite.
std::string noFinitePoint(const std::string& fileName, std::int64_t count);

/// Shows the notes of @p cloud as warnings.
void showNotes(const Cloud& cloud);
/// Shows the warnings of VTK classes since the last call as warnings.
void showWarnings();
/// Number of threads for VTK's parallel loops; 0 leaves the default.
void useThreads(std::int64_t threads);

} // namespace app
} // namespace pointhaptics
