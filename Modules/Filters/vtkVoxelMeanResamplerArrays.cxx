/// The point arrays of vtkVoxelMeanResampler: which there are, and what they become.
#include "vtkVoxelMeanResamplerInternals.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <sstream>
#include <string>

using namespace pointhaptics;

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

}

bool vtkVoxelMeanResampler::Internals::KeepsPoints() const
{
  return this->Request.representative == pointhaptics::Representative::NearestToMean ||
    this->Request.representative == pointhaptics::Representative::NearestToCenter;
}

AttributeKind vtkVoxelMeanResampler::Internals::KindOf(vtkDataArray* array, bool isNormal) const
{
  if (this->KeepsPoints())
  {
    return AttributeKind::Chosen;
  }
  if (this->Filter->IsCategoricalArray(array->GetName()))
  {
    return AttributeKind::Category;
  }
  if (this->Request.representative == pointhaptics::Representative::Median)
  {
    return AttributeKind::Median;
  }
  return isNormal ? AttributeKind::Normal : AttributeKind::Mean;
}

void vtkVoxelMeanResampler::Internals::ChooseArrays(vtkPointSet* input, bool warns)
{
  this->Attributes.clear();
  if (!this->Filter->Settings.passAttributes)
  {
    this->Known.clear();
    return;
  }
  vtkPointData* data = input->GetPointData();
  std::vector<KnownValues> known;
  known.swap(this->Known);
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
      if (warns)
      {
        vtkWarningWithObjectMacro(this->Filter, << whyDropped(any, input->GetNumberOfPoints()));
      }
      continue;
    }
    const bool isNormal = array == data->GetNormals() && array->GetNumberOfComponents() == 3;
    const AttributeKind kind = this->KindOf(array, isNormal);
    const ArraySeen seen(array, std::max(data->vtkObject::GetMTime(), input->vtkObject::GetMTime()));
    const auto old = std::find_if(known.begin(), known.end(),
      [&](const KnownValues& values) { return values.seen == seen && values.kind == kind; });
    VoxelAttribute attribute(array, kind, old == known.end() ? nullptr : &old->values,
      this->Filter->Settings.instructionSet, this->Smp);
    if (this->Filter->Settings.usePointIndex)
    {
      this->Known.push_back({ seen, kind, attribute.values() });
    }
    this->Attributes.push_back({ std::move(attribute), rolesOf(data, array), isNormal });
  }
}

vtkSmartPointer<vtkDataArray> vtkVoxelMeanResampler::Internals::ReducedArray(std::size_t i, int level)
{
  const NamedAttribute& named = this->Attributes[i];
  const AffineTransform& transform = this->Request.transform;
  vtkSmartPointer<vtkDataArray> array;
  if (this->KeepsPoints())
  {
    array = named.attribute.chosen(this->Engine.chosenPoints(), this->Pool, this->Smp);
  }
  else
  {
    array = named.attribute.emptyArray();
    fillAttribute(this->Engine, level, i, array, this->Allocator, this->Smp);
    array = named.attribute.inOwnType(array);
  }
  const bool turns = this->Request.representative != pointhaptics::Representative::Mean && named.isNormal;
  if (turns && !transform.isIdentity())
  {
    turnNormals(array, transform);
  }
  return array;
}
