/// @file
/// The header of a LAS file and the records that describe its points, checked before anything of the claimed
/// sizes is allocated. Layouts: ASPRS, LAS Specification 1.4 R15.
#pragma once

#include "Bytes/LittleEndian.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

class vtkFieldData;
class vtkPolyData;

namespace pointhaptics::io
{

struct ReadTask;

/// Byte offsets inside a record of each point format; 0 = the format has no such field.
struct LasPointFormat
{
  std::size_t size;
  std::size_t gpsTime;
  std::size_t rgb;
  std::size_t nearInfrared;
};
constexpr int kMostLasFormat = 10;
constexpr LasPointFormat kLasPointFormats[kMostLasFormat + 1] = {
  { 20, 0, 0, 0 },
  { 28, 20, 0, 0 },
  { 26, 0, 20, 0 },
  { 34, 20, 28, 0 },
  { 57, 20, 0, 0 },
  { 63, 20, 28, 0 },
  { 30, 22, 0, 0 },
  { 36, 22, 30, 0 },
  { 38, 22, 30, 36 },
  { 59, 22, 0, 0 },
  { 67, 22, 30, 36 },
};

/// Where a record has a field: a number, or fewer bits of a byte.
struct LasPlace
{
  std::size_t offset = 0; ///< 0: the formats have no such field
  int type = VTK_TYPE_UINT8;
  int shift = 0;
  int bits = 0; ///< 0: the whole number

  int mask() const { return (1 << bits) - 1; }
};
/// A field that becomes an array of its name, and the array the field.
struct LasField
{
  const char* name;
  int type;            ///< of the array
  LasPlace basic;      ///< point formats 0 to 5
  LasPlace extended;   ///< 6 to 10
  bool isRare = false; ///< most files leave it at zero
  int components = 1;
  std::size_t LasPointFormat::*offset = nullptr; ///< of fields whose place the point format tells

  /// Where records of the point format have it.
  LasPlace placeIn(int format) const
  {
    return offset ? LasPlace{ kLasPointFormats[format].*offset, type } : format >= 6 ? extended : basic;
  }
};
constexpr LasField kLasFields[] = {
  { "Intensity", VTK_TYPE_UINT16, { 12, VTK_TYPE_UINT16 }, { 12, VTK_TYPE_UINT16 } },
  { "ReturnNumber", VTK_TYPE_UINT8, { 14, VTK_TYPE_UINT8, 0, 3 }, { 14, VTK_TYPE_UINT8, 0, 4 } },
  { "NumberOfReturns", VTK_TYPE_UINT8, { 14, VTK_TYPE_UINT8, 3, 3 }, { 14, VTK_TYPE_UINT8, 4, 4 } },
  { "Classification", VTK_TYPE_UINT8, { 15, VTK_TYPE_UINT8, 0, 5 }, { 16, VTK_TYPE_UINT8, 0, 8 } },
  { "ScanAngle", VTK_FLOAT, { 16, VTK_TYPE_INT8 }, { 18, VTK_TYPE_INT16 } },
  { "UserData", VTK_TYPE_UINT8, { 17, VTK_TYPE_UINT8 }, { 17, VTK_TYPE_UINT8 } },
  { "PointSourceId", VTK_TYPE_UINT16, { 18, VTK_TYPE_UINT16 }, { 20, VTK_TYPE_UINT16 } },
  { "ClassificationFlags", VTK_TYPE_UINT8, { 15, VTK_TYPE_UINT8, 5, 3 }, { 15, VTK_TYPE_UINT8, 0, 4 }, true },
  { "ScannerChannel", VTK_TYPE_UINT8, {}, { 15, VTK_TYPE_UINT8, 4, 2 }, true },
  { "ScanDirection", VTK_TYPE_UINT8, { 14, VTK_TYPE_UINT8, 6, 1 }, { 15, VTK_TYPE_UINT8, 6, 1 }, true },
  { "EdgeOfFlightLine", VTK_TYPE_UINT8, { 14, VTK_TYPE_UINT8, 7, 1 }, { 15, VTK_TYPE_UINT8, 7, 1 }, true },
  { "GpsTime", VTK_DOUBLE, {}, {}, false, 1, &LasPointFormat::gpsTime },
  { "Color16", VTK_TYPE_UINT16, {}, {}, false, 3, &LasPointFormat::rgb },
  { "NearInfrared", VTK_TYPE_UINT16, {}, {}, false, 1, &LasPointFormat::nearInfrared },
};
constexpr std::size_t kNumberOfLasFields = std::size(kLasFields);
/// Index of a field. @pre there is one of that name.
constexpr std::size_t lasFieldCalled(std::string_view name)
{
  std::size_t i = 0;
  for (; kLasFields[i].name != name; ++i)
  {
  }
  return i;
}
constexpr std::size_t kLasColor = lasFieldCalled("Color16"); ///< An array of bytes is made of it, too.
constexpr double kLasScanAngleStep = 0.006;                  ///< degrees, extended formats

constexpr std::size_t kLasHeaderOf12 = 227; ///< bytes, also of 1.0 and 1.1
constexpr std::size_t kLasHeaderOf14 = 375;
constexpr std::size_t kLasVlrHeader = 54;
constexpr std::size_t kLasExtraDescriptor = 192;
constexpr std::string_view kLasSpecUser = "LASF_Spec";
constexpr int kLasExtraBytesRecord = 4; ///< of this user
constexpr std::string_view kLasProjectionUser = "LASF_Projection";
constexpr int kLasPackedMark = 0xc0; ///< bits of the point format that LAZ sets
constexpr int kLasPackedBit = 0x80;  ///< the one of them that is written today
constexpr std::string_view kLaszipUser = "laszip encoded";
constexpr int kLaszipRecord = 22204; ///< how the points are compressed

/// One field among the extra bytes of a point.
struct LasExtraField
{
  std::string name;
  int type = 0; ///< VTK type in the record
  int components = 1;
  std::size_t offset = 0;                ///< inside the record
  bool isScaled = false;                 ///< value = scale * stored + shift, as double
  bool hasNoData = false;                ///< a stored value stands for none: NaN
  std::array<std::int64_t, 3> noData{};  ///< of integers
  std::array<double, 3> noDataAsFloat{}; ///< of floating types
  std::string descriptor;                ///< its record of kLasExtraDescriptor bytes; empty: there is none
  std::array<double, 3> scale{ 1, 1, 1 };
  std::array<double, 3> shift{};

  /// The type of the array that holds its values.
  int arrayType() const;
  /// Value that stands for no data: the standard widens it, and some programs fill it up with zeros.
  template <typename T>
  T noDataOf(std::size_t component) const
  {
    return std::is_floating_point_v<T> ? static_cast<T>(noDataAsFloat[component])
                                       : static_cast<T>(noData[component]);
  }
  template <typename T>
  bool isNoData(T stored, std::size_t component) const
  {
    return hasNoData && stored == noDataOf<T>(component);
  }
};

/// Description of a file and its points beside these, byte by byte.
struct LasOrigin
{
  std::string header;     ///< at most kLasHeaderOf14 bytes; empty: the cloud is of no LAS file
  std::string records;    ///< variable length records, but for those of packing and octree
  std::string farRecords; ///< extended ones, which lie behind the points

  /// The origin of a cloud that was read from a LAS file; empty for others.
  static LasOrigin of(vtkFieldData* fieldData);
  void addTo(vtkPolyData* cloud) const;
  bool isHere() const { return header.size() >= kLasHeaderOf12; }
  int minorVersion() const { return isHere() ? byteAt(25) : 0; }
  int pointFormat() const { return isHere() ? byteAt(104) & ~kLasPackedMark : 0; }
  int byteAt(std::size_t place) const { return static_cast<unsigned char>(header[place]); }
};

struct LasHeader
{
  int minorVersion = 0;
  int globalEncoding = 0; ///< bit 0: how gps time counts; bit 4: well-known text
  int pointFormat = 0;
  std::size_t headerSize = 0;
  std::size_t pointsOffset = 0;
  std::size_t recordLength = 0;
  std::uint64_t count = 0;
  std::array<double, 3> scale{};
  std::array<double, 3> offset{};
  std::vector<LasExtraField> extraFields;
  LasOrigin origin;
  std::string generator;        ///< the program that wrote the file; empty when it does not say
  std::string coordinateSystem; ///< WKT or "EPSG:26917"; empty when the file does not say
  std::string lengthUnit;       ///< of a projected system: "metre"; empty when the file does not say
  std::string heightUnit;       ///< where it is said, and another one than lengthUnit (metres with degrees)
  std::string packing;          ///< "LAZ" or "COPC" where the points are compressed, else empty

  bool isExtended() const { return pointFormat >= 6; }
  const LasPointFormat& fields() const { return kLasPointFormats[pointFormat]; }
};

/// True if a file that begins with @p start, of which 400 bytes are enough, is a cloud optimised point cloud.
bool startsLikeCopc(std::string_view start);

/// Reads the header, whose bytes are there, and loads and reads variable length records. @throws FileProblem
/// with byte offset and value; also when the file is too short for the points the header counts, as
/// task.endAt() decides. Compressed points are only recognised: see Laz/LazSchema.h and Laz/LazChunks.h.
LasHeader parseLasHeader(ReadTask& task);

/// The fields that @p descriptors, the content of an extra bytes record, describe in a record of @p length
/// bytes from @p first on. What they do not cover, or all where they cannot be right, is kept as
/// "ExtraBytes".
std::vector<LasExtraField> lasExtraFields(
  std::string_view descriptors, std::size_t first, std::size_t length);

/// A variable length record.
struct LasRecord
{
  std::size_t at = 0;     ///< byte at which it begins
  std::string_view whole; ///< with its header; empty where it is cut
  std::string_view user;
  int id = 0;
  std::string_view content; ///< as much of it as is there
  bool isFar = false;       ///< an extended one, as they lie behind the points

  bool is(std::string_view ofUser, int number) const { return user == ofUser && id == number; }
};

/// At most @p count records, which lie in @p bytes from byte @p at on, as long as their headers are there.
/// @p far: extended ones. @p need: called before a header is looked at.
std::vector<LasRecord> lasRecords(
  std::string_view bytes, std::uint64_t at, std::uint32_t count, bool far,
  const std::function<void(std::size_t, std::size_t)>& need = [](std::size_t, std::size_t) {});
/// All whole ones among those that @p origin keeps, which must outlive them.
std::vector<LasRecord> lasRecords(const LasOrigin& origin);

/// LAS's number for the type of an extra field, and for a VTK type.
int lasTypeCode(int type);

/// The header of a variable length record of @p size bytes. @p description: at most 32 bytes.
std::string lasRecordHeader(
  std::string_view user, int id, std::size_t size, std::string_view description = {});

/// Writes @p value little-endian at @p offset. @pre it lies inside @p bytes.
template <typename T>
void putLittle(std::string& bytes, std::size_t offset, T value)
{
  storeLittle(value, &bytes[offset]);
}

} // namespace pointhaptics::io
