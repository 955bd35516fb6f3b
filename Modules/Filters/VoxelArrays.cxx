#include "VoxelArrays.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include "Core/Resample/FieldNames.h"

#include <algorithm>
#include <sstream>

namespace pointhaptics
{
namespace
{

std::string nameOf(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

/// Identifiers and ghost flags are meaningless once points are merged, and so are counts and covariances of
/// an earlier resampling.
bool isBookkeeping(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  const std::string name = nameOf(array);
  return array == attributes->GetGlobalIds() || array == attributes->GetPedigreeIds() ||
    name == vtkDataSetAttributes::GhostArrayName() || name == "VoxelPointCount" ||
    name == "VoxelCovariance" || name == "VoxelIndex" || name == kOriginalPointIds;
}

std::string whyDropped(vtkAbstractArray* array, vtkIdType points)
{
  std::ostringstream text;
  text << "Array \"" << nameOf(array) << "\" ";
  if (!vtkDataArray::SafeDownCast(array))
  {
    text << "is not numeric: it has no mean and is dropped.";
  }
  else
  {
    text << "has " << array->GetNumberOfTuples() << " tuples for " << points << " points: it is dropped.";
  }
  return text.str();
}

/// An array may be the active one of several types.
std::vector<int> rolesOf(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  std::vector<int> roles;
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    if (attributes->GetAbstractAttribute(type) == array)
    {
      roles.push_back(type);
    }
  }
  return roles;
}

AttributeKind kindOf(vtkDataArray* array, const std::set<std::string>& categoricalArrays,
  Representative representative, bool isNormal)
{
  if (keepsPoints(representative))
  {
    return AttributeKind::Chosen;
  }
  const std::string name = array->GetName() ? array->GetName() : "";
  if (std::any_of(categoricalArrays.begin(), categoricalArrays.end(),
        [&](const std::string& each) { return isSameField(each, name); }))
  {
    return AttributeKind::Category;
  }
  if (representative == Representative::Median)
  {
    return AttributeKind::Median;
  }
  return isNormal ? AttributeKind::Normal : AttributeKind::Mean;
}

}

std::vector<VoxelArray> voxelArrays(vtkPointSet* input, const std::set<std::string>& categoricalArrays,
  Representative representative, std::vector<std::string>& dropped)
{
  std::vector<VoxelArray> found;
  vtkPointData* data = input->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* any = data->GetAbstractArray(i);
    if (isBookkeeping(data, any))
    {
      continue;
    }
    vtkDataArray* array = vtkDataArray::SafeDownCast(any);
    if (!array || array->GetNumberOfTuples() != input->GetNumberOfPoints())
    {
      dropped.push_back(whyDropped(any, input->GetNumberOfPoints()));
      continue;
    }
    const bool isNormal = array == data->GetNormals() && array->GetNumberOfComponents() == 3;
    found.push_back(
      { array, kindOf(array, categoricalArrays, representative, isNormal), rolesOf(data, array), isNormal });
  }
  return found;
}

} // namespace pointhaptics
