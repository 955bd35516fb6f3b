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
  const char* what;
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
  { "glTF", "this is a glTF file (GLB), which is not read here", kMesh },
  { "DRACO", "this is a Draco file, which is not read here",
    "unpack it: draco_decoder -i FILE -o cloud.ply" },
  { "II*\0"_bytes, "this is a TIFF picture (GeoTIFF), which is not read here", kRaster },
  { "MM\0*"_bytes, "this is a TIFF picture (GeoTIFF), which is not read here", kRaster },
  { "II+\0"_bytes, "this is a TIFF picture (GeoTIFF), which is not read here", kRaster },
  { "#ROSBAG", "this is a ROS bag, which is not read here", kBag },
  { "SQLite format 3", "this is an SQLite database (a ROS 2 bag or a GeoPackage), which is not read here",
    kBag },
  { "\x89MCAP", "this is an MCAP file of ROS 2, which is not read here", kBag },
  { "\xd4\xc3\xb2\xa1", "this is a pcap file of network packets, which is not read here", kPcap },
  { "\xa1\xb2\xc3\xd4", "this is a pcap file of network packets, which is not read here", kPcap },
  { "\x4d\x3c\xb2\xa1", "this is a pcap file of network packets, which is not read here", kPcap },
  { "\x0a\x0d\x0d\x0a", "this is a pcapng file of network packets, which is not read here", kPcap },
  { "pnts", "this is a tile of 3D Tiles, which is not read here", kCells },
  { "b3dm", "this is a tile of 3D Tiles, which is not read here", kMesh },
  { "i3dm", "this is a tile of 3D Tiles, which is not read here", kMesh },
  { "cmpt", "this is a tile of 3D Tiles, which is not read here", kMesh },
  { "CCB", "this is a file of CloudCompare (BIN), which is not read here",
    "save it as E57, PLY or LAS: CloudCompare -O FILE -C_EXPORT_FMT PLY -SAVE_CLOUDS" },
  { "\x89HDF", "this is an HDF5 file, which is not read here",
    "write its points as .npy: python3 with h5py and numpy.save" },
  { "Kaydara FBX", "this is an FBX file, which is not read here", kMesh },
  { "BLENDER", "this is a file of Blender, which is not read here", kMesh },
  { "ISO-10303-21", "this is a STEP file, which is not read here", kMesh },
  { "NGSP", "this is a Gaussian splat file (SPZ), which is not read here",
    "save it as PLY with the viewer that wrote it, or SuperSplat" },
  { "version https://git-lfs", "this is a pointer of Git LFS, not the file", "fetch the file: git lfs pull" },
};

/// By what stands near the start of a text that begins with '{' or '<'.
const Foreign kByWords[] = {
  { "\"geometricError\"", "this is the list of a 3D Tiles set, which is not read here", kCells },
  { "\"octreeDir\"", "this is the description of a Potree cloud, which is not read here", kCells },
  { "\"hierarchy\"", "this is the description of a Potree cloud, which is not read here", kCells },
  { "\"hierarchyType\"", "this is the description of an EPT cloud, which is not read here", kCells },
  { "\"asset\"", "this is a glTF file, which is not read here", kMesh },
  { "<LandXML", "this is a LandXML file, which is not read here",
    "export its points as text with x, y and z, or as LAS" },
  { "<html", "this is a web page, not a point cloud", "the download failed: fetch the file again" },
  { "<!DOCTYPE html", "this is a web page, not a point cloud", "the download failed: fetch the file again" },
  { "<COLLADA", "this is a COLLADA file, which is not read here", kMesh },
  { "<X3D", "this is an X3D file, which is not read here", kMesh },
  { "{", "this is JSON, which is not read here", "write the points as columns of text: x y z" },
};

/// By the extension, where the content tells nothing.
const Foreign kByNames[] = {
  { "rxp rdbx", "this is a file of a RIEGL scanner, which is not read here",
    "export it as LAZ or E57 with RiSCAN PRO or RDB tools" },
  { "fls fws lsproj", "this is a file of a FARO scanner, which is not read here",
    "export it as E57 with FARO SCENE" },
  { "zfs", "this is a file of a Zoller + Froehlich scanner, which is not read here",
    "export it as E57 with Z+F LaserControl" },
  { "rcp rcs", "this is a file of Autodesk ReCap, which is not read here", "export it as E57 with ReCap" },
  { "ptg lgs lgsx imp pod cl3 clr tzf 3dd", "this is a scanner program's own format, which is not read here",
    "export it as E57, LAZ or PTX with the program that wrote it" },
  { "bin", "this is a binary file of an unknown kind (Potree node, CloudCompare, raw numbers)",
    "raw float32 x y z intensity (KITTI) and x y z intensity ring (nuScenes) are read; save others as PLY" },
  { "dxf dwg", "this is a drawing, which is not read here", "export its points as text with x, y and z" },
  { "usd usda usdc", "this is a USD scene, which is not read here", kMesh },
};

/// By the name of the first file in a zip archive.
const Foreign kByZippedName[] = {
  { ".usd", "this is a USDZ scene, which is not read here", kMesh },
  { ".npy", "this is a NumPy archive (npz)",
    "write one array of it as .npy: numpy.save('cloud.npy', points)" },
  { ".kml", "this is a KMZ file of a map, which is not read here", "export the points as LAS or text" },
};

/// Refuses what the first entry of @p list says for whose mark @p isIt.
template <std::size_t Count, typename Is>
void refuseAny(const Foreign (&list)[Count], Is&& isIt)
{
  const auto* const found =
    std::find_if(std::begin(list), std::end(list), [&](const Foreign& each) { return isIt(each.mark); });
  if (found != std::end(list))
  {
    throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError, found->what, found->cure);
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
