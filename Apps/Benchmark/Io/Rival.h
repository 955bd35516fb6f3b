/// @file
/// One program's readers and writers of point cloud files: ours or another library's, behind one face.
#pragma once

#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics::bench::io
{

enum class FileKind
{
  BinaryPly,
  BinaryPcd,
  Csv,
  Las,
  Laz,
  Vtp,
};

/// Use: any number of discard and read, or load once and then any number of write.
class Rival
{
public:
  virtual ~Rival() = default;
  /// The class or function for files of this kind: "vtkPLYReader"; empty: there is none.
  virtual std::string readerOf(FileKind kind) const = 0;
  virtual std::string writerOf(FileKind kind) const = 0;

  /// Reads the whole file. Throws std::runtime_error where it cannot.
  virtual void read(FileKind kind, const std::string& path) = 0;
  /// Frees what read() left. Not timed.
  virtual void discard() = 0;
  /// The points that were read, x y z of each.
  virtual std::vector<double> points() const = 0;

  /// Copies @p cloud into the rival's own form. Not timed.
  virtual void load(vtkPolyData* cloud) = 0;
  virtual void write(FileKind kind, const std::string& path) = 0;
};

} // namespace pointhaptics::bench::io
