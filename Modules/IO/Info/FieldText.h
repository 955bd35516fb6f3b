/// @file
/// Words and numbers about a whole cloud, in its field data: "LengthUnit", "Viewpoint" and the like.
#pragma once

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <iterator>
#include <string>

namespace pointhaptics::io
{

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

/// Adds one tuple of numbers.
template <typename Array, typename Numbers>
void addFieldNumbers(vtkPolyData* cloud, const char* name, const Numbers& numbers)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(std::size(numbers)));
  array->InsertNextTypedTuple(std::data(numbers));
  cloud->GetFieldData()->AddArray(array);
}

} // namespace pointhaptics::io
