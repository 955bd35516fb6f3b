#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Formats/FormatLooks.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace pointhaptics::io
{

namespace
{

struct Foreign
{
  std::string_view mark;
  const char* what; ///< "a glTF file", which is not read here, or all that is to be said: "this is ...".
  const char* cure;
};

constexpr std::string_view operator""_bytes(const char* text, std::size_t size)
{
  return { text, size };
}

constexpr const char* kMesh = "export its points as PLY, for example with Blender or MeshLab";
constexpr const char* kPcap =
  "extract the points: pcl_pcap_grabber, VeloView or ouster-cli write PCD, CSV or LAS";
constexpr const char* kRaster = "make points of it: gdal2xyz.py FILE points.xyz";
constexpr const char* kBag = "export a topic: rosrun pcl_ros bag_to_pcd, or ros2 run pcl_ros";
constexpr const char* kCells = "convert the whole cloud: pdal translate INPUT cloud.laz";

/// By the first bytes.
const Foreign kByBytes[] = {
  { "\x1f\x8b"_bytes, "this is a gzip file inside a gzip file", "unpack it once: gunzip -k FILE" },
  { "BZh", "this file is bzip2-compressed", "unpack it first: bunzip2 -k FILE" },
  { "\xfd"
    "7zXZ",
    "this file is xz-compressed", "unpack it first: unxz -k FILE" },
  { "\x28\xb5\x2f\xfd", "this file is zstd-compressed", "unpack it first: unzstd FILE" },
  { "7z\xbc\xaf\x27\x1c", "this is a 7z archive", "unpack it first: 7z x FILE" },
  { "Rar!", "this is a RAR archive", "unpack it first: unrar x FILE" },
  { "glTF", "a glTF file (GLB)", kMesh },
  { "DRACO", "a Draco file", "unpack it: draco_decoder -i FILE -o cloud.ply" },
  { "II*\0"_bytes, "a TIFF picture (GeoTIFF)", kRaster },
  { "MM\0*"_bytes, "a TIFF picture (GeoTIFF)", kRaster },
  { "II+\0"_bytes, "a TIFF picture (GeoTIFF)", kRaster },
  { "#ROSBAG", "a ROS bag", kBag },
  { "SQLite format 3", "an SQLite database (a ROS 2 bag or a GeoPackage)", kBag },
  { "\x89MCAP", "an MCAP file of ROS 2", kBag },
  { "\xd4\xc3\xb2\xa1", "a pcap file of network packets", kPcap },
  { "\xa1\xb2\xc3\xd4", "a pcap file of network packets", kPcap },
  { "\x4d\x3c\xb2\xa1", "a pcap file of network packets", kPcap },
  { "\x0a\x0d\x0d\x0a", "a pcapng file of network packets", kPcap },
  { "pnts", "a tile of 3D Tiles", kCells },
  { "b3dm", "a tile of 3D Tiles", kMesh },
  { "i3dm", "a tile of 3D Tiles", kMesh },
  { "cmpt", "a tile of 3D Tiles", kMesh },
  { "CCB", "a file of CloudCompare (BIN)",
    "save it as E57, PLY or LAS: CloudCompare -O FILE -C_EXPORT_FMT PLY -SAVE_CLOUDS" },
  { "\x89HDF", "an HDF5 file", "write its points as .npy: python3 with h5py and numpy.save" },
  { "Kaydara FBX", "an FBX file", kMesh },
  { "BLENDER", "a file of Blender", kMesh },
  { "ISO-10303-21", "a STEP file", kMesh },
  { "NGSP", "a Gaussian splat file (SPZ)", "save it as PLY with the viewer that wrote it, or SuperSplat" },
  { "version https://git-lfs", "this is a pointer of Git LFS, not the file", "fetch the file: git lfs pull" },
};

/// By what stands near the start of a text that begins with '{' or '<'.
const Foreign kByWords[] = {
  { "\"geometricError\"", "the list of a 3D Tiles set", kCells },
  { "\"octreeDir\"", "the description of a Potree cloud", kCells },
  { "\"hierarchy\"", "the description of a Potree cloud", kCells },
  { "\"hierarchyType\"", "the description of an EPT cloud", kCells },
  { "\"asset\"", "a glTF file", kMesh },
  { "<LandXML", "a LandXML file", "export its points as text with x, y and z, or as LAS" },
  { "<html", "this is a web page, not a point cloud", "the download failed: fetch the file again" },
  { "<!DOCTYPE html", "this is a web page, not a point cloud", "the download failed: fetch the file again" },
  { "<COLLADA", "a COLLADA file", kMesh },
  { "<X3D", "an X3D file", kMesh },
  { "{", "JSON", "write the points as columns of text: x y z" },
};

/// By the extension, where the content tells nothing.
const Foreign kByNames[] = {
  { "rxp rdbx", "a file of a RIEGL scanner", "export it as LAZ or E57 with RiSCAN PRO or RDB tools" },
  { "fls fws lsproj", "a file of a FARO scanner", "export it as E57 with FARO SCENE" },
  { "zfs", "a file of a Zoller + Froehlich scanner", "export it as E57 with Z+F LaserControl" },
  { "rcp rcs", "a file of Autodesk ReCap", "export it as E57 with ReCap" },
  { "ptg lgs lgsx imp pod cl3 clr tzf 3dd", "a scanner program's own format",
    "export it as E57, LAZ or PTX with the program that wrote it" },
  { "bin", "this is a binary file of an unknown kind (Potree node, CloudCompare, raw numbers)",
    "raw float32 x y z intensity (KITTI) and x y z intensity ring (nuScenes) are read; save others as PLY" },
  { "dxf dwg", "a drawing", "export its points as text with x, y and z" },
  { "usd usda usdc", "a USD scene", kMesh },
};

/// By the name of the first file in a zip archive.
const Foreign kByZippedName[] = {
  { ".usd", "a USDZ scene", kMesh },
  { ".npy", "this is a NumPy archive (npz)",
    "write one array of it as .npy: numpy.save('cloud.npy', points)" },
  { ".kml", "a KMZ file of a map", "export the points as LAS or text" },
};

/// Refuses what the first entry of @p list says for whose mark @p isIt.
template <std::size_t Count, typename Is>
void refuseAny(const Foreign (&list)[Count], Is&& isIt)
{
  const auto* const found =
    std::find_if(std::begin(list), std::end(list), [&](const Foreign& each) { return isIt(each.mark); });
  if (found != std::end(list))
  {
    const std::string what = found->what;
    throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
      what.substr(0, 4) == "this" ? what : "this is " + what + ", which is not read here", found->cure);
  }
}

/// Refuses a zip archive, which begins with the name of its first file.
void refuseZip(std::string_view bytes)
{
  constexpr std::size_t kHeader = 30;
  if (bytes.substr(0, 4) != "PK\x03\x04")
  {
    return;
  }
  const std::size_t size = bytes.size() < kHeader
    ? 0
    : static_cast<unsigned char>(bytes[26]) + 256U * static_cast<unsigned char>(bytes[27]);
  const std::string_view first = bytes.substr(std::min(kHeader, bytes.size()), size);
  refuseAny(kByZippedName, [&](std::string_view mark) { return first.find(mark) != std::string_view::npos; });
  throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
    "this is a zip archive, which begins with " + inQuotes(first),
    "unpack it and give the cloud in it: python3 -m zipfile -e FILE FOLDER");
}

} // namespace

void refuseForeign(const FormatStart& start)
{
  constexpr std::size_t kLookedAt = 4096;
  refuseZip(start.bytes);
  refuseAny(kByBytes, [&](std::string_view mark) { return start.bytes.substr(0, mark.size()) == mark; });
  const std::string_view head = trimmed(start.bytes.substr(0, kLookedAt));
  const bool isTree = start.isText && !head.empty() && (head.front() == '{' || head.front() == '<');
  refuseAny(
    kByWords, [&](std::string_view mark) { return isTree && head.find(mark) != std::string_view::npos; });
}

void refuseForeignName(const std::string& extension)
{
  refuseAny(kByNames,
    [&](std::string_view names)
    { return (" " + std::string(names) + " ").find(" " + extension + " ") != std::string::npos; });
}

} // namespace pointhaptics::io
