#include "vtkPointCloudInfo.h"

#include "IO/Info/CloudSummary.h"
#include "vtkPointCloudReader.h"

#include "Core/Base/Host/GuardedWork.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>

using namespace pointhaptics;

vtkStandardNewMacro(vtkPointCloudInfo);

struct vtkPointCloudInfo::Internals
{
  CloudSummary Summary;

  /// Null where there is no such array.
  const ArraySummary* ArrayAt(int i) const
  {
    return i >= 0 && std::size_t(i) < this->Summary.arrays.size() ? &this->Summary.arrays[std::size_t(i)]
                                                                  : nullptr;
  }
};

vtkPointCloudInfo::vtkPointCloudInfo()
  : Impl(std::make_unique<Internals>())
{
}

vtkPointCloudInfo::~vtkPointCloudInfo() = default;

vtkIdType vtkPointCloudInfo::GetNumberOfPoints() const
{
  return vtkIdType(this->Impl->Summary.points);
}

vtkIdType vtkPointCloudInfo::GetNumberOfInvalidPoints() const
{
  return vtkIdType(this->Impl->Summary.invalid);
}

vtkIdType vtkPointCloudInfo::GetNumberOfDuplicatePoints() const
{
  return vtkIdType(this->Impl->Summary.duplicates);
}

std::string vtkPointCloudInfo::GetFormat() const
{
  return this->Impl->Summary.format;
}

bool vtkPointCloudInfo::HasBounds() const
{
  return !this->Impl->Summary.bounds.empty();
}

void vtkPointCloudInfo::GetBounds(double bounds[6]) const
{
  const Bounds& b = this->Impl->Summary.bounds;
  const double values[6] = { b.minimum.x, b.maximum.x, b.minimum.y, b.maximum.y, b.minimum.z, b.maximum.z };
  std::copy(values, values + 6, bounds);
}

void vtkPointCloudInfo::GetSpacingPercentiles(double spacing[5]) const
{
  std::copy(this->Impl->Summary.spacing.begin(), this->Impl->Summary.spacing.end(), spacing);
}

double vtkPointCloudInfo::GetDensityVariation() const
{
  return this->Impl->Summary.densityVariation;
}

double vtkPointCloudInfo::GetSuggestedVoxelSize() const
{
  return this->Impl->Summary.suggestedVoxel;
}

std::string vtkPointCloudInfo::GetHint() const
{
  return this->Impl->Summary.hint;
}

double vtkPointCloudInfo::GetSuggestedScale() const
{
  return this->Impl->Summary.suggestedScale;
}

std::string vtkPointCloudInfo::GetUnit() const
{
  return this->Impl->Summary.unit;
}

bool vtkPointCloudInfo::GetUnitIsGuess() const
{
  return this->Impl->Summary.unitIsGuess;
}

std::string vtkPointCloudInfo::GetCoordinateSystem() const
{
  return this->Impl->Summary.coordinateSystem;
}

int vtkPointCloudInfo::GetNumberOfArrays() const
{
  return int(this->Impl->Summary.arrays.size());
}

std::string vtkPointCloudInfo::GetArrayName(int array) const
{
  const ArraySummary* summary = this->Impl->ArrayAt(array);
  return summary ? summary->name : std::string();
}

std::string vtkPointCloudInfo::GetArrayType(int array) const
{
  const ArraySummary* summary = this->Impl->ArrayAt(array);
  return summary ? summary->type : std::string();
}

int vtkPointCloudInfo::GetNumberOfComponents(int array) const
{
  const ArraySummary* summary = this->Impl->ArrayAt(array);
  return summary ? summary->components : 0;
}

bool vtkPointCloudInfo::GetArrayRange(int array, int component, double range[2]) const
{
  const ArraySummary* summary = this->Impl->ArrayAt(array);
  if (!summary || component < 0 || std::size_t(component) >= summary->minima.size())
  {
    return false;
  }
  range[0] = summary->minima[std::size_t(component)];
  range[1] = summary->maxima[std::size_t(component)];
  return true;
}

int vtkPointCloudInfo::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPolyData::GetData(inputVector[0]);
  auto* reader = vtkPointCloudReader::SafeDownCast(this->GetInputAlgorithm());
  this->SetErrorCode(0);
  vtkPolyData::GetData(outputVector)->ShallowCopy(input);
  const Status status =
    guardedWork([&] { this->Impl->Summary = summarize(input, reader ? reader->GetFormat() : ""); });
  if (status != Status::Ok)
  {
    this->Impl->Summary = {};
    this->SetErrorCode(kOutOfMemoryCode);
    vtkErrorMacro(<< message(status) << ".");
  }
  return 1;
}

void vtkPointCloudInfo::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Format: " << this->GetFormat() << "\n";
  os << indent << "NumberOfPoints: " << this->GetNumberOfPoints() << "\n";
  os << indent << "NumberOfInvalidPoints: " << this->GetNumberOfInvalidPoints() << "\n";
  os << indent << "NumberOfDuplicatePoints: " << this->GetNumberOfDuplicatePoints() << "\n";
  os << indent << "Unit: " << this->GetUnit() << "\n";
}
