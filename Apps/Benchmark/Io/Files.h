/// @file
/// A made-up cloud and the files it is written to, in a folder that is removed at the end.
#pragma once

#include "Benchmark/Io/Rival.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{
namespace bench
{
namespace io
{

/// Float points drawn at random from a cube of 10 m, with seed 1; arrays "intensity" (float) and "RGB" (3
/// bytes).
vtkSmartPointer<vtkPolyData> makeCloud(std::int64_t points);

class Files
{
public:
  /// Throws std::runtime_error where no folder can be made.
  Files();
  ~Files();
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  /// Where write() puts such a file.
  std::string pathOf(FileKind kind) const;
  /// Writes @p cloud, with as many digits as bring its floats back. Throws std::runtime_error.
  std::string write(FileKind kind, vtkPolyData* cloud) const;
  /// A name in the folder.
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
  std::filesystem::path folder_;
};

/// Largest difference of any coordinate, with @p points rounded to floats where @p asFloats; infinite where
/// the number of points differs.
double largestError(vtkPolyData* expected, const std::vector<double>& points, bool asFloats);

} // namespace io
} // namespace bench
} // namespace pointhaptics
