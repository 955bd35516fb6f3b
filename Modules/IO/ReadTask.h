/// @file
/// Task of a format reader: the bytes, where to report progress, and where to name the format.
#pragma once

#include "FileProblem.h"
#include "Progress.h"
#include "SharedReading.h"

#include "vtkCellArray.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

class vtkAlgorithm;

namespace pointhaptics::io
{

/// Part of the progress that reading the bytes takes; parsing them takes the rest.
constexpr double kReadingPart = 0.3;
/// The last part of it, where faces are sampled.
constexpr double kSamplingPart = 0.4;

/// Bytes of a file that are looked at before it is known what else is needed: headers are much shorter.
constexpr std::size_t kStartOfText = std::size_t{ 1 } << 20;

/// Part of a cloud to read: see vtkPointCloudReader.
struct WantedPart
{
  bool onlyPositions = false;   ///< no arrays beside the points, where leaving them out saves work
  double resolution = 0.0;      ///< distance between points that is fine enough; 0: all points
  std::uint64_t mostPoints = 0; ///< by leaving out fine levels of the octree, where there is one; 0: no bound
  std::array<double, 6> box{ 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 }; ///< x0, x1, y0, y1, z0, z1

  bool hasBox() const { return box[0] <= box[1] && box[2] <= box[3] && box[4] <= box[5]; }
  /// True if a file that can be read in parts need not be read whole.
  bool isPart() const { return hasBox() || resolution > 0.0 || mostPoints > 0; }
};

/// The faces of a mesh while its file is read.
struct MeshFaces
{
  std::uint64_t count = 0;             ///< out: of the file, whether or not they are kept
  std::uint64_t others = 0;            ///< out: strips and cells of the file that are not read as faces
  vtkSmartPointer<vtkCellArray> cells; ///< Those that are kept; null: none is wanted.

  bool isWanted() const { return cells != nullptr; }
  /// Keeps a face, whose corners are vertices of the file, counted from 0. Nobody has checked them.
  void keep(const std::vector<vtkIdType>& corners)
  {
    if (isWanted() && corners.size() > 2)
    {
      cells->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
    }
  }
};

/// Lives during one read, in one thread.
struct ReadTask
{
  std::string path;
  std::string_view bytes;
  bool isPackedCut = false; ///< the bytes are those of a gzip file that ends too early
  bool isStream = false; ///< the bytes came through a pipe, or packed: nobody can read them so from the file
  std::string extension; ///< decides what the content leaves open
  WantedPart wanted;
  std::vector<std::string>
    columns;            ///< names for those of text, "-" for one that is left out; empty: none given
  bool salvage = false; ///< a file that is cut is read as far as it goes
  vtkAlgorithm* algorithm = nullptr;
  /// Reads bytes of the file; empty where all are there. Those that were never read are zero.
  std::function<void(std::size_t offset, std::size_t size)> load;
  /// Where ranks read the file together, and its format can be read in parts: null where it is read whole.
  SharedReading* shared = nullptr;
  MeshFaces faces;
  bool isCut = false;                              ///< out: the cloud is this rank's part
  std::size_t bytesElsewhere = 0;                  ///< out: read of other files, which this one lists
  bool applyPoses = true;                          ///< scans of several positions in one frame
  bool isCoarse = false;                           ///< out: WantedPart::mostPoints left out points
  std::uint64_t pointsThere = ~std::uint64_t{ 0 }; ///< out: the cloud has no more, from the first on
  std::string format;             ///< out: "PLY (binary little endian)", as soon as it is known
  std::vector<std::string> notes; ///< out: what the cloud does not have of the file, one line each

  /// Must be called before bytes are looked at where load is set. They may lie outside the file.
  void need(std::size_t offset, std::size_t size) const
  {
    if (load && offset < bytes.size())
    {
      load(offset, std::min(size, bytes.size() - offset));
    }
  }
  /// Rows of a file that has @p all: this rank's, or all of them.
  RowRange rowsOf(std::uint64_t all)
  {
    isCut = shared != nullptr;
    return shared ? shared->rowsOf(all) : RowRange{ 0, all };
  }
  /// Collective where ranks read the file together: the plain value that each has.
  template <typename T>
  std::vector<T> ofRanks(const T& own) const
  {
    return shared ? shared->gatherValues(own) : std::vector<T>{ own };
  }
  /// Collective as well: the sum of what each rank has.
  std::int64_t sumOfRanks(std::int64_t own) const { return shared ? shared->sum(own) : own; }
  /// What is to be done where the file, as @p what says, ends after @p there of @p all points: it is refused,
  /// or read as far as it goes, with a note. @return @p there. @throws FileProblem.
  std::uint64_t endAt(std::uint64_t there, std::uint64_t all, const std::string& what)
  {
    if (!salvage || shared || there == 0)
    {
      failTruncated(what, there > 0 && !salvage ? kSalvageCure : "");
    }
    notes.push_back(what.substr(0, what.find("; ")) + ": the " + std::to_string(there) +
      " points before are read" + (all > 0 ? ", of " + std::to_string(all) + " that the file promises" : ""));
    pointsThere = there;
    return there;
  }
  /// endAt() behind @p row where @p problem is that the file ends; thrown on unless it is salvaged.
  void endBehind(std::uint64_t row, std::uint64_t all, const FileProblem& problem)
  {
    if (!salvage || row == 0)
    {
      throw;
    }
    endAt(row, all, problem.what());
  }
  /// Whether the file ended among its points.
  bool isTorn() const { return pointsThere != ~std::uint64_t{ 0 }; }
  /// Notes what follows at @p offset, behind all that the header counts, where it is as long as a record of
  /// @p size bytes and not blank.
  void noteUncounted(std::size_t offset, std::size_t size)
  {
    if (shared || isTorn() || offset > bytes.size() || size > bytes.size() - offset)
    {
      return; // each rank has read its own points only; a file that ends among its points was said to
    }
    need(offset, size);
    constexpr std::string_view kBlank(" \t\r\n\x1a\0", 6);
    if (bytes.substr(offset, size).find_first_not_of(kBlank) != std::string_view::npos)
    {
      notes.push_back(std::to_string(bytes.size() - offset) +
        " bytes follow what the header counts and are left out; correct its counts to read them");
    }
  }
  /// The same as a rank that reads it alone: for what cannot be read in parts.
  void takeWhole()
  {
    shared = nullptr;
    need(0, bytes.size());
  }
  /// Reports how much of the parsing is done, 0..1. @throws StoppedOnRequest when an observer asked to stop.
  void progress(double fraction) const { reportProgress(algorithm, overall(fraction)); }
  /// progress() of @p done of @p all, once in kProgressRows times that @p count rises.
  void step(std::uint64_t count, std::uint64_t done, std::uint64_t all) const
  {
    if (count % kProgressRows == 0)
    {
      progress(static_cast<double>(done) / static_cast<double>(all));
    }
  }
  /// Calls @p fill(begin, end) for pieces of 0..rows-1 on VTK's threads, and progress() between them, which
  /// ends at @p part.
  template <typename Fill>
  void fillRows(vtkIdType rows, const Fill& fill, double part = 1.0) const
  {
    for (vtkIdType begin = 0; begin < rows; begin += 2 * kProgressRows)
    {
      const vtkIdType end = std::min(begin + 2 * kProgressRows, rows);
      vtkSMPTools::For(begin, end, kProgressRows / 8, fill);
      progress(part * static_cast<double>(end) / static_cast<double>(rows));
    }
  }
  /// Part of the whole work that is done when @p fraction of the parsing is.
  double overall(double fraction) const
  {
    return kReadingPart + (1.0 - kReadingPart - (faces.isWanted() ? kSamplingPart : 0.0)) * fraction;
  }
  /// Reports how much of the file's bytes is read.
  void readingProgress(double fraction) const { reportProgress(algorithm, kReadingPart * fraction); }
};

} // namespace pointhaptics::io
