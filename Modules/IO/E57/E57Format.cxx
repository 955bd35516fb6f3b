#include "ReadTask.h"

#include "Bytes/DisjointRanges.h"
#include "Bytes/NumericType.h"
#include "FileProblem.h"
#include "IO/Bytes/XmlTree.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/E57/E57Columns.h"
#include "IO/E57/E57Decoder.h"
#include "IO/E57/E57Packets.h"
#include "IO/E57/E57Scan.h"
#include "IO/Info/FieldText.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <set>

namespace pointhaptics::io
{

namespace
{

/// Part of the parsing that checking the pages takes.
constexpr double kCheckingPart = 0.2;
/// Blocks between two reports of progress.
constexpr vtkIdType kReportedBlocks = 64;
/// Most bytes of arrays for one byte of the file, as for gzip: constant fields take no bytes in the file.
constexpr std::uint64_t kMostGrowth = 100;
constexpr std::uint64_t kGrowthFloor = std::uint64_t{ 1 } << 26;

XmlElement xmlOf(const E57Pages& pages)
{
  std::array<char, 65536> part;
  std::uint64_t left = pages.xmlLength();
  return parseXml(
    [&]
    {
      const std::size_t size = static_cast<std::size_t>(std::min<std::uint64_t>(left, part.size()));
      pages.copy(pages.xmlOffset() + pages.xmlLength() - left, size, part.data());
      left -= size;
      return std::string_view(part.data(), size);
    },
    true);
}

/// Adds the file's properties beside its points as field data.
void addFieldData(const E57Contents& contents, vtkPolyData* cloud)
{
  addFieldText(cloud, "Generator", contents.generator);
  addFieldText(cloud, "CoordinateSystem", contents.coordinateSystem);
  addFieldText(cloud, "LengthUnit", "metre");
  vtkNew<vtkStringArray> names;
  names->SetName("ScanNames");
  vtkNew<vtkTypeInt64Array> points;
  points->SetName("ScanPoints");
  vtkNew<vtkDoubleArray> poses;
  poses->SetName("ScanPoses");
  poses->SetNumberOfComponents(7);
  for (const E57Scan& scan : contents.scans)
  {
    names->InsertNextValue(scan.name);
    points->InsertNextValue(static_cast<vtkTypeInt64>(scan.records));
    const auto& t = scan.pose.translation;
    const auto& q = scan.pose.rotation;
    const double pose[7] = { t[0], t[1], t[2], q[0], q[1], q[2], q[3] };
    poses->InsertNextTuple(pose);
  }
  cloud->GetFieldData()->AddArray(names);
  cloud->GetFieldData()->AddArray(points);
  cloud->GetFieldData()->AddArray(poses);
}

/// The grid of the coordinates, under the names that the writer of LAS knows, where nothing moves them off
/// it.
void addGrid(const std::vector<E57Scan>& scans, bool moves, vtkPolyData* cloud)
{
  double scale[3] = {};
  double offset[3] = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name = std::string("cartesian") + static_cast<char>('X' + axis);
    for (const E57Scan& scan : scans)
    {
      const std::size_t at = scan.find(name);
      const bool isFirst = scan.number == scans.front().number;
      if (moves || at == E57Scan::npos || scan.fields[at].kind != E57Field::Kind::Scaled ||
        (!isFirst && (scan.fields[at].scale != scale[axis] || scan.fields[at].offset != offset[axis])))
      {
        return;
      }
      scale[axis] = scan.fields[at].scale;
      offset[axis] = scan.fields[at].offset;
    }
  }
  addFieldNumbers<vtkDoubleArray>(cloud, "LasScale", scale);
  addFieldNumbers<vtkDoubleArray>(cloud, "LasOffset", offset);
}

/// Notes the section from @p begin to @p end.
void addSection(DisjointRanges& sections, std::uint64_t begin, std::uint64_t end)
{
  failDamagedIf(!sections.add(begin, end), E57Pages::physical(begin),
    "a section of {} bytes that overlaps another one", end - begin);
}

/// @return the number of points. @throws FileProblem before anything of their size is allocated.
vtkIdType checkedRows(const std::vector<E57Scan>& scans, const E57Columns& plan, std::uint64_t fileSize)
{
  std::uint64_t rows = 0;
  for (const E57Scan& scan : scans)
  {
    rows += scan.records; // each at most eight times the bytes of its section
  }
  std::uint64_t rowSize = 0;
  for (const Column& column : plan.all())
  {
    rowSize += static_cast<std::uint64_t>(column.components * sizeOfType(column.type));
  }
  const std::uint64_t most = std::max(kGrowthFloor, kMostGrowth * fileSize);
  failFormatIf(rows > most / rowSize, "the file is damaged or hostile: write it again",
    "{} points of {} bytes would be more than {} times the file's size", rows, rowSize, kMostGrowth);
  return static_cast<vtkIdType>(rows);
}

void decode(const ReadTask& task, const E57Decoder& decoder, vtkIdType first, vtkIdType rows)
{
  const vtkIdType blocks = decoder.blocks();
  for (vtkIdType begin = 0; begin < blocks; begin += kReportedBlocks)
  {
    const vtkIdType end = std::min(begin + kReportedBlocks, blocks);
    vtkSMPTools::For(begin, end, 1,
      [&](vtkIdType from, vtkIdType to)
      {
        for (; from < to; ++from)
        {
          decoder.decode(from);
        }
      });
    const double done = static_cast<double>(first + end * E57Decoder::kBlockRows) / static_cast<double>(rows);
    task.progress(kCheckingPart + (1.0 - kCheckingPart) * std::min(done, 1.0));
  }
}

/// Flags that no point sets say nothing.
void dropUnsetFlags(vtkPolyData* cloud)
{
  vtkPointData* data = cloud->GetPointData();
  for (int i = data->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    vtkDataArray* array = data->GetArray(i);
    double range[2] = { 0.0, 0.0 };
    if (array && isE57Flag(array->GetName()))
    {
      array->GetRange(range, 0);
      if (range[0] == 0.0 && range[1] == 0.0)
      {
        data->RemoveArray(i);
      }
    }
  }
}

/// The scanner's grid, where the points are all of its cells, row after row.
void addDimensions(vtkPolyData* cloud)
{
  vtkDataArray* row = cloud->GetPointData()->GetArray("RowIndex");
  vtkDataArray* column = cloud->GetPointData()->GetArray("ColumnIndex");
  if (!row || !column || cloud->GetPointData()->HasArray("ScanIndex"))
  {
    return;
  }
  double rows[2], columns[2];
  row->GetRange(rows, 0);
  column->GetRange(columns, 0);
  const double width = columns[1] - columns[0] + 1.0;
  const double height = rows[1] - rows[0] + 1.0;
  constexpr double kMost = std::numeric_limits<int>::max();
  if (!(height > 1.0 && width <= kMost && height <= kMost) ||
    width * height != static_cast<double>(cloud->GetNumberOfPoints()))
  {
    return;
  }
  const vtkIdType wide = static_cast<vtkIdType>(width);
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    if (row->GetComponent(i, 0) != rows[0] + static_cast<double>(i / wide) ||
      column->GetComponent(i, 0) != columns[0] + static_cast<double>(i % wide))
    {
      return;
    }
  }
  addFieldNumbers<vtkIntArray>(
    cloud, "OrganizedDimensions", std::array{ static_cast<int>(width), static_cast<int>(height) });
}

/// Notes the parts of the file that the cloud lacks.
void addNotes(
  const E57Contents& contents, const std::vector<E57Scan>& scans, const E57Columns& plan, ReadTask& task)
{
  if (contents.images > 0)
  {
    task.notes.push_back(fmt::format(
      "{} {} not read: only points are", contents.images, contents.images == 1 ? "image is" : "images are"));
  }
  std::set<std::string> texts;
  std::vector<std::size_t> missing(plan.all().size(), 0);
  for (std::size_t i = 0; i < scans.size(); ++i)
  {
    for (const E57Field& field : scans[i].fields)
    {
      field.kind == E57Field::Kind::Text ? void(texts.insert(field.name)) : void();
    }
    for (const std::size_t column : plan.missing(i))
    {
      ++missing[column];
    }
  }
  for (const std::string& name : texts)
  {
    task.notes.push_back("the texts of field " + inQuotes(name) + " are not read: arrays hold numbers");
  }
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    const Column& column = plan.all()[i];
    if (missing[i] > 0 && !isE57Flag(column.name))
    {
      task.notes.push_back(fmt::format("{} of {} scans have no {}: their points have {} there", missing[i],
        scans.size(), inQuotes(column.name), isFloatingType(column.type) ? "NaN" : "0"));
    }
  }
}

std::vector<E57Scan> scansWithPoints(const E57Contents& contents)
{
  if (contents.scans.empty())
  {
    throw NoPoints("the file is valid, but it holds no scan");
  }
  std::vector<E57Scan> scans;
  std::copy_if(contents.scans.begin(), contents.scans.end(), std::back_inserter(scans),
    [](const E57Scan& scan) { return scan.records > 0; });
  if (scans.empty())
  {
    const std::size_t count = contents.scans.size();
    throw NoPoints(fmt::format(
      "the file is valid, but its {} {} no points", count, count == 1 ? "scan holds" : "scans hold"));
  }
  return scans;
}

} // namespace

void readE57(ReadTask& task, vtkPolyData* cloud)
{
  const E57Pages pages(task.bytes);
  task.format = "E57 " + pages.version();
  pages.check(task, kCheckingPart);
  const E57Contents contents = parseE57Contents(xmlOf(pages));
  addFieldData(contents, cloud);
  std::vector<E57Scan> scans = scansWithPoints(contents);
  DisjointRanges sections;
  addSection(sections, pages.xmlOffset(), pages.xmlOffset() + pages.xmlLength());
  std::deque<E57Packets> packets;
  for (E57Scan& scan : scans)
  {
    packets.emplace_back(pages, scan, fmt::format("scan {} {}", scan.number + 1, inQuotes(scan.name)), task);
    addSection(sections, packets.back().begin(), packets.back().end());
  }
  const bool moves = task.applyPoses &&
    std::any_of(scans.begin(), scans.end(), [](const E57Scan& scan) { return !scan.pose.isIdentity(); });
  const E57Columns plan(scans, moves);
  const vtkIdType rows = checkedRows(scans, plan, task.bytes.size());
  CloudColumns columns(plan.all(), rows);
  vtkIdType first = 0;
  for (std::size_t i = 0; i < scans.size(); ++i)
  {
    const E57Decoder decoder(plan, columns, scans[i], i, packets[i], first, task.applyPoses);
    decode(task, decoder, first, rows);
    first += static_cast<vtkIdType>(scans[i].records);
  }
  columns.moveTo(cloud, task);
  dropUnsetFlags(cloud);
  addDimensions(cloud);
  addGrid(scans, moves, cloud);
  addNotes(contents, scans, plan, task);
}

} // namespace pointhaptics::io
