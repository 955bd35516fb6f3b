#include "Benchmark/Io/Files.h"

#include "Benchmark/Io/E57File.h"

#include <fmt/format.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>

#include <stdlib.h>

namespace pointhaptics
{
namespace bench
{
namespace io
{
namespace
{

constexpr double kEdge = 10.0;

struct Row
{
  double p[3];
  float intensity;
  unsigned char rgb[3];
};

template <typename Append>
void forEachRow(vtkPolyData* cloud, Append append)
{
  vtkFloatArray* intensity = vtkFloatArray::SafeDownCast(cloud->GetPointData()->GetArray("intensity"));
  vtkUnsignedCharArray* colour = vtkUnsignedCharArray::SafeDownCast(cloud->GetPointData()->GetArray("RGB"));
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Row row;
    cloud->GetPoint(i, row.p);
    row.intensity = intensity->GetValue(i);
    colour->GetTypedTuple(i, row.rgb);
    append(row);
  }
}

/// PCL packs colours into the bits of a float.
float packed(const unsigned char rgb[3])
{
  const std::uint32_t bits = std::uint32_t{ rgb[0] } << 16 | std::uint32_t{ rgb[1] } << 8 | rgb[2];
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::string pcdHeader(vtkIdType points, const char* data)
{
  return fmt::format("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z intensity rgb\nSIZE 4 4 4 4 4\nTYPE F F F F F\n"
                     "COUNT 1 1 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA {1}\n",
    points, data);
}

std::string asText(FileKind kind, vtkPolyData* cloud)
{
  const vtkIdType count = cloud->GetNumberOfPoints();
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  switch (kind)
  {
    case FileKind::AsciiPly:
      fmt::format_to(out,
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
        "z\nproperty "
        "float intensity\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
        count);
      break;
    case FileKind::AsciiPcd:
      fmt::format_to(out, "{}", pcdHeader(count, "ascii"));
      break;
    case FileKind::Csv:
      fmt::format_to(out, "x,y,z,intensity,red,green,blue\n");
      break;
    default:
      break;
  }
  forEachRow(cloud,
    [&](const Row& row)
    {
      const float x = float(row.p[0]), y = float(row.p[1]), z = float(row.p[2]);
      switch (kind)
      {
        case FileKind::AsciiPly:
          fmt::format_to(
            out, "{} {} {} {} {} {} {}\n", x, y, z, row.intensity, row.rgb[0], row.rgb[1], row.rgb[2]);
          break;
        case FileKind::AsciiPcd:
          fmt::format_to(out, "{} {} {} {} {}\n", x, y, z, row.intensity, packed(row.rgb));
          break;
        case FileKind::Csv:
          fmt::format_to(
            out, "{},{},{},{},{},{},{}\n", x, y, z, row.intensity, row.rgb[0], row.rgb[1], row.rgb[2]);
          break;
        default:
          fmt::format_to(out, "{} {} {}\n", x, y, z);
      }
    });
  return fmt::to_string(text);
}

/// Field after field, as LZF literals: what a cloud of random numbers comes to in any case.
std::string asCompressedPcd(vtkPolyData* cloud)
{
  std::vector<std::string> fields(5);
  forEachRow(cloud,
    [&](const Row& row)
    {
      const float values[] = { float(row.p[0]), float(row.p[1]), float(row.p[2]), row.intensity,
        packed(row.rgb) };
      for (std::size_t i = 0; i < fields.size(); ++i)
      {
        fields[i].append(reinterpret_cast<const char*>(&values[i]), sizeof(float));
      }
    });
  std::string unpacked;
  for (const std::string& field : fields)
  {
    unpacked += field;
  }
  constexpr std::size_t kLiterals = 32;
  std::string body;
  for (std::size_t at = 0; at < unpacked.size(); at += kLiterals)
  {
    const std::string piece = unpacked.substr(at, kLiterals);
    body += char(piece.size() - 1);
    body += piece;
  }
  const std::uint32_t sizes[] = { std::uint32_t(body.size()), std::uint32_t(unpacked.size()) };
  return pcdHeader(cloud->GetNumberOfPoints(), "binary_compressed") +
    std::string(reinterpret_cast<const char*>(sizes), sizeof sizes) + body;
}

const char* extensionOf(FileKind kind)
{
  switch (kind)
  {
    case FileKind::BinaryPly:
    case FileKind::AsciiPly:
      return ".ply";
    case FileKind::BinaryPcd:
    case FileKind::CompressedPcd:
    case FileKind::AsciiPcd:
      return ".pcd";
    case FileKind::Csv:
      return ".csv";
    case FileKind::Xyz:
      return ".xyz";
    case FileKind::Las:
      return ".las";
    case FileKind::Laz:
      return ".laz";
    case FileKind::E57:
      return ".e57";
    case FileKind::Vtp:
      return ".vtp";
  }
  return "";
}

} // namespace

vtkSmartPointer<vtkPolyData> makeCloud(std::int64_t points)
{
  std::mt19937 random(1);
  const auto unit = [&] { return double(random()) / 4294967296.0; };
  vtkNew<vtkPoints> made;
  vtkNew<vtkFloatArray> intensity;
  vtkNew<vtkUnsignedCharArray> colour;
  made->SetNumberOfPoints(points);
  intensity->SetName("intensity");
  intensity->SetNumberOfValues(points);
  colour->SetName("RGB");
  colour->SetNumberOfComponents(3);
  colour->SetNumberOfTuples(points);
  for (vtkIdType i = 0; i < points; ++i)
  {
    const double x = kEdge * unit(), y = kEdge * unit(), z = kEdge * unit();
    made->SetPoint(i, x, y, z);
    intensity->SetValue(i, float(unit()));
    for (int channel = 0; channel < 3; ++channel)
    {
      colour->SetValue(3 * i + channel, static_cast<unsigned char>(random() >> 24));
    }
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(made);
  cloud->GetPointData()->AddArray(intensity);
  cloud->GetPointData()->SetScalars(colour);
  return cloud;
}

Files::Files()
{
  std::string name = (std::filesystem::temp_directory_path() / "pointhaptics-bench-XXXXXX").string();
  if (!::mkdtemp(name.data()))
  {
    throw std::runtime_error(
      "no folder can be made for the files: " + name + "; set TMPDIR to one with space");
  }
  folder_ = name;
}

Files::~Files()
{
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string Files::pathOf(FileKind kind) const
{
  return this->path(std::to_string(int(kind)) + extensionOf(kind));
}

std::string Files::write(FileKind kind, vtkPolyData* cloud) const
{
  const std::string name = this->pathOf(kind);
  const std::unique_ptr<Rival> ours = makeOurs();
  if (!ours->writerOf(kind).empty() && kind != FileKind::Csv)
  {
    ours->load(cloud);
    ours->write(kind, name);
    return name;
  }
  std::ofstream stream(name, std::ios::binary);
  stream << (kind == FileKind::CompressedPcd ? asCompressedPcd(cloud)
                : kind == FileKind::E57      ? asE57(cloud)
                                             : asText(kind, cloud))
         << std::flush;
  if (!stream)
  {
    throw std::runtime_error(name + ": cannot be written; set TMPDIR to a folder with space");
  }
  return name;
}

double largestError(vtkPolyData* expected, const std::vector<double>& points, bool asFloats)
{
  const vtkIdType count = expected->GetNumberOfPoints();
  if (points.size() != 3 * std::size_t(count))
  {
    return std::numeric_limits<double>::infinity();
  }
  double largest = 0.0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    expected->GetPoint(i, p);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double point = points[3 * std::size_t(i) + std::size_t(axis)];
      const double error = std::abs((asFloats ? double(float(point)) : point) - p[axis]);
      largest = error <= largest ? largest : error; // NaN stays
    }
  }
  return largest;
}

} // namespace io
} // namespace bench
} // namespace pointhaptics
