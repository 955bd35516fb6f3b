#include "E57File.h"

#include <cstdio>
#include <cstring>

namespace
{

constexpr std::size_t kPage = 1024;
constexpr std::size_t kContent = 1020;

std::string numberText(double value)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

template <typename T>
void appendLittle(std::string& bytes, T value)
{
  for (std::size_t i = 0; i < sizeof(T); ++i)
  {
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> 8 * i & 0xff);
  }
}

std::uint64_t physicalOf(std::uint64_t logical)
{
  return logical / kContent * kPage + logical % kContent;
}

unsigned bitsFor(std::uint64_t range)
{
  unsigned bits = 0;
  while (bits < 64 && range >> bits != 0)
  {
    ++bits;
  }
  return bits;
}

std::string streamOf(const E57TestField& field)
{
  std::string bytes((field.stored.size() * field.bits + 7) / 8, '\0');
  std::size_t bit = 0;
  for (const std::uint64_t value : field.stored)
  {
    for (unsigned i = 0; i < field.bits; ++i, ++bit)
    {
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] | (value >> i & 1) << bit % 8);
    }
  }
  return bytes;
}

void appendPadded(std::string& logical, std::string packet)
{
  packet.resize((packet.size() + 3) / 4 * 4);
  packet[2] = static_cast<char>((packet.size() - 1) & 0xff);
  packet[3] = static_cast<char>((packet.size() - 1) >> 8);
  logical += packet;
}

void appendPackets(std::string& logical, const E57TestScan& scan)
{
  std::vector<std::string> streams;
  std::size_t longest = 0;
  for (const E57TestField& field : scan.fields)
  {
    streams.push_back(streamOf(field));
    longest = std::max(longest, streams.back().size());
  }
  for (std::size_t at = 0; at < longest; at += scan.bytesPerPart)
  {
    std::string packet(1, '\1');
    packet.resize(4);
    appendLittle(packet, static_cast<std::uint16_t>(streams.size()));
    std::string content;
    for (const std::string& stream : streams)
    {
      const std::string part = at < stream.size() ? stream.substr(at, scan.bytesPerPart) : std::string();
      appendLittle(packet, static_cast<std::uint16_t>(part.size()));
      content += part;
    }
    appendPadded(logical, packet + content);
    // Readers pass over an empty packet, and over an index that leads nowhere.
    appendPadded(logical, at % 2 ? std::string("\2\0\0\0", 4) : std::string(16, '\0'));
  }
}

std::uint32_t checksum(const std::string& page)
{
  std::uint32_t crc = 0xffffffff;
  for (const char c : page)
  {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = crc >> 1 ^ (crc & 1 ? 0x82f63b78 : 0);
    }
  }
  return ~crc;
}

std::string pointsXml(const E57TestScan& scan, std::uint64_t offset)
{
  const std::size_t records = scan.fields.empty() ? 0 : scan.fields.front().stored.size();
  std::string xml = "<points type=\"CompressedVector\" fileOffset=\"" + std::to_string(offset) +
    "\" recordCount=\"" + (scan.recordCount.empty() ? std::to_string(records) : scan.recordCount) +
    "\"><prototype type=\"Structure\">";
  for (const E57TestField& field : scan.fields)
  {
    xml += "<" + field.name + " " + field.attributes + "/>\n";
  }
  return xml + "</prototype><codecs type=\"Vector\"></codecs></points>";
}

} // namespace

E57TestField e57Integer(const std::string& name, std::int64_t minimum, std::int64_t maximum,
  const std::vector<std::int64_t>& values, const std::string& type, const std::string& more)
{
  E57TestField field;
  field.name = name;
  field.attributes = "type=\"" + type + "\" minimum=\"" + std::to_string(minimum) + "\" maximum=\"" +
    std::to_string(maximum) + "\"" + more;
  field.bits = bitsFor(static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(minimum));
  for (const std::int64_t value : values)
  {
    field.stored.push_back(static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(minimum));
  }
  return field;
}

E57TestField e57Scaled(const std::string& name, std::int64_t minimum, std::int64_t maximum, double scale,
  double offset, const std::vector<std::int64_t>& values)
{
  return e57Integer(name, minimum, maximum, values, "ScaledInteger",
    " scale=\"" + numberText(scale) + "\" offset=\"" + numberText(offset) + "\"");
}

E57TestField e57Float(const std::string& name, const std::vector<float>& values)
{
  E57TestField field{ name, "type=\"Float\" precision=\"single\"", 32, {} };
  for (const float value : values)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    field.stored.push_back(bits);
  }
  return field;
}

E57TestField e57Double(const std::string& name, const std::vector<double>& values)
{
  E57TestField field{ name, "type=\"Float\"", 64, {} };
  for (const double value : values)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    field.stored.push_back(bits);
  }
  return field;
}

std::string e57Pose(const std::vector<double>& rotation, const std::vector<double>& translation)
{
  std::string xml = "<pose type=\"Structure\"><rotation type=\"Structure\">";
  const std::string names = "wxyz";
  for (std::size_t i = 0; i < 4; ++i)
  {
    xml += std::string("<") + names[i] + " type=\"Float\">" + numberText(rotation[i]) + "</" + names[i] + ">";
  }
  xml += "</rotation><translation type=\"Structure\">";
  for (std::size_t i = 0; i < 3; ++i)
  {
    xml += std::string("<") + names[i + 1] + " type=\"Float\">" + numberText(translation[i]) + "</" +
      names[i + 1] + ">";
  }
  return xml + "</translation></pose>";
}

std::string e57Physical(const std::string& logical)
{
  std::string file;
  for (std::size_t at = 0; at < logical.size(); at += kContent)
  {
    std::string page = logical.substr(at, kContent);
    page.resize(kContent);
    const std::uint32_t crc = checksum(page);
    for (int shift = 24; shift >= 0; shift -= 8)
    {
      page += static_cast<char>(crc >> shift & 0xff);
    }
    file += page;
  }
  return file;
}

std::string e57Logical(const std::string& file)
{
  std::string logical;
  for (std::size_t at = 0; at < file.size(); at += kPage)
  {
    logical += file.substr(at, kContent);
  }
  return logical;
}

std::string E57TestFile::bytes() const
{
  std::string logical(48, '\0');
  std::string scansXml;
  std::uint64_t first = 0;
  for (const E57TestScan& scan : scans)
  {
    const std::uint64_t section = logical.size();
    first = first == 0 ? section : first;
    std::string packets;
    appendPackets(packets, scan);
    logical += std::string("\1\0\0\0\0\0\0\0", 8);
    appendLittle(logical, static_cast<std::uint64_t>(32 + packets.size()));
    appendLittle(logical, physicalOf(section + 32));
    appendLittle(logical, std::uint64_t{ 0 });
    logical += packets;
    scansXml += "<vectorChild type=\"Structure\">" + scan.xml +
      pointsXml(scan, physicalOf(sharesSection ? first : section)) + "</vectorChild>\n";
  }
  const std::string document = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + prologue +
    "<e57Root type=\"Structure\" xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\">\n" + xml +
    "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n" + scansXml + "</data3D>\n</e57Root>\n";
  const std::uint64_t xmlAt = logical.size();
  logical += document;
  const std::uint64_t length = (logical.size() + kContent - 1) / kContent * kPage;
  std::string header = "ASTM-E57";
  appendLittle(header, std::uint32_t{ 1 });
  appendLittle(header, std::uint32_t{ 0 });
  appendLittle(header, length);
  appendLittle(header, physicalOf(xmlAt));
  appendLittle(header, static_cast<std::uint64_t>(document.size()));
  appendLittle(header, std::uint64_t{ kPage });
  logical.replace(0, header.size(), header);
  return e57Physical(logical);
}
