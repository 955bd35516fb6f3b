#include "ReadTask.h"

#include "IO/Info/FieldText.h"
#include "IO/Las/LasRecords.h"
#include "IO/Las/LazReader.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <optional>

namespace pointhaptics::io
{

namespace
{

void addTriple(vtkPolyData* cloud, const char* name, const std::array<double, 3>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->InsertNextTuple(values.data());
  cloud->GetFieldData()->AddArray(array);
}

/// The records from number @p begin on, as many as @p header counts.
void readPlain(const ReadTask& task, const LasHeader& header, std::uint64_t begin, LasRecords& records)
{
  const vtkIdType rows = static_cast<vtkIdType>(header.count);
  const std::size_t offset = header.pointsOffset + static_cast<std::size_t>(begin) * header.recordLength;
  task.need(offset, static_cast<std::size_t>(header.count) * header.recordLength);
  const char* first = task.bytes.data() + offset;
  for (vtkIdType row = 0; row < rows; row += kLasBlockRows)
  {
    const vtkIdType count = std::min(kLasBlockRows, rows - row);
    records.fill({ first + static_cast<std::size_t>(row) * header.recordLength, row, count });
    if (row % (16 * kLasBlockRows) == 0)
    {
      task.progress(static_cast<double>(row + count) / static_cast<double>(rows));
    }
  }
}

void addBytes(vtkPolyData* cloud, const char* name, const std::string& bytes)
{
  if (!bytes.empty())
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(name);
    array->SetNumberOfValues(static_cast<vtkIdType>(bytes.size()));
    std::copy(bytes.begin(), bytes.end(), array->GetPointer(0));
    cloud->GetFieldData()->AddArray(array);
  }
}

std::string bytesOf(vtkFieldData* fieldData, const char* name)
{
  auto* array = vtkUnsignedCharArray::SafeDownCast(fieldData->GetArray(name));
  return array ? std::string(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues())
               : std::string();
}

/// Runs @p work on packed points; a fault of these is one that --salvage may pass.
template <typename Work>
void withPacked(const ReadTask& task, Work&& work)
{
  try
  {
    work();
  }
  catch (const FileProblem& problem)
  {
    throw task.salvage
      ? problem
      : FileProblem(problem.code, std::string(problem.what()) + ", or read what is there by --salvage");
  }
}

} // namespace

void LasOrigin::addTo(vtkPolyData* cloud) const
{
  addBytes(cloud, "LasHeader", header);
  addBytes(cloud, "LasRecords", records);
  addBytes(cloud, "LasFarRecords", farRecords);
}

LasOrigin LasOrigin::of(vtkFieldData* fieldData)
{
  return { bytesOf(fieldData, "LasHeader"), bytesOf(fieldData, "LasRecords"),
    bytesOf(fieldData, "LasFarRecords") };
}

void readLas(ReadTask& task, vtkPolyData* cloud)
{
  needLasHeader(task);
  const std::string version =
    task.bytes.size() > 25 ? " 1." + std::to_string(byteAt(task.bytes.data(), 25)) : std::string();
  task.format = "LAS" + version;
  LasHeader header = parseLasHeader(task.bytes, &task);
  task.format = (header.packing.empty() ? "LAS" : header.packing) + version + " (point format " +
    std::to_string(header.pointFormat) + ")";
  std::optional<LazReader> packed;
  const RowRange rows = header.packing.empty() ? task.rowsOf(header.count) : RowRange();
  if (header.packing.empty())
  {
    header.count = rows.count();
  }
  else
  {
    withPacked(task, [&] { packed.emplace(task, header); });
    header.count = packed->count();
    task.isCoarse = packed->isCoarse();
  }
  LasRecords records(header, task.wanted.onlyPositions);
  if (packed)
  {
    withPacked(task, [&] { packed->read(records); });
  }
  else
  {
    readPlain(task, header, rows.first, records);
  }
  if (task.shared)
  {
    records.agree(*task.shared);
  }
  records.moveTo(cloud);
  header.origin.addTo(cloud);
  addTriple(cloud, "LasScale", header.scale);
  addTriple(cloud, "LasOffset", header.offset);
  vtkNew<vtkIntArray> encoding;
  encoding->SetName("LasGlobalEncoding");
  encoding->InsertNextValue(header.globalEncoding);
  cloud->GetFieldData()->AddArray(encoding);
  if (packed)
  {
    vtkNew<vtkTypeInt64Array> chunks;
    chunks->SetName("Chunks");
    chunks->InsertNextValue(packed->numberOfChunks());
    cloud->GetFieldData()->AddArray(chunks);
  }
  addFieldText(cloud, "Generator", header.generator);
  addFieldText(cloud, "CoordinateSystem", header.coordinateSystem);
  addFieldText(cloud, "LengthUnit", header.lengthUnit);
}

} // namespace pointhaptics::io
