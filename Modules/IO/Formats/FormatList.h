/// @file
/// All formats: how each is recognised, read and written. A format is one line of the table in
/// FormatList.cxx; what the program says of formats comes from there.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

class vtkPolyData;

namespace pointhaptics::io
{

struct FormatStart;
struct ReadTask;
struct WriteTask;

struct CloudFormat
{
  const char* name;       ///< "PLY"
  const char* extensions; ///< Lower case, with spaces between; a file is written by the first.
  bool (*isLike)(const FormatStart&) = nullptr; ///< Null: another line recognises what this one writes.
  /// Fills an empty cloud with points and arrays, and names the format in task.format. Sizes that a file
  /// claims are checked against its length before anything is allocated. @throws FileProblem,
  /// StoppedOnRequest, std::bad_alloc.
  void (*read)(ReadTask&, vtkPolyData*) = nullptr;
  bool isReadInParts = false; ///< Ranks may read it together, each its own bytes.
  /// Writes the whole of task.cloud, with progress up to 1. Null: not written. @throws FileProblem,
  /// StoppedOnRequest.
  void (*write)(WriteTask&) = nullptr;
  const char* keptFieldData = ""; ///< Names that it can hold, with spaces between, but for LengthUnit.
};

/// Looks at the first bytes of a file. @p extension (lower case, no dot) decides only what the content leaves
/// open: OBJ or columns of text, binary STL of a wrong size. @p size: of the whole file, 0 when it is not
/// known.
/// @throws FileProblem for what is known but not read here (glTF, zip, ...), naming a converter, and for what
/// is not recognised at all.
const CloudFormat& identifyFormat(std::string_view start, std::size_t size, const std::string& extension);

/// The one that is written under @p extension; null where none is.
const CloudFormat* writtenFormat(const std::string& extension);

/// The extensions of all formats that are read, or with @p written of those that are written.
std::vector<std::string> formatExtensions(bool written);

/// The table of all formats, in Markdown.
std::string formatTable();

/// Gaussian splats are a cloud of ellipsoids: of one with the arrays "f_dc" and "opacity", adds their colours
/// as "RGB" and leaves out those that can hardly be seen, with a note. Collective where ranks read the file.
void finishSplats(ReadTask& task, vtkPolyData* cloud);

} // namespace pointhaptics::io
