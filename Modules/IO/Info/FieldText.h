/// @file
/// Words about a whole cloud, in its field data: "CoordinateSystem", "LengthUnit" and the like.
#pragma once

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <cctype>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Word before the unit in comments of PLY, PCD and text.
constexpr std::string_view kUnitComment = "LengthUnit ";

/// "mm" of "LengthUnit mm"; empty where @p comment is another one.
inline std::string unitOfComment(std::string_view comment)
{
  const bool has = comment.substr(0, kUnitComment.size()) == kUnitComment;
  return std::string(has ? comment.substr(kUnitComment.size()) : std::string_view());
}

/// True if @p unit may stand in a line of a header, also in brackets: letters, and spaces as in "US survey
/// foot".
inline bool isUnitWord(std::string_view unit)
{
  constexpr std::size_t kLongest = 40;
  bool result = !unit.empty() && unit.size() <= kLongest && unit.front() != ' ' && unit.back() != ' ';
  for (const char c : unit)
  {
    const auto byte = static_cast<unsigned char>(c);
    result = result && (c == ' ' || byte >= 0x80 || std::isalnum(byte) != 0);
  }
  return result;
}

/// @return nothing where there is no such array of words, or not so many.
inline std::string fieldText(vtkFieldData* data, const char* name, vtkIdType row = 0)
{
  auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
  return array && array->GetNumberOfValues() > row ? array->GetValue(row) : std::string();
}

/// Nothing is added for a @p text without letters.
inline void addFieldText(vtkPolyData* cloud, const char* name, const std::string& text)
{
  if (!text.empty())
  {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    cloud->GetFieldData()->AddArray(array);
  }
}

} // namespace pointhaptics::io
