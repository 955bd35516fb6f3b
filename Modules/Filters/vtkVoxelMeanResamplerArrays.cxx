/// The point arrays of vtkVoxelMeanResampler: which there are, and what they become.
#include "vtkVoxelMeanResamplerInternals.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <mutex>
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

bool vtkVoxelMeanResampler::Internals::AverageArrays()
{
  if (this->Attributes.empty() || this->KeepsPoints())
  {
    return true;
  }
  this->BeginPart(kRunEnd);
  const bool canWriteSets = std::all_of(this->Attributes.begin(), this->Attributes.end(),
    [](const NamedAttribute& named) { return named.attribute.canWriteSets(); });
  if (canWriteSets && this->Engine.canVisitByVoxelSet() && this->Request.levels == 1)
  {
    this->AverageInSets();
    return this->report(1.0);
  }
  const std::int64_t mostPoints = this->Engine.mostPoints(this->Request.levels - 1);
  for (NamedAttribute& named : this->Attributes)
  {
    Buffer<std::int64_t> spare;
    if (!this->SpareSums.empty())
    {
      spare = std::move(this->SpareSums.back());
      this->SpareSums.pop_back();
    }
    named.attribute.prepare(
      this->Engine.counts(), this->Engine.size(), mostPoints, std::move(spare), this->Smp);
  }
  const Status status = this->Engine.visitPointsByVoxel(
    this->Request,
    [this](const PointRows& rows, const std::int64_t* voxels, int count)
    {
      for (std::size_t i = 0; i < this->Attributes.size(); ++i)
      {
        this->Attributes[i].attribute.add(rows.tuples(i), rows.bytes, voxels, count);
      }
    },
    this->Smp, this);
  return status == Status::Ok;
}

/// One set of voxels at a time: its sums and tuples stay in the caches, and its means are written in place.
void vtkVoxelMeanResampler::Internals::AverageInSets()
{
  for (NamedAttribute& named : this->Attributes)
  {
    named.attribute.prepareSets(this->Engine.size(), this->Request.transform, this->Pool);
  }
  const std::int64_t mostPoints = this->Engine.mostPoints();
  std::mutex mutex;
  using TuplesOfAll = std::vector<VoxelAttribute::Tuples>;
  std::vector<TuplesOfAll> idle;
  const auto take = [&]
  {
    const std::lock_guard<std::mutex> lock(mutex);
    TuplesOfAll tuples;
    if (!idle.empty())
    {
      tuples = std::move(idle.back());
      idle.pop_back();
      return tuples;
    }
    for (const NamedAttribute& named : this->Attributes)
    {
      tuples.push_back(named.attribute.tuplesOfSet());
    }
    return tuples;
  };
  this->Engine.visitPointsByVoxelSet(
    this->Request,
    [&](std::int64_t first, std::int64_t voxels, const auto& forPoints)
    {
      TuplesOfAll tuples = take();
      const std::int64_t* counts = this->Engine.counts() + first;
      for (VoxelAttribute::Tuples& ofArray : tuples)
      {
        VoxelAttribute::prepare(ofArray, counts, voxels, mostPoints);
      }
      forPoints(
        [&](const PointRows& rows, const std::int64_t* numbers, int count)
        {
          for (std::size_t i = 0; i < tuples.size(); ++i)
          {
            VoxelAttribute::add(tuples[i], rows.tuples(i), rows.bytes, numbers, count);
          }
        });
      for (std::size_t i = 0; i < tuples.size(); ++i)
      {
        this->Attributes[i].attribute.writeSet(tuples[i], first, counts);
      }
      const std::lock_guard<std::mutex> lock(mutex);
      idle.push_back(std::move(tuples));
    },
    this->Smp);
}

vtkSmartPointer<vtkDataArray> vtkVoxelMeanResampler::Internals::Reduce(
  NamedAttribute& named, const std::int64_t* counts)
{
  const AffineTransform& transform = this->Request.transform;
  const vtkSmartPointer<vtkDataArray> array = this->KeepsPoints()
    ? named.attribute.chosen(this->Engine.chosenPoints(), this->Pool, this->Smp)
    : named.attribute.output(counts, transform, this->Pool, this->Smp, this);
  const bool turns = this->Request.representative != pointhaptics::Representative::Mean && named.isNormal;
  if (turns && array && !transform.isIdentity())
  {
    turnNormals(array, transform);
  }
  return array;
}
