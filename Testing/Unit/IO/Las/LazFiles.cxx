#include "LazFiles.h"

#include "CloudFiles.h"

#include "IO/Las/LasHeader.h"
#include "IO/Las/Laz/ChunkCoding.h"
#include "ReadTask.h"

#include <array>
#include <cmath>
#include <random>

namespace io = pointhaptics::io;

std::string lasOf(int format, std::size_t extra, const std::string& records)
{
  const std::size_t length = kRecordLengths[format] + extra;
  std::string las = makeLas(4, format, length);
  las.resize(375);
  put(las, 247, std::uint64_t{ records.size() / length });
  return las + records;
}

LazFile lazOf(int format, std::size_t extra, const std::string& records, const LazLayout& layout)
{
  std::string header = lasOf(format, extra, records).substr(0, 375);
  const std::size_t length = kRecordLengths[format] + extra;
  io::LazSchema schema = io::makeLazSchema(format, length);
  schema.chunkSize = layout.isVariable ? io::LazSchema::kVariableChunks : layout.chunkSize;
  schema.compressor =
    layout.table == LazTable::NoChunks ? io::LazSchema::Compressor::Pointwise : schema.compressor;
  const std::string content = io::lazRecord(schema);
  std::string record(54, '\0');
  record.replace(2, 14, "laszip encoded");
  put(record, 18, std::uint16_t{ 22204 });
  put(record, 20, static_cast<std::uint16_t>(content.size()));
  header[104] = static_cast<char>(format | 0x80);
  put(header, 96, static_cast<std::uint32_t>(375 + record.size() + content.size()));
  put(header, 100, std::uint32_t{ 1 });

  LazFile laz{ header + record + content, 375 + 54, 375 + record.size() + content.size(), 0 };
  std::string points;
  std::vector<io::LazChunk> chunks;
  std::string copy = records;
  const std::size_t count = records.size() / length;
  for (std::size_t at = 0; at < count;)
  {
    const std::size_t wanted = layout.table == LazTable::NoChunks ? count
      : layout.isVariable                                         ? chunks.size() + 1
                                                                  : layout.chunkSize;
    const std::size_t size = std::min(wanted, count - at);
    const std::string chunk = io::encodeChunk(schema, &copy[at * length], size);
    chunks.push_back({ 0, chunk.size(), at, size });
    points += chunk;
    at += size;
  }
  EXPECT_EQ(copy, records);
  if (layout.table == LazTable::NoChunks)
  {
    laz.bytes += points;
    return laz;
  }
  laz.table = layout.table == LazTable::Missing ? 0 : laz.points + 8 + points.size();
  const std::uint64_t offset = layout.table == LazTable::Missing ? laz.points
    : layout.table == LazTable::AtTheEnd                         ? ~std::uint64_t{ 0 }
                                                                 : laz.table;
  append(laz.bytes, offset);
  laz.bytes += points;
  if (laz.table != 0)
  {
    laz.bytes += io::lazChunkTable(chunks, schema);
  }
  if (layout.table == LazTable::AtTheEnd)
  {
    append(laz.bytes, std::uint64_t{ laz.table });
  }
  return laz;
}

namespace
{

struct CopcNode
{
  int level;
  int cell[3];
};

/// @p count points in the cell of @p node.
std::string recordsIn(const CopcNode& node, std::size_t count, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  std::string records = randomRecords(6, 0, count, seed, true);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int side = 1024 >> node.level;
      put(records, 30 * i + 4 * axis,
        static_cast<std::int32_t>(
          side * node.cell[axis] + static_cast<int>(random() % static_cast<unsigned>(side))));
    }
  }
  return records;
}

void appendEntry(std::string& page, const CopcNode& node, std::uint64_t offset, std::size_t size, int count)
{
  append(page, std::int32_t{ node.level });
  for (const int cell : node.cell)
  {
    append(page, std::int32_t{ cell });
  }
  append(page, offset);
  append(page, static_cast<std::int32_t>(size));
  append(page, std::int32_t{ count });
}

std::string recordHeader(const std::string& user, int id, std::size_t size)
{
  std::string record(54, '\0');
  record.replace(2, user.size(), user);
  put(record, 18, static_cast<std::uint16_t>(id));
  put(record, 20, static_cast<std::uint16_t>(size));
  return record;
}

std::string infoOf512Units()
{
  std::string info(160, '\0');
  for (std::size_t i = 0; i < 4; ++i)
  {
    put(info, 8 * i, 512.0); // centre and half size
  }
  put(info, 32, 16.0); // spacing
  return info;
}

/// The two pages of the hierarchy in their extended record.
void appendHierarchy(
  CopcFile& copc, const std::vector<CopcNode>& nodes, const std::vector<io::LazChunk>& chunks)
{
  constexpr std::size_t kInRootPage = 3;
  std::string evlr(60, '\0');
  evlr.replace(2, 4, "copc");
  put(evlr, 18, std::uint16_t{ 1000 });
  put(evlr, 20, std::uint64_t{ (nodes.size() + 1) * 32 });
  copc.bytes += evlr;
  copc.rootPage = copc.bytes.size();
  copc.secondPage = copc.rootPage + 32 * (kInRootPage + 1);
  std::string pages;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    if (i == kInRootPage)
    {
      appendEntry(pages, { 2, { 0, 1, 0 } }, copc.secondPage, 32 * (nodes.size() - kInRootPage), -1);
    }
    appendEntry(pages, nodes[i], chunks[i].offset, chunks[i].size, static_cast<int>(chunks[i].count));
  }
  copc.bytes += pages;
  put(copc.bytes, copc.info + 40, std::uint64_t{ copc.rootPage });
  put(copc.bytes, copc.info + 48, std::uint64_t{ 32 * (kInRootPage + 1) });
}

} // namespace

CopcFile makeCopc(std::size_t pointsOfNode)
{
  const std::vector<CopcNode> nodes = { { 0, { 0, 0, 0 } }, { 1, { 0, 0, 0 } }, { 1, { 1, 0, 1 } },
    { 2, { 0, 1, 0 } }, { 3, { 1, 3, 0 } } };
  CopcFile copc;
  std::string header = lasOf(6, 0, recordsIn(nodes[0], pointsOfNode, 0)).substr(0, 375);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    put(header, 131 + 8 * axis, 1.0);
    put(header, 155 + 8 * axis, 0.0);
  }
  io::LazSchema schema = io::makeLazSchema(6, kRecordLengths[6]);
  schema.chunkSize = io::LazSchema::kVariableChunks;
  const std::string description = io::lazRecord(schema);
  copc.info = 375 + 54;
  copc.bytes = header + recordHeader("copc", 1, 160) + infoOf512Units() +
    recordHeader("laszip encoded", 22204, description.size()) + description;
  put(copc.bytes, 96, static_cast<std::uint32_t>(copc.bytes.size()));
  put(copc.bytes, 100, std::uint32_t{ 2 });
  copc.bytes[104] = static_cast<char>(6 | 0x80);
  const std::size_t points = copc.bytes.size();
  append(copc.bytes, std::uint64_t{ 0 });
  std::vector<io::LazChunk> chunks;
  for (const CopcNode& node : nodes)
  {
    std::string records = recordsIn(node, pointsOfNode, chunks.size() + 1);
    copc.records += records;
    const std::string chunk = io::encodeChunk(schema, records.data(), records.size() / 30);
    copc.chunks.push_back(copc.bytes.size());
    chunks.push_back({ copc.bytes.size(), chunk.size(), 0, records.size() / 30 });
    copc.bytes += chunk;
  }
  put(copc.bytes, points, std::uint64_t{ copc.bytes.size() });
  copc.bytes += io::lazChunkTable(chunks, schema);
  put(copc.bytes, 235, std::uint64_t{ copc.bytes.size() });
  put(copc.bytes, 243, std::uint32_t{ 1 });
  put(copc.bytes, 247, std::uint64_t{ copc.records.size() / 30 });
  appendHierarchy(copc, nodes, chunks);
  return copc;
}

std::string randomRecords(int format, std::size_t extra, std::size_t count, std::uint64_t seed, bool calm)
{
  const std::size_t length = kRecordLengths[format] + extra;
  std::mt19937_64 random(seed);
  std::string records(count * length, '\0');
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    const bool isKept = calm && i >= length && random() % 8 != 0;
    records[i] = isKept ? records[i - length] : static_cast<char>(random());
  }
  const std::size_t gpsTime = format < 6 ? 20 : 22;
  double time = 0.0;
  for (std::size_t i = 0; i < count && format != 0 && format != 2; ++i)
  {
    const std::uint64_t kind = random() % 8;
    time = kind == 0 ? static_cast<double>(random()) * 1e-6
      : kind < 6     ? time + 1e-4 * static_cast<double>(kind)
                     : time;
    put(records, i * length + gpsTime, time);
  }
  return records;
}

std::string recordsOf(const std::string& bytes)
{
  io::ReadTask task;
  task.bytes = bytes;
  const io::LasHeader header = io::parseLasHeader(task);
  const io::LazSchema schema = io::parseLazSchema(bytes, header);
  const io::LazChunks chunks = io::findLazChunks(task, header, schema);
  EXPECT_TRUE(chunks.arePlaced);
  std::string records(header.count * header.recordLength, '\0');
  io::ChunkDecoder decoder(schema);
  for (const io::LazChunk& chunk : chunks.all)
  {
    decoder.start(bytes, chunk);
    decoder.next(&records[chunk.first * header.recordLength], chunk.count);
  }
  return records;
}

namespace
{

std::uint32_t rotated(std::uint32_t value, unsigned by)
{
  return value >> by | value << (32 - by);
}

/// The first 32 bits of the fractional part of the root of @p prime, @p isCube: the third, else the square
/// root.
std::uint32_t rootBits(unsigned prime, bool isCube)
{
  const long double root =
    isCube ? std::cbrt(static_cast<long double>(prime)) : std::sqrt(static_cast<long double>(prime));
  return static_cast<std::uint32_t>((root - std::floor(root)) * 4294967296.0L);
}

/// The constants of SHA-256: 64 of cube roots, then 8 of square roots, of the first primes.
std::array<std::uint32_t, 72> shaConstants()
{
  std::array<std::uint32_t, 72> constants{};
  unsigned found = 0;
  for (unsigned n = 2; found < 64; ++n)
  {
    bool isPrime = true;
    for (unsigned d = 2; d * d <= n; ++d)
    {
      isPrime = isPrime && n % d != 0;
    }
    if (isPrime)
    {
      constants[found] = rootBits(n, true);
      if (found < 8)
      {
        constants[64 + found] = rootBits(n, false);
      }
      ++found;
    }
  }
  return constants;
}

void addBlock(
  const unsigned char* block, const std::array<std::uint32_t, 72>& constants, std::uint32_t (&sum)[8])
{
  std::uint32_t words[64];
  for (unsigned i = 0; i < 16; ++i)
  {
    words[i] = static_cast<std::uint32_t>(block[4 * i]) << 24 |
      static_cast<std::uint32_t>(block[4 * i + 1]) << 16 | static_cast<std::uint32_t>(block[4 * i + 2]) << 8 |
      block[4 * i + 3];
  }
  for (unsigned i = 16; i < 64; ++i)
  {
    const std::uint32_t a = words[i - 15];
    const std::uint32_t b = words[i - 2];
    words[i] = words[i - 16] + (rotated(a, 7) ^ rotated(a, 18) ^ a >> 3) + words[i - 7] +
      (rotated(b, 17) ^ rotated(b, 19) ^ b >> 10);
  }
  std::uint32_t state[8];
  std::copy_n(sum, 8, state);
  for (unsigned i = 0; i < 64; ++i)
  {
    const std::uint32_t e = state[4];
    const std::uint32_t first = state[7] + (rotated(e, 6) ^ rotated(e, 11) ^ rotated(e, 25)) +
      ((e & state[5]) ^ (~e & state[6])) + constants[i] + words[i];
    const std::uint32_t a = state[0];
    const std::uint32_t second = (rotated(a, 2) ^ rotated(a, 13) ^ rotated(a, 22)) +
      ((a & state[1]) ^ (a & state[2]) ^ (state[1] & state[2]));
    std::copy_backward(state, state + 7, state + 8);
    state[4] += first;
    state[0] = first + second;
  }
  for (unsigned i = 0; i < 8; ++i)
  {
    sum[i] += state[i];
  }
}

} // namespace

std::string sha256(const std::string& bytes)
{
  const std::array<std::uint32_t, 72> constants = shaConstants();
  std::uint32_t sum[8];
  std::copy_n(constants.data() + 64, 8, sum);
  std::string padded = bytes + '\x80';
  padded.append((120 - padded.size() % 64) % 64, '\0');
  appendSwapped(padded, std::uint64_t{ 8 * bytes.size() });
  for (std::size_t at = 0; at < padded.size(); at += 64)
  {
    addBlock(reinterpret_cast<const unsigned char*>(padded.data()) + at, constants, sum);
  }
  std::string hex;
  for (const std::uint32_t word : sum)
  {
    for (int shift = 28; shift >= 0; shift -= 4)
    {
      hex += "0123456789abcdef"[word >> shift & 15];
    }
  }
  return hex;
}
