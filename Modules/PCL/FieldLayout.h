/// @file
/// PCL's descriptions of fields as Core's.
#pragma once

#include "PCL/RecordVoxels.h"

#include <pcl/PCLPointField.h>

#include <array>
#include <string>
#include <vector>

namespace pointhaptics
{

/// Where the coordinates are, and what else a record has.
struct FieldLayout
{
  std::array<std::size_t, 3> xyz{};
  ScalarType type = ScalarType::Float; ///< Type of x, y and z.
  std::vector<RecordField> others;
};

/// PCL's type of a field; false: it is none. BOOL counts as UInt8.
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
