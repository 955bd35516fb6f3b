#include "VoxelOutput.h"

#include "PolyDataAccess.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <numeric>

namespace pointhaptics
{

vtkSmartPointer<vtkCellArray> makeVertices(vtkIdType count, const Executor& executor)
{
  vtkNew<vtkTypeInt64Array> offsets;
  vtkNew<vtkTypeInt64Array> connectivity;
  OutputMemory::allocateFor(offsets, count + 1);
  OutputMemory::allocateFor(connectivity, count);
  vtkTypeInt64* starts = offsets->GetPointer(0);
  vtkTypeInt64* points = connectivity->GetPointer(0);
  starts[count] = count;
  constexpr std::int64_t kGrain = 1 << 14;
  forRange(executor, count, kGrain,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::iota(starts + begin, starts + end, vtkTypeInt64(begin));
      std::iota(points + begin, points + end, vtkTypeInt64(begin));
    });
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

namespace
{

/// Moves the tuples that stay to the front; they are in ascending order.
void keepTuples(vtkAbstractArray* array, const std::vector<std::int64_t>& kept)
{
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    array->SetTuple(vtkIdType(i), vtkIdType(kept[i]), array);
  }
  array->Resize(vtkIdType(kept.size()));
}

template <typename Array, typename Number>
void addField(vtkFieldData* field, const char* name, const Number* values, int count)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(count);
  array->SetNumberOfTuples(1);
  std::copy_n(values, count, array->GetPointer(0));
  field->AddArray(array);
}

/// The array VoxelCovariance.
vtkSmartPointer<vtkDoubleArray> makeCovariances(const VoxelResampler& engine, OutputMemory& memory)
{
  static_assert(sizeof(SymMat3) == 6 * sizeof(double), "six numbers, xx yy zz xy yz xz");
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("VoxelCovariance");
  array->SetNumberOfComponents(6);
  const char* names[6] = { "XX", "YY", "ZZ", "XY", "YZ", "XZ" };
  for (int c = 0; c < 6; ++c)
  {
    array->SetComponentName(c, names[c]);
  }
  memory.take(OutputAllocator::Covariances, array, engine.size());
  return array;
}

/// An array of ids. @p numbers: what becomes of each id that is not negative; empty: they stay.
vtkSmartPointer<vtkIdTypeArray> makeIds(const std::vector<std::int64_t>& ids, const char* name,
  const std::vector<std::int64_t>& numbers, const Executor& executor)
{
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  OutputMemory::allocateFor(array, std::int64_t(ids.size()));
  vtkIdType* const to = array->GetPointer(0);
  forRange(executor, std::int64_t(ids.size()),
    [&](std::int64_t begin, std::int64_t end)
    {
      std::transform(ids.begin() + begin, ids.begin() + end, to + begin,
        [&](std::int64_t id) { return numbers.empty() || id < 0 ? id : numbers[std::size_t(id)]; });
    });
  return array;
}

/// Leaves out the points of @p cloud whose @p counts, one of its arrays, are below @p minimum. @return those
/// that stay; nothing for a minimum of 1, with which all do.
std::optional<std::vector<std::int64_t>> keepVoxels(
  vtkPolyData* cloud, vtkIdTypeArray* counts, vtkIdType minimum, const Executor& executor)
{
  if (minimum <= 1)
  {
    return std::nullopt;
  }
  std::vector<std::int64_t> kept;
  for (vtkIdType v = 0; v < counts->GetNumberOfValues(); ++v)
  {
    if (counts->GetValue(v) >= minimum)
    {
      kept.push_back(v);
    }
  }
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    keepTuples(data->GetAbstractArray(i), kept);
  }
  keepTuples(cloud->GetPoints()->GetData(), kept);
  cloud->SetVerts(makeVertices(vtkIdType(kept.size()), executor));
  return kept;
}

/// Records the lattice and the transform: a scene is built from them.
void addLattice(const Lattice& lattice, const AffineTransform& transform, vtkFieldData* field)
{
  addField<vtkDoubleArray>(field, "LatticeOrigin", &lattice.origin.x, 3);
  addField<vtkDoubleArray>(field, "LatticeSpacing", &lattice.spacing.x, 3);
  addField<vtkIntArray>(field, "LatticeDimensions", lattice.dimensions.data(), 3);
  vtkNew<vtkMatrix4x4> matrix;
  setElements(matrix, transform);
  addField<vtkDoubleArray>(field, "ModelToWorkspace", matrix->GetData(), 16);
}

}

void fillVoxelIndex(vtkPolyData* output, vtkPointSet* input, const std::vector<std::int64_t>& voxels,
  const std::vector<std::int64_t>& rows, const Executor& executor)
{
  output->SetPoints(input->GetPoints());
  output->GetPointData()->PassData(input->GetPointData());
  output->GetPointData()->AddArray(makeIds(voxels, "VoxelIndex", rows, executor));
  output->GetFieldData()->PassData(input->GetFieldData());
}

bool OutputFiller::fill(vtkPolyData* output, const std::vector<VoxelAttribute>& attributes,
  ProgressObserver* observer, std::optional<std::vector<std::int64_t>>& kept) const
{
  vtkPointData* data = output->GetPointData();
  vtkNew<vtkPoints> points;
  points->SetDataType(request.singlePrecision ? VTK_FLOAT : VTK_DOUBLE);
  memory.take(OutputAllocator::Means, points->GetData(), engine.size());
  output->SetPoints(points);
  output->SetVerts(makeVertices(vtkIdType(engine.size()), executor));
  static_assert(sizeof(vtkIdType) == sizeof(std::int64_t), "VTK must be built with 64-bit ids");
  vtkNew<vtkIdTypeArray> counts;
  counts->SetName("VoxelPointCount");
  memory.take(OutputAllocator::Counts, counts, engine.size());
  for (std::size_t i = 0; i < attributes.size(); ++i)
  {
    addWithRoles(data, attributes[i].reduced(engine, request, i, memory, executor), attributes[i].roles);
    if (observer && !observer->report(double(i + 1) / double(attributes.size() + 1)))
    {
      return false;
    }
  }
  data->AddArray(counts);
  if (request.covariances)
  {
    data->AddArray(makeCovariances(engine, memory));
  }
  if (ids)
  {
    data->AddArray(makeIds(*ids, kOriginalPointIds, {}, executor));
  }
  kept = keepVoxels(output, counts, minimumPoints, executor);
  addLattice(engine.lattice(), request.transform, output->GetFieldData());
  return true;
}

} // namespace pointhaptics
