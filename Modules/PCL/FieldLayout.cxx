#include "PCL/FieldLayout.h"

#include <algorithm>
#include <cstring>

namespace pointhaptics
{
namespace
{

using Field = ::pcl::PCLPointField;

/// See pcl's bug 821: a count of 0 means one number.
std::size_t countOf(const Field& field)
{
  return std::max<std::size_t>(field.count, 1);
}

bool isCoordinate(const std::string& name)
{
  return name == "x" || name == "y" || name == "z";
}

bool isColor(const Field& field)
{
  return (field.name == "rgb" || field.name == "rgba") && countOf(field) == 1 &&
    (field.datatype == Field::FLOAT32 || field.datatype == Field::UINT32 || field.datatype == Field::INT32);
}

/// True if normal_x, normal_y and normal_z are three real numbers after each other.
bool hasNormal(const std::vector<Field>& fields)
{
  const Field* x = fieldNamed(fields, "normal_x");
  const Field* y = fieldNamed(fields, "normal_y");
  const Field* z = fieldNamed(fields, "normal_z");
  if (!x || !y || !z || x->datatype != y->datatype || x->datatype != z->datatype)
  {
    return false;
  }
  const std::size_t size = x->datatype == Field::FLOAT32 ? 4 : x->datatype == Field::FLOAT64 ? 8 : 0;
  return size > 0 && countOf(*x) == 1 && countOf(*y) == 1 && countOf(*z) == 1 &&
    y->offset == x->offset + size && z->offset == y->offset + size;
}

RecordField recordField(const Field& field, ScalarType type, bool normal)
{
  if (isColor(field))
  {
    return { field.offset, ScalarType::UInt8, 4, AttributeStatistic::Mean };
  }
  if (normal)
  {
    return { field.offset, type, 3, AttributeStatistic::Normal };
  }
  const bool isCategory = field.datatype == Field::BOOL ||
    (field.name == "label" && type != ScalarType::Float && type != ScalarType::Double);
  return { field.offset, type, int(countOf(field)),
    isCategory ? AttributeStatistic::Mode : AttributeStatistic::Mean };
}

bool readCoordinates(const std::vector<Field>& fields, FieldLayout& layout, std::string& message)
{
  const char* const names[3] = { "x", "y", "z" };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Field* field = fieldNamed(fields, names[axis]);
    const bool isReal = field && (field->datatype == Field::FLOAT32 || field->datatype == Field::FLOAT64);
    if (!isReal || field->datatype != fieldNamed(fields, "x")->datatype || countOf(*field) != 1)
    {
      message = std::string("field ") + names[axis] +
        " is missing or no coordinate; give x, y and z as three FLOAT32 or three FLOAT64";
      return false;
    }
    layout.xyz[axis] = field->offset;
    layout.type = field->datatype == Field::FLOAT32 ? ScalarType::Float : ScalarType::Double;
  }
  return true;
}

}

bool scalarTypeOf(const Field& field, ScalarType& type)
{
  const auto found = std::find_if(kFieldTypes.begin(), kFieldTypes.end(),
    [&field](const FieldType& each) { return each.pcl == field.datatype; });
  type = found == kFieldTypes.end() ? type : found->scalar;
  return found != kFieldTypes.end();
}

const Field* fieldNamed(const std::vector<Field>& fields, const std::string& name)
{
  const auto found =
    std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

bool layoutOf(const std::vector<Field>& fields, std::size_t step, FieldLayout& layout, std::string& message)
{
  layout = FieldLayout();
  const bool normal = hasNormal(fields);
  for (const Field& field : fields)
  {
    if (field.name == "_") // padding
    {
      continue;
    }
    ScalarType type = ScalarType::Float;
    if (!scalarTypeOf(field, type))
    {
      message = "field " + field.name + " has the unknown type " + std::to_string(field.datatype) +
        "; give one of PCLPointField's";
      return false;
    }
    if (countOf(field) > step || field.offset + std::size_t(bytesOf(type)) * countOf(field) > step)
    {
      message = "field " + field.name + " ends beyond the " + std::to_string(step) +
        " bytes of a point; mend its offset, its count or point_step";
      return false;
    }
    const bool isLaterNormal = normal && (field.name == "normal_y" || field.name == "normal_z");
    if (!isCoordinate(field.name) && !isLaterNormal)
    {
      layout.others.push_back(recordField(field, type, normal && field.name == "normal_x"));
    }
  }
  return readCoordinates(fields, layout, message);
}

double valueOf(const Field& field, const char* record)
{
  double result = 0.0;
  ScalarType type = ScalarType::Float;
  if (scalarTypeOf(field, type))
  {
    withType(type,
      [&](auto value)
      {
        std::memcpy(&value, record + field.offset, sizeof value);
        result = double(value);
      });
  }
  return result;
}

} // namespace pointhaptics
