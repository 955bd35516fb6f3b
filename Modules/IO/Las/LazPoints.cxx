#include "IO/Las/LazPoints.h"

#include "IO/Las/LasHeader.h"
#include "IO/Las/LazLayout.h"
#include "ReadTask.h"

#include <laszip/laszip_api.h>

#include <new>

namespace pointhaptics::io
{

namespace
{

template <typename T>
void storeLittle(T value, char* to) noexcept
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if constexpr (!kIsLittleEndianHost)
  {
    std::reverse(raw, raw + sizeof(T));
  }
  std::memcpy(to, raw, sizeof(T));
}

char byteOf(unsigned bits) noexcept
{
  return static_cast<char>(bits & 0xff);
}

/// Bytes 14 to 19 of point formats 0 to 5.
void storeLegacy(const laszip_point_struct& point, char* record) noexcept
{
  record[14] = byteOf(point.return_number | point.number_of_returns << 3 | point.scan_direction_flag << 6 |
    point.edge_of_flight_line << 7);
  record[15] = byteOf(
    point.classification | point.synthetic_flag << 5 | point.keypoint_flag << 6 | point.withheld_flag << 7);
  record[16] = static_cast<char>(point.scan_angle_rank);
  record[17] = static_cast<char>(point.user_data);
  storeLittle(static_cast<std::uint16_t>(point.point_source_ID), record + 18);
}

/// Bytes 14 to 21 of point formats 6 to 10.
void storeExtended(const laszip_point_struct& point, char* record) noexcept
{
  record[14] = byteOf(point.extended_return_number | point.extended_number_of_returns << 4);
  record[15] = byteOf(point.extended_classification_flags | point.extended_scanner_channel << 4 |
    point.scan_direction_flag << 6 | point.edge_of_flight_line << 7);
  record[16] = static_cast<char>(point.extended_classification);
  record[17] = static_cast<char>(point.user_data);
  storeLittle(static_cast<std::int16_t>(point.extended_scan_angle), record + 18);
  storeLittle(static_cast<std::uint16_t>(point.point_source_ID), record + 20);
}

} // namespace

/// One of LASzip's readers and a block of records.
struct LazPoints::Unpacker
{
  explicit Unpacker(const LasHeader& lasHeader)
    : header(lasHeader)
  {
    if (laszip_create(&reader) != 0 || !reader)
    {
      throw std::bad_alloc();
    }
  }
  ~Unpacker() { laszip_destroy(reader); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  [[noreturn]] void fail(const std::string& where) const;
  void open(const std::string& path);
  void store(char* record) const noexcept;

  const LasHeader& header;
  laszip_POINTER reader = nullptr;
  laszip_point_struct* point = nullptr;
  std::uint64_t done = 0;
  std::vector<char> records;
};

void LazPoints::Unpacker::fail(const std::string& where) const
{
  laszip_CHAR* message = nullptr;
  const bool isTold = laszip_get_error(reader, &message) == 0 && message && *message;
  failFormat(where + (isTold ? "LASzip: " + std::string(message) : "LASzip gives no reason"),
    "the file is cut short or damaged: copy or compress it again");
}

void LazPoints::Unpacker::open(const std::string& path)
{
  laszip_BOOL isCompressed = 0;
  if (laszip_open_reader(reader, path.c_str(), &isCompressed) != 0 ||
    laszip_get_point_pointer(reader, &point) != 0)
  {
    fail("");
  }
  const std::size_t extra = header.recordLength - header.fields().size;
  const bool hasExtra = point->num_extra_bytes > 0 && point->extra_bytes;
  if ((hasExtra ? static_cast<std::size_t>(point->num_extra_bytes) : 0) != extra)
  {
    failFormat("LASzip finds other records than the header describes",
      "wait until the file is written, then "
      "read it again");
  }
}

void LazPoints::Unpacker::store(char* record) const noexcept
{
  const LasPointFormat& fields = header.fields();
  storeLittle(static_cast<std::int32_t>(point->X), record);
  storeLittle(static_cast<std::int32_t>(point->Y), record + 4);
  storeLittle(static_cast<std::int32_t>(point->Z), record + 8);
  storeLittle(static_cast<std::uint16_t>(point->intensity), record + 12);
  header.isExtended() ? storeExtended(*point, record) : storeLegacy(*point, record);
  if (fields.gpsTime != 0)
  {
    storeLittle(static_cast<double>(point->gps_time), record + fields.gpsTime);
  }
  for (std::size_t channel = 0; channel < 3 && fields.rgb != 0; ++channel)
  {
    storeLittle(static_cast<std::uint16_t>(point->rgb[channel]), record + fields.rgb + 2 * channel);
  }
  if (fields.nearInfrared != 0)
  {
    storeLittle(static_cast<std::uint16_t>(point->rgb[3]), record + fields.nearInfrared);
  }
  if (header.recordLength > fields.size)
  {
    std::memcpy(record + fields.size, point->extra_bytes, header.recordLength - fields.size);
  }
}

LazPoints::LazPoints(const ReadTask& task, const LasHeader& header)
{
  if (task.wasPacked)
  {
    failFormat("a " + header.packing + " file inside a gzip file", "unpack it first: gunzip -k FILE");
  }
  checkLazLayout(task.bytes, header);
  unpacker_ = std::make_unique<Unpacker>(header);
  unpacker_->open(task.path);
}

LazPoints::~LazPoints() = default;

const char* LazPoints::next(vtkIdType count)
{
  Unpacker& unpacker = *unpacker_;
  const std::size_t length = unpacker.header.recordLength;
  unpacker.records.resize(static_cast<std::size_t>(count) * length);
  for (char* record = unpacker.records.data(); count > 0; --count, record += length, ++unpacker.done)
  {
    if (laszip_read_point(unpacker.reader) != 0)
    {
      unpacker.fail(
        "point " + std::to_string(unpacker.done) + " of " + std::to_string(unpacker.header.count) + ": ");
    }
    unpacker.store(record);
  }
  return unpacker.records.data();
}

} // namespace pointhaptics::io
