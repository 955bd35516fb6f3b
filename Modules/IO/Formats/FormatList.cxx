#include "IO/Formats/FormatList.h"

#include "FileProblem.h"
#include "IO/Formats/FormatLooks.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace pointhaptics::io
{

using Read = void(ReadTask&, vtkPolyData*);
using Write = void(WriteTask&);
Read readPly, readPcd, readVtkXml, readVtkLegacy, readOff, readStl, readObj, readLas, readE57, readText,
  readEsriGrid, readPtx, readKitti, readNuScenes, readNumpy, readSplat;
Write writePly, writePcd, writeVtp, writeLas, writeLaz, writeCsv, writeXyz;

namespace
{

constexpr const char* kLasFields =
  "LasScale LasOffset LasGlobalEncoding LasHeader LasRecords LasFarRecords CoordinateSystem";

constexpr std::string_view kLas = "LASF";
constexpr std::string_view kE57 = "ASTM-E57";
constexpr std::string_view kVtkLegacy = "# vtk DataFile";

template <const std::string_view& Mark>
bool startsWith(const FormatStart& start)
{
  return start.bytes.substr(0, Mark.size()) == Mark;
}

/// Name, extensions, looks, reader, whether it is read in parts, writer, field data. What comes first is
/// recognised first.
const CloudFormat kFormats[] = {
  { "VTP", "vtp", nullptr, nullptr, false, writeVtp },
  { "PLY", "ply", looksLikePly, readPly, true, writePly },
  { "PCD", "pcd", looksLikePcd, readPcd, true, writePcd, "Viewpoint OrganizedDimensions" },
  { "LAS", "las", startsWith<kLas>, readLas, true, writeLas, kLasFields },
  { "LAZ", "laz", nullptr, nullptr, false, writeLaz, kLasFields },
  { "E57", "e57", startsWith<kE57>, readE57 },
  { "VTK XML", "pvtp vtu", looksLikeVtkXml, readVtkXml, true },
  { "VTK (legacy)", "vtk", startsWith<kVtkLegacy>, readVtkLegacy },
  { "OFF", "off noff coff cnoff", looksLikeOff, readOff },
  { "STL", "stl", looksLikeStl, readStl },
  { "PTX", "ptx", looksLikePtx, readPtx },
  { "Esri grid", "asc", looksLikeEsriGrid, readEsriGrid },
  { "OBJ", "obj", looksLikeObj, readObj },
  { "NumPy", "npy", looksLikeNumpy, readNumpy },
  { "nuScenes", "bin", looksLikeNuScenes, readNuScenes },
  { "KITTI", "bin", looksLikeKitti, readKitti },
  { "Gaussian splats", "splat", looksLikeSplat, readSplat },
  { "CSV", "csv", nullptr, nullptr, false, writeCsv },
  { "text", "xyz txt pts tsv dat xyzn xyzrgb", looksLikeColumns, readText, false, writeXyz },
};

std::vector<std::string> wordsOf(const char* text)
{
  std::istringstream words(text);
  return { std::istream_iterator<std::string>(words), {} };
}

} // namespace

const CloudFormat& identifyFormat(std::string_view bytes, std::size_t size, const std::string& extension)
{
  failFormatIf(size > 0 && bytes.size() == size && bytes.find_first_not_of('\0') == std::string_view::npos,
    "copy it again", "the file holds only zero bytes");
  std::string converted;
  const FormatStart start = lookAt(bytes, size, extension, converted);
  refuseForeign(start);
  for (const CloudFormat& format : kFormats)
  {
    if (format.isLike && format.isLike(start))
    {
      return format;
    }
  }
  refuseForeignName(extension);
  throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
    "unknown format: starts with " + inQuotes(start.bytes.substr(0, 16)),
    fmt::format("use .{}, or text with columns x y z", fmt::join(formatExtensions(false), ", .")));
}

const CloudFormat* writtenFormat(const std::string& extension)
{
  const auto* const found = std::find_if(std::begin(kFormats), std::end(kFormats),
    [&](const CloudFormat& format)
    { return format.write && wordsOf(format.extensions).front() == extension; });
  return found == std::end(kFormats) ? nullptr : found;
}

std::vector<std::string> formatExtensions(bool written)
{
  std::vector<std::string> extensions;
  for (const CloudFormat& format : kFormats)
  {
    std::vector<std::string> words = wordsOf(format.extensions);
    words.resize(written ? (format.write ? 1 : 0) : words.size());
    std::copy_if(words.begin(), words.end(), std::back_inserter(extensions),
      [&](const std::string& word)
      { return std::find(extensions.begin(), extensions.end(), word) == extensions.end(); });
  }
  return extensions;
}

std::string formatTable()
{
  std::string table = "| format | extensions | written as |\n|---|---|---|\n";
  for (const CloudFormat& format : kFormats)
  {
    const std::vector<std::string> extensions = wordsOf(format.extensions);
    table += fmt::format("| {} | .{} | {} |\n", format.name, fmt::join(extensions, ", ."),
      format.write ? "." + extensions.front() : "");
  }
  return table;
}

} // namespace pointhaptics::io
