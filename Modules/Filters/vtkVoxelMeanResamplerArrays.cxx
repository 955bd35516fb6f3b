/// The point arrays of vtkVoxelMeanResampler: which there are, and what they become.
#include "vtkVoxelMeanResamplerInternals.h"

#include "VoxelArrays.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <string>

using namespace pointhaptics;

bool vtkVoxelMeanResampler::Internals::KeepsPoints() const
{
  return keepsPoints(this->Request.representative);
}

void vtkVoxelMeanResampler::Internals::ChooseArrays(vtkPointSet* input, bool warns)
{
  this->Attributes.clear();
  if (!this->Filter->Settings.passAttributes)
  {
    this->Known.clear();
    return;
  }
  const vtkMTimeType ownersTime =
    std::max(input->GetPointData()->vtkObject::GetMTime(), input->vtkObject::GetMTime());
  std::vector<KnownValues> known;
  known.swap(this->Known);
  std::vector<std::string> dropped;
  for (const VoxelArray& found :
    voxelArrays(input, this->Filter->Settings.categoricalArrays, this->Request.representative, dropped))
  {
    const ArraySeen seen(found.array, ownersTime);
    const auto old = std::find_if(known.begin(), known.end(),
      [&](const KnownValues& values) { return values.seen == seen && values.kind == found.kind; });
    VoxelAttribute attribute(found.array, found.kind, old == known.end() ? nullptr : &old->values);
    if (this->Filter->Settings.usePointIndex)
    {
      attribute.findRange(this->Filter->Settings.instructionSet, this->Smp);
      this->Known.push_back({ seen, found.kind, attribute.values() });
    }
    this->Attributes.push_back({ std::move(attribute), found.roles, found.isNormal });
  }
  for (std::size_t i = 0; warns && i < dropped.size(); ++i)
  {
    vtkWarningWithObjectMacro(this->Filter, << dropped[i]);
  }
}

vtkSmartPointer<vtkDataArray> vtkVoxelMeanResampler::Internals::ReducedArray(std::size_t i, int level)
{
  const NamedAttribute& named = this->Attributes[i];
  return reducedArray(this->Engine, level, i, named.attribute, named.isNormal, this->Request, this->Pool,
    this->Allocator, this->Smp);
}
