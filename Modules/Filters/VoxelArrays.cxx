#include "VoxelArrays.h"

#include "PolyDataAccess.h"

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

AttributeStatistic statisticOf(vtkDataArray* array, const VoxelMeanSettings& settings, bool isNormal)
{
  return isCategorical(settings, nameOf(array))         ? AttributeStatistic::Mode
    : settings.representative == Representative::Median ? AttributeStatistic::Median
    : isNormal                                          ? AttributeStatistic::Normal
                                                        : AttributeStatistic::Mean;
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
    found.push_back({ array, statisticOf(array, settings, isNormal), rolesOf(data, array), isNormal });
  }
  return found;
}

} // namespace pointhaptics
