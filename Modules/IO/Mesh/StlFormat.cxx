#include "ReadTask.h"

#include "Bytes/LittleEndian.h"
#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kCountAt = 80;
constexpr std::size_t kTrianglesAt = 84;
constexpr std::size_t kTriangleSize = 50;
constexpr std::size_t kFirstVertex = 12; ///< inside a triangle, after its normal

using Vertex = std::array<float, 3>;

/// Each vertex once, in the order they are met: triangles that share a vertex repeat it. -0 counts as 0.
class DistinctVertices
{
public:
  /// @return the number of the vertex.
  vtkIdType add(Vertex vertex)
  {
    for (float& value : vertex)
    {
      value += 0.0f;
    }
    if (2 * (vertices_.size() + 1) > slots_.size())
    {
      grow();
    }
    std::uint32_t& slot = slots_[slotOf(vertex)];
    if (slot == kFree)
    {
      slot = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(vertex);
    }
    return static_cast<vtkIdType>(slot);
  }
  const std::vector<Vertex>& all() const { return vertices_; }

private:
  static constexpr std::uint32_t kFree = 0xffffffff;

  std::size_t slotOf(const Vertex& vertex) const
  {
    std::array<std::uint32_t, 3> bits;
    std::memcpy(bits.data(), vertex.data(), sizeof(bits));
    std::uint64_t hash = seed_;
    for (const std::uint32_t word : bits)
    {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    std::size_t at = static_cast<std::size_t>(hash) & (slots_.size() - 1);
    while (
      slots_[at] != kFree && std::memcmp(vertices_[slots_[at]].data(), vertex.data(), sizeof(Vertex)) != 0)
    {
      at = (at + 1) & (slots_.size() - 1);
    }
    return at;
  }
  void grow()
  {
    slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), kFree);
    for (std::size_t i = 0; i < vertices_.size(); ++i)
    {
      slots_[slotOf(vertices_[i])] = static_cast<std::uint32_t>(i);
    }
  }

  /// Random for each read: a file cannot be crafted to collide in one slot.
  const std::uint64_t seed_ = std::uint64_t{ std::random_device()() } << 32 | std::random_device()();
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> slots_;
};

void readBinary(ReadTask& task, DistinctVertices& vertices)
{
  const std::uint32_t count = loadLittle<std::uint32_t>(task.bytes.data() + kCountAt);
  const std::size_t available = task.bytes.size() - kTrianglesAt;
  failTruncatedIf(count > available / kTriangleSize,
    "byte 80: {} triangles announced, but only {} bytes follow ({} triangles)", count, available,
    available / kTriangleSize);
  task.faces.count = count;
  std::vector<vtkIdType> corners(3);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const char* triangle = task.bytes.data() + kTrianglesAt + i * kTriangleSize;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const char* at = triangle + kFirstVertex + 12 * corner;
      corners[corner] =
        vertices.add({ loadLittle<float>(at), loadLittle<float>(at + 4), loadLittle<float>(at + 8) });
    }
    task.faces.keep(corners);
    task.step(i, i, count);
  }
  task.noteUncounted(kTrianglesAt + count * kTriangleSize, kTriangleSize);
}

void readFacets(ReadTask& task, DistinctVertices& vertices)
{
  std::vector<vtkIdType> corners;
  LineReader lines(task.bytes);
  std::string_view line;
  bool ended = false;
  while (lines.next(line))
  {
    const std::string_view keyword = takeWord(line);
    ended = equalNoCase(keyword, "endsolid");
    if (equalNoCase(keyword, "vertex"))
    {
      Vertex vertex{};
      for (float& coordinate : vertex)
      {
        double value = 0.0;
        if (!takeNumber(line, value))
        {
          const std::string_view word = takeWord(line);
          failFormat(fmt::format("line {}: a vertex with {}", lines.lineNumber(),
                       word.empty() ? "fewer than 3 numbers" : inQuotes(word) + ", not a number"),
            "a vertex is: vertex x y z");
        }
        coordinate = static_cast<float>(value);
      }
      corners.push_back(vertices.add(vertex));
    }
    else if (equalNoCase(keyword, "endloop"))
    {
      ++task.faces.count;
      task.faces.keep(corners);
      corners.clear();
    }
    task.step(lines.lineNumber(), lines.position(), task.bytes.size());
  }
  failTruncatedIf(!ended, "the file ends at line {} without endsolid", lines.lineNumber());
}

} // namespace

void readStl(ReadTask& task, vtkPolyData* cloud)
{
  const std::size_t size = task.bytes.size();
  const bool fits = size >= kTrianglesAt &&
    (size - kTrianglesAt) / kTriangleSize == loadLittle<std::uint32_t>(task.bytes.data() + kCountAt);
  const bool isText = !fits && looksLikeStlText(task.bytes);
  task.format = isText ? "STL (ascii)" : "STL (binary)";
  failTruncatedIf(!isText && size < kTrianglesAt, "the file ends at byte {} inside its header", size);
  DistinctVertices vertices;
  isText ? readFacets(task, vertices) : readBinary(task, vertices);
  const std::vector<Vertex>& all = vertices.all();
  all.empty() ? failNoPoints() : void();
  const vtkIdType rows = static_cast<vtkIdType>(all.size());
  CloudColumns columns({ { "x", VTK_FLOAT }, { "y", VTK_FLOAT }, { "z", VTK_FLOAT } }, rows);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    copyStrided({ reinterpret_cast<const char*>(all.data()) + 4 * axis, sizeof(Vertex), VTK_FLOAT },
      columns.target(axis), rows);
  }
  columns.moveTo(cloud, task);
}

} // namespace pointhaptics::io
