#include "IO/WriteTask.h"

#include "Bytes/NumericType.h"
#include "Core/Base/FieldNames.h"
#include "FileProblem.h"
#include "IO/Info/FieldText.h"
#include "IO/Las/LasDescription.h"
#include "IO/Las/LasGrid.h"
#include "IO/Las/LasHeader.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace pointhaptics::io
{

namespace
{

using Byte = std::uint8_t;

constexpr std::size_t kLongestName = 32;
constexpr std::size_t kExtraText = 160; ///< where in the descriptor of an extra field its description begins
constexpr std::size_t kMostRecord = 65535; ///< 16 bits hold the length of a record
constexpr double kGridPart = 0.6;          ///< of the work: finding the grid
constexpr double kPlanningPart = 0.7;      ///< of the work: all that comes before the first record

/// Builds one file; one object per file.
class LasWriter
{
public:
  LasWriter(std::vector<OutputArray> arrays, WriteTask& task, bool isPacked)
    : arrays_(std::move(arrays))
    , taken_(arrays_.size(), false)
    , fieldData_(task.fieldData())
    , origin_(LasOrigin::of(task.fieldData()))
    , task_(task)
    , notes_(task.notes)
    , rows_(arrays_[0].array->GetNumberOfTuples())
    , isPacked_(isPacked)
  {
  }
  void write();

private:
  const OutputArray* take(
    const char* name, int type, int components = 1, double most = INFINITY, const char* field = nullptr);
  const OutputArray* standard(std::string_view name) const { return standard_[lasFieldCalled(name)]; }
  bool needsExtended() const;
  void takeStandardArrays();
  void nameArrays();
  void planPositions();
  void planStandardFields();
  const OutputArray& scanSteps(const OutputArray& angles);
  OutputArray& convertedArray(const OutputArray& array, int type);
  void planExtraFields();
  void addStored(const OutputArray& stored, const LasExtraField& field);
  void addDescriptor(const OutputArray& array, int component, const std::string& origin);
  std::vector<Byte>& bytesAt(std::size_t offset);
  void putCounts(std::string& bytes) const;
  std::string header(std::size_t pointsOffset, const LasDescription& description) const;
  double fieldValue(const char* name, int component, double otherwise) const;

  std::vector<OutputArray> arrays_;
  std::vector<bool> taken_;
  std::deque<OutputArray> converted_; ///< the references to them stay
  vtkFieldData* fieldData_;
  const LasOrigin origin_; ///< The file that the cloud came from.
  WriteTask& task_;
  std::vector<std::string>& notes_;
  const vtkIdType rows_;
  const bool isPacked_;

  std::array<const OutputArray*, kNumberOfLasFields> standard_{}; ///< By kLasFields; null: there is none.

  bool extended_ = false;
  int format_ = 0;
  LasGrid grids_[3];
  std::map<std::size_t, std::vector<Byte>> bytes_; ///< of bit fields, by their place; references stay
  std::vector<RecordField> fields_;
  std::size_t recordSize_ = 0;
  std::string descriptors_;
};

/// The array called @p name as @p type, which becomes the field @p field or the one of its name. Null: none
/// has it with whole values up to @p most.
const OutputArray* LasWriter::take(const char* name, int type, int components, double most, const char* field)
{
  for (std::size_t i = 1; i < arrays_.size(); ++i)
  {
    const OutputArray& array = arrays_[i];
    if (taken_[i] || !isSameField(array.name, name) || array.components() != components)
    {
      continue;
    }
    const bool isWhole = !isFloatingType(type);
    const double largest = isWhole   ? std::min(most, std::ldexp(1.0, 8 * sizeOfType(type)) - 1.0)
      : isFloatingType(array.type()) ? INFINITY
      : type == VTK_FLOAT            ? 0x1p24
                                     : 0x1p53 - 1.0;
    const auto fits = [&](double value)
    { return !(std::abs(value) > largest) && (!isWhole || (value >= 0.0 && value == std::floor(value))); };
    OutputArray converted = array;
    converted.name = field ? field : name;
    if (fixedSizeType(array.type()) != type)
    {
      converted.array = makeArray(type, components, rows_);
    }
    for (vtkIdType row = 0; row < rows_ && (isWhole || converted.array != array.array); ++row)
    {
      for (int component = 0; component < components; ++component)
      {
        const double value = array.array->GetComponent(row, component);
        if (!fits(value))
        {
          return nullptr;
        }
        if (converted.array != array.array)
        {
          converted.array->SetComponent(row, component, value);
        }
      }
    }
    taken_[i] = true;
    arrays_[i].name = converted.name;
    converted_.push_back(converted);
    return &converted_.back();
  }
  return nullptr;
}

void LasWriter::takeStandardArrays()
{
  for (std::size_t i = 0; i < kNumberOfLasFields; ++i)
  {
    const LasField& field = kLasFields[i];
    const double most = field.extended.bits > 0 ? field.extended.mask() : INFINITY;
    standard_[i] = take(field.name, field.type, field.components, most);
    const bool isClass = field.name == std::string_view("Classification");
    for (const char* other : { "scalar_Classification", "Class", "Label", "scalar_Label" })
    {
      standard_[i] = !isClass || standard_[i] ? standard_[i] : take(other, field.type, 1, most, field.name);
    }
  }
  const OutputArray* color = take("RGB", VTK_TYPE_UINT8, 3);
  if (!standard_[kLasColor] && color)
  {
    // 0xabab for 0xab: readers take the high byte.
    const Byte* from = static_cast<const Byte*>(color->array->GetVoidPointer(0));
    OutputArray& wide = convertedArray(*color, VTK_TYPE_UINT16);
    std::transform(from, from + 3 * rows_, static_cast<std::uint16_t*>(wide.array->GetVoidPointer(0)),
      [](Byte v) { return static_cast<std::uint16_t>(257 * v); });
    standard_[kLasColor] = &wide;
  }
}

void LasWriter::nameArrays()
{
  for (std::size_t i = 1; i < arrays_.size(); ++i)
  {
    if (!taken_[i] && isPointField(arrays_[i].name)) // each LAS point has that field, too
    {
      const std::string name = arrays_[i].name + "Extra";
      notes_.push_back("array " + arrays_[i].name +
        " has values that its LAS field cannot hold, and is called " + name +
        " in the extra bytes; scale it to whole numbers for programs that look for the field");
      arrays_[i].name = arrays_[i].given = name;
    }
  }
  const auto columnsOf = [&](const OutputArray& array)
  {
    std::vector<Column> columns = columnsByComponent(array);
    const bool arePoints = &array == arrays_.data();
    for (std::size_t i = 0; i < columns.size() && arePoints; ++i)
    {
      columns[i].name = "xyz"[i];
    }
    const bool isField = taken_[static_cast<std::size_t>(&array - arrays_.data())];
    return isField ? std::vector<Column>{ { array.name, array.type(), array.components() } } : columns;
  };
  chooseNames(arrays_, columnsOf, { NameRule::Any, kLongestName }, notes_);
}

/// True if the point formats 0 to 3 are too narrow.
bool LasWriter::needsExtended() const
{
  bool needs = standard("NearInfrared") || static_cast<std::uint64_t>(rows_) > 0xffffffffu;
  for (std::size_t field = 0; field < kNumberOfLasFields; ++field)
  {
    const LasPlace& place = kLasFields[field].basic;
    const bool areBits = kLasFields[field].extended.bits > 0;
    const auto* values = standard_[field] && areBits
      ? static_cast<const Byte*>(standard_[field]->array->GetVoidPointer(0))
      : nullptr;
    needs = needs || (values && *std::max_element(values, values + rows_) > place.mask());
  }
  const OutputArray* angles = standard("ScanAngle");
  const auto* degrees = angles ? static_cast<const float*>(angles->array->GetVoidPointer(0)) : nullptr;
  return needs ||
    (degrees &&
      !std::all_of(
        degrees, degrees + rows_, [](float d) { return d >= -128.0f && d <= 127.0f && d == std::floor(d); }));
}

double LasWriter::fieldValue(const char* name, int component, double otherwise) const
{
  vtkDataArray* array = fieldData_->GetArray(name);
  return array && array->GetNumberOfComponents() > component && array->GetNumberOfTuples() == 1
    ? array->GetComponent(0, component)
    : otherwise;
}

/// An array like @p array for other values.
OutputArray& LasWriter::convertedArray(const OutputArray& array, int type)
{
  OutputArray& converted = converted_.emplace_back(array);
  converted.array = makeArray(type, array.components(), rows_);
  return converted;
}

/// The bytes at @p offset, which several fields may share.
std::vector<Byte>& LasWriter::bytesAt(std::size_t offset)
{
  const auto [at, isNew] = bytes_.try_emplace(offset, static_cast<std::size_t>(rows_), Byte{ 0 });
  if (isNew)
  {
    fields_.push_back(
      { { reinterpret_cast<const char*>(at->second.data()), 1, VTK_TYPE_UINT8 }, offset, VTK_TYPE_UINT8 });
  }
  return at->second;
}

void LasWriter::planPositions()
{
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* range = arrays_[0].array->GetRange(axis);
    extent = std::max(extent, range[1] - range[0]);
  }
  const std::string unit = fieldText(fieldData_, "LengthUnit");
  double worst = 0.0;
  std::set<double> steps; // of the axes that are rounded
  std::string ofAxes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const ConstColumnView column = arrays_[0].column(axis);
    LasGrid& grid = grids_[axis];
    grid = LasGrid::fit(column, rows_,
      { fieldValue("LasScale", axis, 0.0), fieldValue("LasOffset", axis, 0.0), extent, task_.lasScale,
        LasGrid::usualStep(unit, axis) });
    fields_.push_back({ { reinterpret_cast<const char*>(grid.integers.data()), 4, VTK_TYPE_INT32 },
      static_cast<std::size_t>(4 * axis), VTK_TYPE_INT32 });
    if (grid.rounds)
    {
      steps.insert(grid.scale);
      ofAxes +=
        fmt::format("{}{} in {}", ofAxes.empty() ? "" : ", ", shortestDecimal(grid.scale), "xyz"[axis]);
      worst = std::max(worst, grid.largestError);
    }
    task_.progress(kGridPart * (axis + 1) / 3);
  }
  if (worst > 0.0)
  {
    notes_.push_back(
      fmt::format("coordinates are rounded to steps of {}, by at most {:.3g}; .vtp and .ply keep "
                  "every bit, --las-scale sets other steps",
        steps.size() == 1 ? shortestDecimal(*steps.begin()) : ofAxes, worst));
  }
}

void LasWriter::planStandardFields()
{
  for (std::size_t i = 0; i < kNumberOfLasFields; ++i)
  {
    const LasPlace place = kLasFields[i].placeIn(format_);
    if (place.offset == 0 || !standard_[i])
    {
      continue;
    }
    if (place.bits > 0)
    {
      const Byte* from = static_cast<const Byte*>(standard_[i]->array->GetVoidPointer(0));
      for (Byte& byte : bytesAt(place.offset))
      {
        byte = static_cast<Byte>(byte | (*from++ & place.mask()) << place.shift);
      }
      continue;
    }
    const bool isAngle = extended_ && kLasFields[i].type == VTK_FLOAT;
    addRecordFields(fields_, place.offset, isAngle ? scanSteps(*standard_[i]) : *standard_[i], place.type);
  }
}

/// The angles as LAS 1.4 stores them.
const OutputArray& LasWriter::scanSteps(const OutputArray& array)
{
  const float* angles = static_cast<const float*>(array.array->GetVoidPointer(0));
  OutputArray& steps = convertedArray(array, VTK_TYPE_INT16);
  bool rounded = false;
  std::transform(angles, angles + rows_, static_cast<std::int16_t*>(steps.array->GetVoidPointer(0)),
    [&](float angle)
    {
      const double step = std::isfinite(angle)
        ? std::clamp(std::nearbyint(static_cast<double>(angle) / kLasScanAngleStep), -32768.0, 32767.0)
        : 0.0;
      rounded = rounded || static_cast<float>(kLasScanAngleStep * step) != angle;
      return static_cast<std::int16_t>(step);
    });
  rounded ? notes_.push_back("scan angles are rounded to steps of 0.006 degrees") : void();
  return steps;
}

void LasWriter::addStored(const OutputArray& stored, const LasExtraField& field)
{
  recordSize_ = addRecordFields(fields_, recordSize_, converted_.emplace_back(stored), field.type);
  descriptors_ += field.descriptor;
}

/// @param origin what described the array in another file; empty: nothing did.
void LasWriter::addDescriptor(const OutputArray& array, int component, const std::string& origin)
{
  const std::string kept = array.componentName(component);
  std::string descriptor(kLasExtraDescriptor, '\0');
  descriptor[2] = static_cast<char>(lasTypeCode(array.type()));
  descriptor.replace(4, kept.size(), kept);
  if (!origin.empty())
  {
    descriptor.replace(kExtraText, std::string::npos, origin, kExtraText, std::string::npos);
  }
  descriptors_ += descriptor;
  fields_.push_back({ array.column(component), recordSize_, array.type() });
  recordSize_ += static_cast<std::size_t>(sizeOfType(array.type()));
}

void LasWriter::planExtraFields()
{
  std::vector<LasExtraField> known;
  for (const LasRecord& record : lasRecords(origin_))
  {
    const bool describes = record.is(kLasSpecUser, kLasExtraBytesRecord);
    known = describes ? lasExtraFields(record.content, 0, kMostRecord) : std::move(known);
  }
  for (std::size_t i = 1; i < arrays_.size(); ++i)
  {
    const OutputArray& array = arrays_[i];
    const auto field = std::find_if(known.begin(), known.end(),
      [&](const LasExtraField& each) { return each.name == array.name && !each.descriptor.empty(); });
    OutputArray stored{ ArrayRole::Other, array.name, {}, array.given };
    if (!taken_[i] && field != known.end() && storeAsBefore(array, *field, stored))
    {
      addStored(stored, *field);
      continue;
    }
    for (int component = 0; component < array.components() && !taken_[i]; ++component)
    {
      addDescriptor(array, component, field != known.end() ? field->descriptor : std::string());
    }
  }
  failFormatIf(recordSize_ > kMostRecord || descriptors_.size() > kMostRecord,
    "LAS holds 341 of them: leave some out, or write .vtp, .ply or .pcd",
    "{} columns beside the standard ones", descriptors_.size() / kLasExtraDescriptor);
}

/// Points, and those of each number of return.
void LasWriter::putCounts(std::string& bytes) const
{
  std::uint64_t byReturn[15] = {};
  const OutputArray* numbers = standard("ReturnNumber");
  const Byte* returns = numbers ? static_cast<const Byte*>(numbers->array->GetVoidPointer(0)) : nullptr;
  for (vtkIdType i = 0; i < rows_; ++i)
  {
    const int number = returns ? returns[i] : 0;
    if (number >= 1 && number <= 15)
    {
      ++byReturn[number - 1];
    }
  }
  for (std::size_t i = 0; i < 15; ++i)
  {
    putLittle(bytes, 255 + 8 * i, byReturn[i]);
    i < 5 && !extended_ ? putLittle(bytes, 111 + 4 * i, static_cast<std::uint32_t>(byReturn[i])) : void();
  }
  putLittle(bytes, 247, static_cast<std::uint64_t>(rows_));
  putLittle(bytes, 107, extended_ ? 0u : static_cast<std::uint32_t>(rows_));
}

/// As for LAS 1.4, of which older versions have the beginning.
std::string LasWriter::header(std::size_t pointsOffset, const LasDescription& records) const
{
  const std::size_t size = records.isOf14 ? kLasHeaderOf14 : kLasHeaderOf12;
  std::string bytes(kLasHeaderOf14, '\0');
  bytes.replace(0, 4, "LASF");
  bytes.replace(26, 5, "OTHER");
  if (origin_.isHere())
  {
    constexpr std::pair<std::size_t, std::size_t> kKept[] = { { 4, 2 }, { 8, 16 }, { 26, 32 }, { 90, 4 } };
    for (const auto& [at, length] : kKept) // source, GUID, system, date
    {
      bytes.replace(at, length, origin_.header, at, length);
    }
  }
  putLittle(bytes, 6, records.encoding);
  bytes[24] = 1;
  bytes[25] = records.isOf14 ? 4 : 2;
  const std::string program = "PointHaptics";
  bytes.replace(58, program.size(), program);
  putLittle(bytes, 94, static_cast<std::uint16_t>(size));
  putLittle(bytes, 96, static_cast<std::uint32_t>(pointsOffset));
  putLittle(bytes, 100, records.count);
  bytes[104] = static_cast<char>(isPacked_ ? format_ | kLasPackedBit : format_);
  putLittle(bytes, 105, static_cast<std::uint16_t>(recordSize_));
  if (records.farCount > 0)
  {
    putLittle(
      bytes, 235, static_cast<std::uint64_t>(pointsOffset + recordSize_ * static_cast<std::size_t>(rows_)));
    putLittle(bytes, 243, records.farCount);
  }
  putCounts(bytes);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const LasGrid& grid = grids_[axis];
    const auto ends = std::minmax_element(grid.integers.begin(), grid.integers.end());
    putLittle(bytes, 131 + 8 * axis, grid.scale);
    putLittle(bytes, 155 + 8 * axis, grid.offset);
    putLittle(bytes, 179 + 16 * axis, *ends.second * grid.scale + grid.offset);
    putLittle(bytes, 187 + 16 * axis, *ends.first * grid.scale + grid.offset);
  }
  bytes.resize(size);
  return bytes;
}

void LasWriter::write()
{
  takeStandardArrays();
  nameArrays();
  extended_ = needsExtended() || origin_.pointFormat() >= 6;
  const bool isColored = standard_[kLasColor];
  format_ = extended_ ? (standard("NearInfrared") ? 8
                            : isColored           ? 7
                                                  : 6)
                      : (standard("GpsTime") ? 1 : 0) + (isColored ? 2 : 0);
  recordSize_ = kLasPointFormats[format_].size;
  planPositions();
  planStandardFields();
  planExtraFields();

  const LasDescription described(origin_, fieldData_, descriptors_,
    isPacked_ ? lazDescription(format_, recordSize_) : std::string(), extended_, notes_);
  const std::size_t pointsOffset = header(0, described).size() + described.bytes.size();
  task_.out.write(header(pointsOffset, described) + described.bytes);
  if (isPacked_)
  {
    writeLazRecords(fields_, format_, recordSize_, pointsOffset, rows_, task_, kPlanningPart);
  }
  else
  {
    writeRecords(fields_, recordSize_, rows_, task_, kPlanningPart);
    task_.out.write(described.far);
  }
}

void writeRecordsOf(WriteTask& task, bool isPacked)
{
  const std::vector<OutputArray> arrays = outputArrays(task.cloud, task.notes);
  const vtkIdType all = arrays[0].array->GetNumberOfTuples();
  bool isWhole = false;
  vtkNew<vtkIdList> kept; // where some are left out
  withType(arrays[0].type(),
    [&](auto zero)
    {
      const auto* p = static_cast<const decltype(zero)*>(arrays[0].array->GetVoidPointer(0));
      const auto isFinite = [](decltype(zero) value) { return std::isfinite(static_cast<double>(value)); };
      isWhole = std::all_of(p, p + 3 * all, isFinite);
      for (vtkIdType row = 0; row < all && !isWhole; ++row, p += 3)
      {
        std::all_of(p, p + 3, isFinite) ? void(kept->InsertNextId(row)) : void();
      }
    });
  task.points = isWhole ? all : kept->GetNumberOfIds();
  if (isWhole)
  {
    LasWriter(arrays, task, isPacked).write();
    return;
  }
  failFormatIf(task.points == 0, "mend the cloud, or write .vtp, .ply or .pcd",
    "all coordinates are NaN or infinite, and LAS stores them as integers");
  task.notes.push_back(std::to_string(all - task.points) + " of " + std::to_string(all) +
    " points are NaN or infinite and left out: LAS stores coordinates as integers; write .vtp, .ply or .pcd "
    "to keep them");
  vtkNew<vtkPolyData> finite;
  finite->SetPoints(task.cloud->GetPoints());
  finite->GetPointData()->ShallowCopy(task.cloud->GetPointData());
  keepPoints(finite, kept);
  std::vector<std::string> said;
  LasWriter(outputArrays(finite, said), task, isPacked).write();
}

} // namespace

/// LAS 1.2, or 1.4 where the arrays or well-known text need it. Arrays that the reader makes of LAS fields
/// become these again, others extra bytes.
void writeLas(WriteTask& task)
{
  writeRecordsOf(task, false);
}

/// Writes LAS records compressed.
void writeLaz(WriteTask& task)
{
  writeRecordsOf(task, true);
}

} // namespace pointhaptics::io
