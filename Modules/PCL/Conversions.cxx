// Includes PCL: must see no -march flag, or Eigen's alignment differs from that of PCL's own libraries.
#include "PCL/Conversions.h"

#include "PCL/FieldLayout.h"

#include "PolyDataAccess.h"
#include "VoxelOutput.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace
{

using Field = ::pcl::PCLPointField;
using Cloud = ::pcl::PCLPointCloud2;

constexpr const char* kFields = "PclFields";
constexpr const char* kHeader = "PclHeader";
constexpr const char* kDimensions = "OrganizedDimensions";
constexpr const char* kViewpoint = "Viewpoint";

int vtkTypeOf(ScalarType type)
{
  return std::find_if(
    kFieldTypes.begin(), kFieldTypes.end(), [type](const FieldType& each) { return each.scalar == type; })
    ->vtk;
}

/// 0: PCL has no such type.
std::uint8_t pclTypeOf(vtkDataArray* array)
{
  const auto isThat = [array](const FieldType& each) { return each.scalar == scalarTypeOf(array); };
  return array->GetDataType() == VTK_BIT ? std::uint8_t(0)
                                         : std::find_if(kFieldTypes.begin(), kFieldTypes.end(), isThat)->pcl;
}

/// Copies @p bytes bytes of each record to an array without gaps.
void gather(const Cloud& cloud, std::size_t offset, std::size_t bytes, void* to)
{
  auto* target = static_cast<char*>(to);
  for (std::size_t row = 0; row < cloud.height; ++row)
  {
    const std::uint8_t* from = cloud.data.data() + std::size_t(cloud.row_step) * row + offset;
    for (std::size_t i = 0; i < cloud.width; ++i, from += cloud.point_step, target += bytes)
    {
      std::memcpy(target, from, bytes);
    }
  }
}

/// And back, into records that follow each other.
void scatter(const void* from, std::size_t bytes, std::size_t offset, Cloud& cloud)
{
  const auto* source = static_cast<const char*>(from);
  const std::size_t size = std::size_t(cloud.width) * cloud.height;
  for (std::size_t i = 0; i < size; ++i, source += bytes)
  {
    std::memcpy(cloud.data.data() + std::size_t(cloud.point_step) * i + offset, source, bytes);
  }
}

vtkSmartPointer<vtkDataArray> arrayOf(
  const Cloud& cloud, std::size_t offset, ScalarType type, int components, const std::string& name)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(vtkTypeOf(type)));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(vtkIdType(cloud.width) * vtkIdType(cloud.height));
  gather(cloud, offset, std::size_t(bytesOf(type)) * std::size_t(components), array->GetVoidPointer(0));
  return array;
}

/// From b g r a, as PCL packs them, to r g b a; "RGB" where no a says anything.
vtkSmartPointer<vtkDataArray> colorsOf(const Cloud& cloud, std::size_t offset)
{
  const vtkSmartPointer<vtkDataArray> packed = arrayOf(cloud, offset, ScalarType::UInt8, 4, "RGBA");
  auto* bgra = static_cast<unsigned char*>(packed->GetVoidPointer(0));
  const vtkIdType points = packed->GetNumberOfTuples();
  bool hasAlpha = false;
  for (vtkIdType i = 0; i < points; ++i)
  {
    std::swap(bgra[4 * i], bgra[4 * i + 2]);
    hasAlpha = hasAlpha || bgra[4 * i + 3] != 0;
  }
  if (hasAlpha)
  {
    return packed;
  }
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(points);
  for (vtkIdType i = 0; i < points; ++i)
  {
    std::copy(bgra + 4 * i, bgra + 4 * i + 3, colors->GetPointer(3 * i));
  }
  return colors;
}

bool isPackedColor(const Field& field)
{
  return field.name == "rgb" || field.name == "rgba";
}

/// Problem of the cloud and its cure; empty: none.
std::string problemOf(const Cloud& cloud, FieldLayout& layout)
{
  std::string message;
  const std::size_t row = std::size_t(cloud.width) * cloud.point_step;
  if (std::size_t(cloud.width) * cloud.height == 0)
  {
    return "the cloud has no points; give one with at least one";
  }
  if (cloud.point_step == 0 || cloud.row_step < row ||
    cloud.data.size() < std::size_t(cloud.row_step) * (cloud.height - 1) + row)
  {
    return std::to_string(cloud.data.size()) + " bytes are too few for " + std::to_string(cloud.width) +
      " x " + std::to_string(cloud.height) + " points of " + std::to_string(cloud.point_step) +
      " bytes; mend width, height, point_step or row_step";
  }
  if (cloud.is_bigendian != Cloud().is_bigendian)
  {
    return "the bytes of its numbers are in the order of another machine; swap them";
  }
  static_cast<void>(layoutOf(cloud.fields, cloud.point_step, layout, message));
  return message;
}

void addOthers(const Cloud& cloud, const FieldLayout& layout, vtkPointData* data)
{
  for (const RecordField& other : layout.others)
  {
    const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
      [&](const Field& f) { return f.offset == other.offset && f.name != "_"; });
    if (other.statistic == AttributeStatistic::Normal)
    {
      data->SetNormals(arrayOf(cloud, other.offset, other.type, 3, "Normals"));
    }
    else if (isPackedColor(*field) && field->count <= 1 && other.components == 4 &&
      other.type == ScalarType::UInt8)
    {
      data->SetScalars(colorsOf(cloud, other.offset));
    }
    else
    {
      data->AddArray(arrayOf(cloud, other.offset, other.type, other.components, field->name));
    }
  }
}

/// Names and types of the fields, and the header: what arrays do not say.
void addRecords(const Cloud& cloud, vtkFieldData* data)
{
  vtkNew<vtkStringArray> fields;
  fields->SetName(kFields);
  for (const Field& field : cloud.fields)
  {
    if (field.name != "_")
    {
      fields->InsertNextValue(std::to_string(int(field.datatype)) + " " + field.name);
    }
  }
  data->AddArray(fields);
  vtkNew<vtkStringArray> header;
  header->SetName(kHeader);
  header->InsertNextValue(std::to_string(cloud.header.seq));
  header->InsertNextValue(std::to_string(cloud.header.stamp));
  header->InsertNextValue(cloud.header.frame_id);
  data->AddArray(header);
  if (cloud.height > 1)
  {
    vtkNew<vtkIntArray> dimensions;
    dimensions->SetName(kDimensions);
    dimensions->InsertNextValue(int(cloud.width));
    dimensions->InsertNextValue(int(cloud.height));
    data->AddArray(dimensions);
  }
}

/// The type that a field of this name had, or @p usual.
std::uint8_t rememberedType(vtkPolyData* points, const std::string& name, std::uint8_t usual)
{
  auto* fields = vtkStringArray::SafeDownCast(points->GetFieldData()->GetAbstractArray(kFields));
  for (vtkIdType i = 0; fields && i < fields->GetNumberOfValues(); ++i)
  {
    const std::string text = fields->GetValue(i);
    const std::size_t blank = text.find(' ');
    if (blank != std::string::npos && blank > 0 && blank < 3 && text.substr(blank + 1) == name)
    {
      return std::uint8_t(std::atoi(text.c_str()));
    }
  }
  return usual;
}

bool hasField(vtkPolyData* points, const std::string& name)
{
  return rememberedType(points, name, 0) != 0;
}

/// A field to come, and the memory its numbers are in.
struct Column
{
  Field field;
  const void* values = nullptr;
  std::size_t bytes = 0; ///< Bytes of a point.
};

/// Lays out the fields of a cloud and fills them.
class CloudWriter
{
public:
  explicit CloudWriter(vtkPolyData* points)
    : points_(points)
  {
  }

  void add(const std::string& name, std::uint8_t type, int count, const void* values, std::size_t bytes)
  {
    Column& column = columns_.emplace_back();
    column.field.name = name;
    column.field.datatype = type;
    column.field.count = ::pcl::uindex_t(count);
    column.values = values;
    column.bytes = bytes;
  }

  /// Three fields of the components of @p array.
  void addComponents(vtkDataArray* array, const char* const (&names)[3])
  {
    const std::uint8_t type = pclTypeOf(array);
    const std::size_t size = std::size_t(array->GetDataTypeSize());
    for (int component = 0; component < 3; ++component)
    {
      const auto* values = static_cast<const char*>(array->GetVoidPointer(0));
      // One column of three numbers is copied; its fields are named one by one.
      add(names[component], type, 1, component == 0 ? values : nullptr, component == 0 ? 3 * size : 0);
      columns_.back().field.offset = ::pcl::uindex_t(size) * ::pcl::uindex_t(component);
    }
  }

  void addColors(vtkDataArray* colors)
  {
    const int components = colors->GetNumberOfComponents();
    const auto* from = static_cast<const unsigned char*>(colors->GetVoidPointer(0));
    packed_.assign(4 * std::size_t(colors->GetNumberOfTuples()), 0);
    for (std::size_t i = 0; i < packed_.size() / 4; ++i)
    {
      const unsigned char* c = from + std::size_t(components) * i;
      packed_[4 * i] = c[2];
      packed_[4 * i + 1] = c[1];
      packed_[4 * i + 2] = c[0];
      packed_[4 * i + 3] = components == 4 ? c[3] : 0;
    }
    const bool isRgb = hasField(points_, "rgb") || (components == 3 && !hasField(points_, "rgba"));
    const std::string name = isRgb ? "rgb" : "rgba";
    add(name, rememberedType(points_, name, isRgb ? Field::FLOAT32 : Field::UINT32), 1, packed_.data(), 4);
  }

  void addArray(vtkDataArray* array)
  {
    const std::string name = array->GetName();
    std::uint8_t type = pclTypeOf(array);
    if (type == Field::UINT8 && rememberedType(points_, name, type) == Field::BOOL)
    {
      type = Field::BOOL;
    }
    add(name, type, array->GetNumberOfComponents(), array->GetVoidPointer(0),
      std::size_t(array->GetDataTypeSize()) * std::size_t(array->GetNumberOfComponents()));
  }

  void write(Cloud& cloud)
  {
    std::size_t step = 0;
    std::size_t start = 0; // of the last column with bytes of its own
    for (Column& column : columns_)
    {
      start = column.bytes > 0 ? step : start;
      column.field.offset += ::pcl::uindex_t(start);
      step += column.bytes;
      cloud.fields.push_back(column.field);
    }
    cloud.point_step = ::pcl::uindex_t(step);
    cloud.row_step = cloud.point_step * cloud.width;
    cloud.data.resize(step * cloud.width * cloud.height);
    for (const Column& column : columns_)
    {
      if (column.bytes > 0)
      {
        scatter(column.values, column.bytes, column.field.offset, cloud);
      }
    }
  }

private:
  vtkPolyData* points_;
  std::vector<Column> columns_;
  std::vector<unsigned char> packed_;
};

void readRecords(vtkPolyData* points, Cloud& cloud)
{
  cloud.width = ::pcl::uindex_t(points->GetNumberOfPoints());
  cloud.height = 1;
  double size[2];
  // A filter that changed the points may have passed this on.
  if (fieldValues(points, kDimensions, 2, size) && size[0] >= 1.0 && size[1] >= 1.0 &&
    size[0] * size[1] == double(points->GetNumberOfPoints()))
  {
    cloud.width = ::pcl::uindex_t(size[0]);
    cloud.height = ::pcl::uindex_t(size[1]);
  }
  auto* header = vtkStringArray::SafeDownCast(points->GetFieldData()->GetAbstractArray(kHeader));
  if (header && header->GetNumberOfValues() == 3)
  {
    cloud.header.seq = std::uint32_t(std::strtoul(header->GetValue(0).c_str(), nullptr, 10));
    cloud.header.stamp = std::strtoull(header->GetValue(1).c_str(), nullptr, 10);
    cloud.header.frame_id = header->GetValue(2);
  }
}

bool areFinite(const PointView& points)
{
  std::int64_t i = 0;
  while (i < points.size() && isFinite(points[i]))
  {
    ++i;
  }
  return i == points.size();
}

/// An array of @p type in VTK's usual layout; others are copied into @p kept.
vtkDataArray* plain(vtkDataArray* array, int type, std::vector<vtkSmartPointer<vtkDataArray>>& kept)
{
  if (array->HasStandardMemoryLayout() && array->GetDataType() == type)
  {
    return array;
  }
  kept.push_back(vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type)));
  kept.back()->DeepCopy(array);
  return kept.back();
}

bool isColorArray(vtkDataArray* array)
{
  const std::string name = array->GetName();
  const int components = array->GetNumberOfComponents();
  return array->GetDataType() == VTK_UNSIGNED_CHAR &&
    ((name == "RGB" && components == 3) || (name == "RGBA" && components == 4));
}

}

vtkSmartPointer<vtkPolyData> toPolyData(const Cloud& cloud)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  FieldLayout layout;
  if (const std::string problem = problemOf(cloud, layout); !problem.empty())
  {
    PCL_ERROR("[pointhaptics::toPolyData] %s\n", problem.c_str());
    vtkNew<vtkPoints> none;
    result->SetPoints(none);
    return result;
  }
  const std::size_t size = std::size_t(bytesOf(layout.type));
  vtkNew<vtkPoints> points;
  if (layout.xyz[1] == layout.xyz[0] + size && layout.xyz[2] == layout.xyz[1] + size)
  {
    points->SetData(arrayOf(cloud, layout.xyz[0], layout.type, 3, "Points"));
  }
  else
  {
    points->SetDataType(vtkTypeOf(layout.type));
    points->SetNumberOfPoints(vtkIdType(cloud.width) * vtkIdType(cloud.height));
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto column = arrayOf(cloud, layout.xyz[std::size_t(axis)], layout.type, 1, "axis");
      points->GetData()->CopyComponent(axis, column, 0);
    }
  }
  result->SetPoints(points);
  result->SetVerts(makeVertices(points->GetNumberOfPoints(), Executor()));
  addOthers(cloud, layout, result->GetPointData());
  addRecords(cloud, result->GetFieldData());
  return result;
}

bool toPointCloud2(vtkPolyData* points, Cloud& cloud)
{
  cloud = Cloud();
  if (!points || points->GetNumberOfPoints() == 0)
  {
    PCL_ERROR("[pointhaptics::toPointCloud2] the vtkPolyData has no points; give one with at least one\n");
    return false;
  }
  std::vector<vtkSmartPointer<vtkDataArray>> kept;
  readRecords(points, cloud);
  cloud.is_dense = areFinite(PointAccess(points->GetPoints()).view());
  CloudWriter writer(points);
  vtkDataArray* coordinates = points->GetPoints()->GetData();
  const int type = coordinates->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
  writer.addComponents(plain(coordinates, type, kept), { "x", "y", "z" });
  vtkPointData* data = points->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const char* name = data->GetAbstractArray(i)->GetName();
    const std::string text = name ? name : "";
    const bool isTaken = text.empty() || text == "x" || text == "y" || text == "z" || text == "_";
    if (!array || isTaken || pclTypeOf(array) == 0 ||
      array->GetNumberOfTuples() != points->GetNumberOfPoints())
    {
      PCL_WARN(
        "[pointhaptics::toPointCloud2] array \"%s\" has no place in a PCL cloud and is left out: give it "
        "another name, numbers, and one row a point\n",
        text.c_str());
      continue;
    }
    array = plain(array, array->GetDataType(), kept);
    if (data->GetAbstractArray(i) == data->GetNormals() && array->GetNumberOfComponents() == 3)
    {
      writer.addComponents(array, { "normal_x", "normal_y", "normal_z" });
    }
    else if (isColorArray(array))
    {
      writer.addColors(array);
    }
    else
    {
      writer.addArray(array);
    }
  }
  writer.write(cloud);
  return true;
}

void setViewpoint(vtkPolyData* points, const double viewpoint[7])
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(kViewpoint);
  for (int i = 0; i < 7; ++i)
  {
    array->InsertNextValue(viewpoint[i]);
  }
  points->GetFieldData()->AddArray(array);
}

bool getViewpoint(vtkPolyData* points, double viewpoint[7])
{
  const double unmoved[7] = { 0, 0, 0, 1, 0, 0, 0 };
  std::copy(unmoved, unmoved + 7, viewpoint);
  return points && fieldValues(points, kViewpoint, 7, viewpoint);
}

} // namespace pointhaptics
