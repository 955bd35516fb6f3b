#include "Benchmark/Io/E57File.h"

#include <fmt/format.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace pointhaptics
{
namespace bench
{
namespace io
{
namespace
{

constexpr std::size_t kPage = 1024;
constexpr std::size_t kContent = 1020;
constexpr std::size_t kStreams = 7;
/// Points of a packet: 31 bytes each, and at most 65536 bytes together.
constexpr std::size_t kPacketPoints = 2000;

template <typename T>
void append(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::uint64_t physical(std::uint64_t logical)
{
  return logical / kContent * kPage + logical % kContent;
}

std::array<std::uint32_t, 256> makeTable()
{
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte)
  {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = crc >> 1 ^ (crc & 1 ? 0x82f63b78u : 0u);
    }
    table[byte] = crc;
  }
  return table;
}

std::string paged(const std::string& logical)
{
  static const std::array<std::uint32_t, 256> table = makeTable();
  std::string file;
  file.reserve((logical.size() / kContent + 1) * kPage);
  for (std::size_t at = 0; at < logical.size(); at += kContent)
  {
    const std::size_t begin = file.size();
    file.append(logical, at, kContent);
    file.resize(begin + kContent);
    std::uint32_t crc = ~0u;
    for (std::size_t i = begin; i < file.size(); ++i)
    {
      crc = crc >> 8 ^ table[(crc ^ static_cast<unsigned char>(file[i])) & 0xff];
    }
    for (int shift = 24; shift >= 0; shift -= 8)
    {
      file += char(~crc >> shift & 0xff);
    }
  }
  return file;
}

std::string packetOf(vtkPolyData* cloud, vtkIdType first, vtkIdType last)
{
  vtkFloatArray* intensity = vtkFloatArray::SafeDownCast(cloud->GetPointData()->GetArray("intensity"));
  vtkUnsignedCharArray* colour = vtkUnsignedCharArray::SafeDownCast(cloud->GetPointData()->GetArray("RGB"));
  std::array<std::string, kStreams> streams;
  for (vtkIdType i = first; i < last; ++i)
  {
    double p[3];
    cloud->GetPoint(i, p);
    for (int axis = 0; axis < 3; ++axis)
    {
      append(streams[std::size_t(axis)], p[axis]);
      streams[std::size_t(4 + axis)] += char(colour->GetValue(3 * i + axis));
    }
    append(streams[3], intensity->GetValue(i));
  }
  std::string packet("\1\0\0\0", 4);
  append(packet, std::uint16_t{ kStreams });
  for (const std::string& stream : streams)
  {
    append(packet, std::uint16_t(stream.size()));
  }
  for (const std::string& stream : streams)
  {
    packet += stream;
  }
  packet.resize((packet.size() + 3) / 4 * 4);
  const std::uint16_t lengthLessOne = std::uint16_t(packet.size() - 1);
  packet.replace(2, 2, reinterpret_cast<const char*>(&lengthLessOne), 2);
  return packet;
}

std::string xmlOf(vtkIdType points)
{
  std::string fields;
  for (const char* name : { "cartesianX", "cartesianY", "cartesianZ" })
  {
    fields += fmt::format("<{} type=\"Float\"/>", name);
  }
  fields += "<intensity type=\"Float\" precision=\"single\"/>";
  for (const char* name : { "colorRed", "colorGreen", "colorBlue" })
  {
    fields += fmt::format("<{} type=\"Integer\" minimum=\"0\" maximum=\"255\"/>", name);
  }
  return fmt::format(
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<e57Root type=\"Structure\" xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\">"
    "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\"><vectorChild type=\"Structure\">"
    "<points type=\"CompressedVector\" fileOffset=\"48\" recordCount=\"{}\">"
    "<prototype type=\"Structure\">{}</prototype><codecs type=\"Vector\"/></points>"
    "</vectorChild></data3D></e57Root>\n",
    points, fields);
}

} // namespace

std::string asE57(vtkPolyData* cloud)
{
  const vtkIdType points = cloud->GetNumberOfPoints();
  std::string packets;
  for (vtkIdType first = 0; first < points; first += vtkIdType{ kPacketPoints })
  {
    packets += packetOf(cloud, first, std::min(points, first + vtkIdType{ kPacketPoints }));
  }
  const std::string xml = xmlOf(points);
  constexpr std::uint64_t kHeader = 48;
  constexpr std::uint64_t kSection = 32;
  const std::uint64_t xmlAt = kHeader + kSection + packets.size();
  std::string logical = "ASTM-E57";
  append(logical, std::uint32_t{ 1 });
  append(logical, std::uint32_t{ 0 });
  append(logical, std::uint64_t((xmlAt + xml.size() + kContent - 1) / kContent * kPage));
  append(logical, physical(xmlAt));
  append(logical, std::uint64_t(xml.size()));
  append(logical, std::uint64_t{ kPage });
  append(logical, std::uint64_t{ 1 }); // a section of compressed vectors
  append(logical, std::uint64_t(kSection + packets.size()));
  append(logical, std::uint64_t{ kHeader + kSection });
  append(logical, std::uint64_t{ 0 });
  return paged(logical + packets + xml);
}

} // namespace io
} // namespace bench
} // namespace pointhaptics
