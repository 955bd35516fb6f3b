#include "vtkPVSplatRepresentation.h"

#include "CloudOrientation.h"
#include "PolyDataAccess.h"
#include "SplatLook.h"
#include "vtkSplatMapper.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODActor.h"
#include "vtkPVView.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <optional>
#include <vector>

vtkStandardNewMacro(vtkPVSplatRepresentation);

namespace
{

/// Field data with the look of a block, which may be drawn by another process.
constexpr const char* kLookName = "SplatLook";
constexpr int kLookValues = 7;

/// The blocks of @p data that have points.
std::vector<vtkPolyData*> blocksOf(vtkDataObject* data)
{
  std::vector<vtkPolyData*> blocks;
  auto* tree = vtkCompositeDataSet::SafeDownCast(data);
  if (!tree)
  {
    return blocks;
  }
  const auto each = vtkSmartPointer<vtkCompositeDataIterator>::Take(tree->NewIterator());
  for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
  {
    auto* block = vtkPolyData::SafeDownCast(each->GetCurrentDataObject());
    if (block && block->GetNumberOfPoints() > 0)
    {
      blocks.push_back(block);
    }
  }
  return blocks;
}

void setLook(vtkPolyData* block, const pointhaptics::CloudLook& look)
{
  const double values[kLookValues] = { double(look.kind), look.up.x, look.up.y, look.up.z, look.largestPixels,
    double(look.closesAll), double(look.hidesBackFaces) };
  vtkNew<vtkDoubleArray> array;
  array->SetName(kLookName);
  std::for_each(values, values + kLookValues, [&array](double value) { array->InsertNextValue(value); });
  block->GetFieldData()->AddArray(array);
}

/// The look that setLook() kept; the usual one where the data came without it.
pointhaptics::CloudLook lookOf(vtkDataObject* block)
{
  pointhaptics::CloudLook look;
  auto* array = vtkDoubleArray::SafeDownCast(block->GetFieldData()->GetArray(kLookName));
  if (array && array->GetNumberOfValues() == kLookValues)
  {
    const double* values = array->GetPointer(0);
    look.kind = pointhaptics::CloudKind(int(values[0]));
    look.up = { values[1], values[2], values[3] };
    look.largestPixels = values[4];
    look.closesAll = values[5] != 0.0;
    look.hidesBackFaces = values[6] != 0.0;
  }
  return look;
}

/// Leaves @p block its points, and its cells where each is a vertex: then cell data count, too.
void keepVertices(vtkPolyData* block)
{
  if (block->GetNumberOfVerts() < block->GetNumberOfCells())
  {
    block->SetVerts(nullptr);
    block->SetLines(nullptr);
    block->SetPolys(nullptr);
    block->SetStrips(nullptr);
    block->GetCellData()->Initialize();
  }
}

void measure(vtkPolyData* block)
{
  const pointhaptics::PointAccess access(block->GetPoints());
  pointhaptics::MeasuredCloud measured;
  if (pointhaptics::measureCloud(
        access.view(), pointhaptics::guessCloudOrientation(block, {}), std::nullopt, measured))
  {
    pointhaptics::takeOwnShapes(block, {}, measured);
    pointhaptics::addSplats(block, measured);
    setLook(block, measured.look);
  }
}

} // namespace

vtkPVSplatRepresentation::vtkPVSplatRepresentation()
{
  // The superclass keeps its mapper: colours and selections are set there, and handed on before each render.
  this->Actor->SetMapper(this->Splats);
  this->Splats->SetProcessIdArrayName("vtkProcessId");
  this->Splats->SetCompositeIdArrayName("vtkCompositeIndex"); // of vtkPVGeometryFilter
  this->SetArrayIdNames(nullptr, nullptr);
  this->SuppressLOD = true;
  this->Representation = POINTS;
}

vtkPVSplatRepresentation::~vtkPVSplatRepresentation() = default;

void vtkPVSplatRepresentation::SetSplatScale(double scale)
{
  this->SplatScale = scale > 0.0 ? scale : this->SplatScale;
}

void vtkPVSplatRepresentation::SetSplatLight(double strength)
{
  this->Splats->Settings().lightStrength = std::clamp(strength, 0.0, 1.0);
}

void vtkPVSplatRepresentation::SetArrayIdNames(const char* pointArray, const char* cellArray)
{
  this->Superclass::SetArrayIdNames(pointArray, cellArray);
  this->Splats->SetPointIdArrayName(pointArray ? pointArray : "vtkOriginalPointIds");
  this->Splats->SetCellIdArrayName(cellArray ? cellArray : "vtkOriginalCellIds");
}

int vtkPVSplatRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int result = this->Superclass::RequestData(request, inputs, outputs);
  for (vtkPolyData* block : blocksOf(this->MultiBlockMaker->GetOutputDataObject(0)))
  {
    keepVertices(block);
    measure(block);
  }
  return result;
}

int vtkPVSplatRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_RENDER())
  {
    this->SetDrawnData(vtkPVView::GetDeliveredPiece(inInfo, this));
    this->Splats->vtkMapper::ShallowCopy(this->Mapper);
    this->Splats->SetSelection(this->Mapper->GetSelection());
    this->Splats->Settings().sizeScale = this->SplatScale;
  }
  return 1;
}

void vtkPVSplatRepresentation::SetDrawnData(vtkDataObject* data)
{
  if (!data || data->GetMTime() == this->DrawnTime)
  {
    return;
  }
  this->DrawnTime = data->GetMTime();
  pointhaptics::CloudLook look;
  vtkNew<vtkAppendPolyData> all;
  vtkSmartPointer<vtkPolyData> drawn = vtkSmartPointer<vtkPolyData>::New();
  for (vtkPolyData* block : blocksOf(data))
  {
    look = lookOf(block);
    drawn->ShallowCopy(block);
    all->AddInputData(block);
  }
  if (all->GetNumberOfInputConnections(0) > 1)
  {
    all->Update();
    drawn = all->GetOutput();
  }
  this->Splats->SetInputData(drawn);
  pointhaptics::setUpSplats(this->Splats, look);
  this->Splats->Settings().sky = { look.up.x, look.up.y, look.up.z };
}

void vtkPVSplatRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SplatScale: " << this->SplatScale << "\n";
}
