/// @file
/// PCL's descriptions of fields as Core's.
#pragma once

#include "Core/Base/ScalarType.h"
#include "Core/Resample/AttributeView.h"

#include "vtkType.h"

#include <pcl/PCLPointField.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{

/// Numbers that follow each other in each record.
struct RecordField
{
  std::size_t offset = 0; ///< Bytes from the start of a record.
  ScalarType type = ScalarType::Float;
  int components = 1;
  AttributeStatistic statistic = AttributeStatistic::Mean; ///< A normal has three real numbers.

  std::size_t bytes() const { return std::size_t(bytesOf(type)) * std::size_t(components); }
};

/// Where the coordinates are, and what else a record has.
struct FieldLayout
{
  std::array<std::size_t, 3> xyz{};
  ScalarType type = ScalarType::Float; ///< Type of x, y and z.
  std::vector<RecordField> others;
};

/// A type of numbers, as PCL, Core and VTK call it.
struct FieldType
{
  std::uint8_t pcl;
  ScalarType scalar;
  int vtk;
};
/// BOOL, which counts as UInt8, comes last.
inline constexpr std::array<FieldType, 11> kFieldTypes = { {
  { ::pcl::PCLPointField::INT8, ScalarType::Int8, VTK_SIGNED_CHAR },
  { ::pcl::PCLPointField::UINT8, ScalarType::UInt8, VTK_UNSIGNED_CHAR },
  { ::pcl::PCLPointField::INT16, ScalarType::Int16, VTK_SHORT },
  { ::pcl::PCLPointField::UINT16, ScalarType::UInt16, VTK_UNSIGNED_SHORT },
  { ::pcl::PCLPointField::INT32, ScalarType::Int32, VTK_INT },
  { ::pcl::PCLPointField::UINT32, ScalarType::UInt32, VTK_UNSIGNED_INT },
  { ::pcl::PCLPointField::INT64, ScalarType::Int64, VTK_LONG_LONG },
  { ::pcl::PCLPointField::UINT64, ScalarType::UInt64, VTK_UNSIGNED_LONG_LONG },
  { ::pcl::PCLPointField::FLOAT32, ScalarType::Float, VTK_FLOAT },
  { ::pcl::PCLPointField::FLOAT64, ScalarType::Double, VTK_DOUBLE },
  { ::pcl::PCLPointField::BOOL, ScalarType::UInt8, VTK_UNSIGNED_CHAR },
} };

/// PCL's type of a field; false: it is none.
bool scalarTypeOf(const ::pcl::PCLPointField& field, ScalarType& type);

/// Reads the layout of records of @p step bytes. Packed colours ("rgb", "rgba") become four bytes, normal_x,
/// normal_y and normal_z one normal where they follow each other, labels and flags categories. False: @p
/// message says which field is missing, of a type without meaning or beyond the record.
bool layoutOf(const std::vector<::pcl::PCLPointField>& fields, std::size_t step, FieldLayout& layout,
  std::string& message);

/// The field of this name, or null.
const ::pcl::PCLPointField* fieldNamed(
  const std::vector<::pcl::PCLPointField>& fields, const std::string& name);

/// The first number of @p field of a record, in double. @pre scalarTypeOf() knows its type.
double valueOf(const ::pcl::PCLPointField& field, const char* record);

} // namespace pointhaptics
