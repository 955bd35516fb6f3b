#include "VoxelArrays.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <sstream>

namespace pointhaptics
{
namespace
{

std::string nameOf(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

/// Ghost flags are meaningless once points are merged, and so are counts and covariances of an earlier
/// resampling.
bool isBookkeeping(vtkAbstractArray* array)
{
  const std::string name = nameOf(array);
  return name == vtkDataSetAttributes::GhostArrayName() || name == "VoxelPointCount" ||
    name == "VoxelCovariance" || name == "VoxelIndex" || name == kOriginalPointIds;
}

bool areIds(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  return array == attributes->GetGlobalIds() || array == attributes->GetPedigreeIds();
}

std::string whyDropped(vtkDataSetAttributes* attributes, vtkAbstractArray* array, vtkIdType points)
{
  std::ostringstream text;
  text << "Array \"" << nameOf(array) << "\" ";
  if (areIds(attributes, array))
  {
    text << "holds ids: merged points have none and it is dropped.";
  }
  else if (!vtkDataArray::SafeDownCast(array))
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

AttributeKind kindOf(vtkDataArray* array, const VoxelMeanSettings& settings, bool isNormal)
{
  if (keepsPoints(settings.representative))
  {
    return AttributeKind::Chosen;
  }
  if (isCategorical(settings, nameOf(array)))
  {
    return AttributeKind::Category;
  }
  if (settings.representative == Representative::Median)
  {
    return AttributeKind::Median;
  }
  return isNormal ? AttributeKind::Normal : AttributeKind::Mean;
}

}

std::vector<VoxelArray> voxelArrays(
  vtkPointSet* input, const VoxelMeanSettings& settings, std::vector<std::string>& dropped)
{
  std::vector<VoxelArray> found;
  vtkPointData* data = input->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* any = data->GetAbstractArray(i);
    if (isBookkeeping(any))
    {
      continue;
    }
    vtkDataArray* array = vtkDataArray::SafeDownCast(any);
    if (areIds(data, any) || !array || array->GetNumberOfTuples() != input->GetNumberOfPoints())
    {
      dropped.push_back(whyDropped(data, any, input->GetNumberOfPoints()));
      continue;
    }
    const bool isNormal = array == data->GetNormals() && array->GetNumberOfComponents() == 3;
    found.push_back({ array, kindOf(array, settings, isNormal), rolesOf(data, array), isNormal });
  }
  return found;
}

} // namespace pointhaptics
