// Stands in for LASzip in the tests: the files it reads are LAZ in everything but the compression. The points
// lie one after the other behind the eight bytes that say where the table of chunks is.
#include "LaszipStandIn.h"

#include <laszip/laszip_api.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace
{

int openReaders = 0;

struct Reader
{
  std::ifstream file;
  std::string error;
  std::vector<char> record;
  std::vector<std::uint8_t> extra;
  laszip_point_struct point = {};
  int format = 0;
  std::uint64_t count = 0;
  std::uint64_t done = 0;

  template <typename T>
  T number(std::size_t at) const
  {
    T value;
    std::memcpy(&value, record.data() + at, sizeof(T));
    return value;
  }
  unsigned bits(std::size_t at, int first, int size) const
  {
    return number<std::uint8_t>(at) >> first & ((1u << size) - 1);
  }
  bool read(std::streamoff at, std::size_t size)
  {
    record.assign(size, '\0');
    file.clear();
    file.seekg(at);
    return static_cast<bool>(file.read(record.data(), static_cast<std::streamsize>(size)));
  }
  void unpackLegacy();
  void unpackExtended();
};

void Reader::unpackLegacy()
{
  point.return_number = bits(14, 0, 3) & 7;
  point.number_of_returns = bits(14, 3, 3) & 7;
  point.classification = bits(15, 0, 5) & 31;
  point.synthetic_flag = bits(15, 5, 1) & 1;
  point.keypoint_flag = bits(15, 6, 1) & 1;
  point.withheld_flag = bits(15, 7, 1) & 1;
  point.scan_direction_flag = bits(14, 6, 1) & 1;
  point.edge_of_flight_line = bits(14, 7, 1) & 1;
  point.scan_angle_rank = number<std::int8_t>(16);
  point.user_data = number<std::uint8_t>(17);
  point.point_source_ID = number<std::uint16_t>(18);
  std::size_t at = 20;
  if (format == 1 || format >= 3)
  {
    point.gps_time = number<double>(at);
    at += 8;
  }
  for (std::size_t channel = 0; channel < 3 && (format == 2 || format == 3 || format == 5); ++channel)
  {
    point.rgb[channel] = number<std::uint16_t>(at + 2 * channel);
  }
}

void Reader::unpackExtended()
{
  point.extended_return_number = bits(14, 0, 4) & 15;
  point.extended_number_of_returns = bits(14, 4, 4) & 15;
  point.extended_classification_flags = bits(15, 0, 4) & 15;
  point.extended_scanner_channel = bits(15, 4, 2) & 3;
  point.scan_direction_flag = bits(15, 6, 1) & 1;
  point.edge_of_flight_line = bits(15, 7, 1) & 1;
  point.extended_classification = number<std::uint8_t>(16);
  point.user_data = number<std::uint8_t>(17);
  point.extended_scan_angle = number<std::int16_t>(18);
  point.point_source_ID = number<std::uint16_t>(20);
  point.gps_time = number<double>(22);
  const std::size_t channels = format == 7 ? 3 : (format == 8 || format == 10 ? 4 : 0);
  for (std::size_t channel = 0; channel < channels; ++channel)
  {
    point.rgb[channel] = number<std::uint16_t>(30 + 2 * channel);
  }
}

} // namespace

int openLaszipReaders()
{
  return openReaders;
}

laszip_I32 laszip_create(laszip_POINTER* pointer)
{
  *pointer = new Reader;
  ++openReaders;
  return 0;
}

laszip_I32 laszip_destroy(laszip_POINTER pointer)
{
  delete static_cast<Reader*>(pointer);
  --openReaders;
  return 0;
}

laszip_I32 laszip_get_error(laszip_POINTER pointer, laszip_CHAR** error)
{
  *error = static_cast<Reader*>(pointer)->error.data();
  return 0;
}

laszip_I32 laszip_open_reader(
  laszip_POINTER pointer, const laszip_CHAR* file_name, laszip_BOOL* is_compressed)
{
  Reader& reader = *static_cast<Reader*>(pointer);
  reader.file.open(file_name, std::ios::binary);
  if (!reader.read(0, 227))
  {
    reader.error = "reading the header";
    return 1;
  }
  const std::size_t sizes[] = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67 };
  reader.format = reader.number<std::uint8_t>(104) & 63;
  reader.count = reader.number<std::uint32_t>(107);
  const std::size_t length = reader.number<std::uint16_t>(105);
  const std::uint32_t points = reader.number<std::uint32_t>(96);
  if (reader.number<std::uint8_t>(25) == 4 && reader.read(0, 375) && reader.number<std::uint64_t>(247) != 0)
  {
    reader.count = reader.number<std::uint64_t>(247);
  }
  if (reader.number<std::uint8_t>(6) == 99)
  {
    reader.error = "a version this LASzip does not know";
    return 1;
  }
  reader.extra.resize(length - sizes[reader.format]);
  reader.point.num_extra_bytes = static_cast<std::int32_t>(reader.extra.size());
  reader.point.extra_bytes = reader.extra.empty() ? nullptr : reader.extra.data();
  reader.record.resize(length);
  reader.file.seekg(points + 8);
  *is_compressed = 1;
  return 0;
}

laszip_I32 laszip_get_point_pointer(laszip_POINTER pointer, laszip_point_struct** point)
{
  *point = &static_cast<Reader*>(pointer)->point;
  return 0;
}

laszip_I32 laszip_read_point(laszip_POINTER pointer)
{
  Reader& reader = *static_cast<Reader*>(pointer);
  if (!reader.file.read(reader.record.data(), static_cast<std::streamsize>(reader.record.size())))
  {
    reader.error = "reading point " + std::to_string(reader.done) + " of " + std::to_string(reader.count) +
      " total points";
    return 1;
  }
  ++reader.done;
  reader.point.X = reader.number<std::int32_t>(0);
  reader.point.Y = reader.number<std::int32_t>(4);
  reader.point.Z = reader.number<std::int32_t>(8);
  reader.point.intensity = reader.number<std::uint16_t>(12);
  reader.format < 6 ? reader.unpackLegacy() : reader.unpackExtended();
  std::copy_n(reader.record.end() - static_cast<std::ptrdiff_t>(reader.extra.size()), reader.extra.size(),
    reader.extra.begin());
  return 0;
}
