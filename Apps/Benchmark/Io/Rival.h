/// @file
/// One program's readers and writers of point cloud files: ours or another library's, behind one face.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{
namespace bench
{
namespace io
{

enum class FileKind
{
  BinaryPly,
  AsciiPly,
  BinaryPcd,
  CompressedPcd,
  AsciiPcd,
  Csv,
  Xyz,
  Las,
  Laz,
  E57,
  Vtp,
};
constexpr FileKind kAllKinds[] = { FileKind::BinaryPly, FileKind::AsciiPly, FileKind::BinaryPcd,
  FileKind::CompressedPcd, FileKind::AsciiPcd, FileKind::Csv, FileKind::Xyz, FileKind::Las, FileKind::Laz,
  FileKind::E57, FileKind::Vtp };
/// "PLY binary".
const char* nameOf(FileKind kind);

/// Use: any number of discard and read, or load once and then any number of write.
class Rival
{
public:
  virtual ~Rival() = default;
  /// What is called for files of this kind: "vtkPLYReader"; empty: it cannot.
  virtual std::string readerOf(FileKind kind) const = 0;
  virtual std::string writerOf(FileKind kind) const = 0;

  /// Reads the whole file. Throws std::runtime_error where it cannot.
  virtual void read(FileKind kind, const std::string& path) = 0;
  /// Frees what read() left. Not timed.
  virtual void discard() = 0;
  /// The points that were read, x y z of each; empty for a rival that only moves bytes.
  virtual std::vector<double> points() const = 0;
  /// Bytes of memory that the result of read() takes.
  virtual std::int64_t resultBytes() const = 0;

  /// Copies @p cloud into the rival's own form. Not timed.
  virtual void load(vtkPolyData* cloud) = 0;
  virtual void write(FileKind kind, const std::string& path) = 0;
};

std::unique_ptr<Rival> makeOurs();
std::unique_ptr<Rival> makeVtk();
/// No reader: the bytes of the file, into memory that was not used before, or always into the same.
std::unique_ptr<Rival> makeBytes(bool intoFreshMemory);

/// The words of --rivals, those that were built.
std::vector<std::string> rivalWords();
/// @p word must be one of them. Throws std::runtime_error where its module cannot be loaded.
std::unique_ptr<Rival> makeRival(const std::string& word);

} // namespace io
} // namespace bench
} // namespace pointhaptics
