#include "vtkPointCloudInfo.h"

#include "IO/Info/CloudSummary.h"
#include "vtkPointCloudReader.h"

#include "Core/Base/Host/GuardedWork.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>

using namespace pointhaptics;

vtkStandardNewMacro(vtkPointCloudInfo);

const vtkPointCloudInfo::ArrayInfo& vtkPointCloudInfo::ArrayAt(int array) const
{
  static const ArrayInfo none;
  return array >= 0 && array < this->GetNumberOfArrays() ? this->Arrays[std::size_t(array)] : none;
}

bool vtkPointCloudInfo::GetArrayRange(int array, int component, double range[2]) const
{
  const ArrayInfo& info = this->ArrayAt(array);
  const bool isThere = component >= 0 && std::size_t(component) < info.Minima.size();
  if (isThere)
  {
    range[0] = info.Minima[std::size_t(component)];
    range[1] = info.Maxima[std::size_t(component)];
  }
  return isThere;
}

int vtkPointCloudInfo::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const vtkNew<vtkPolyData> none; // for a block of another kind
  auto* input = vtkPolyData::GetData(inputVector[0]);
  input = input ? input : none.Get();
  auto* reader = vtkPointCloudReader::SafeDownCast(this->GetInputAlgorithm());
  this->SetErrorCode(0);
  vtkPolyData::GetData(outputVector)->ShallowCopy(input);
  CloudSummary summary;
  const Status status = guardedWork([&] { summary = summarize(input, reader ? reader->GetFormat() : ""); });
  if (status != Status::Ok)
  {
    this->SetErrorCode(kOutOfMemoryCode);
    vtkErrorMacro(<< message(status) << ".");
  }
  this->NumberOfPoints = vtkIdType(summary.points);
  this->NumberOfInvalidPoints = vtkIdType(summary.invalid);
  this->NumberOfDuplicatePoints = vtkIdType(summary.duplicates);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Bounds[2 * axis] = summary.bounds.minimum[axis];
    this->Bounds[2 * axis + 1] = summary.bounds.maximum[axis];
  }
  std::copy(summary.spacing.begin(), summary.spacing.end(), this->Spacing);
  this->DensityVariation = summary.densityVariation;
  this->SuggestedVoxelSize = summary.suggestedVoxel;
  this->SuggestedScale = summary.suggestedScale;
  this->UnitIsGuess = summary.unitIsGuess;
  this->Format = summary.format;
  this->Hint = summary.hint;
  this->Unit = summary.unit;
  this->CoordinateSystem = summary.coordinateSystem;
  this->Arrays.clear();
  for (const ArraySummary& array : summary.arrays)
  {
    this->Arrays.push_back({ array.name, array.type, array.components, array.minima, array.maxima });
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
