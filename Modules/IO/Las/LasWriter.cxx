#include "IO/WriteTask.h"

#include "Bytes/Checks.h"
#include "Bytes/NumericType.h"
#include "Core/Base/FieldNames.h"
#include "IO/Info/FieldText.h"
#include "IO/Las/LasDescription.h"
#include "IO/Las/LasGrid.h"
#include "IO/Las/LasHeader.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <iterator>
#include <map>
#include <string_view>
#include <type_traits>
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
  const OutputArray* standard(const char* name) const;
  const LasPlace& placeOf(std::size_t field) const
  {
    return extended_ ? kLasFields[field].extended : kLasFields[field].basic;
  }
  bool needsExtended() const;
  void takeStandardArrays();
  void nameArrays();
  double largestExtent() const;
  void planPositions();
  void planStandardFields();
  void planScanSteps(const OutputArray& angles, const LasPlace& place);
  void planColors();
  void planExtraFields();
  void addStored(const OutputArray& stored, const LasExtraField& field);
  void addDescriptor(const OutputArray& array, int component, const std::string& origin);
  void addField(const OutputArray* array, int component, std::size_t offset, int type);
  std::vector<Byte>& bytesAt(std::size_t offset);
  void putCounts(std::string& bytes, bool isOf14) const;
  std::string header(std::size_t pointsOffset, const LasDescription& description) const;
  double fieldValue(const char* name, int component, double otherwise) const;

  std::vector<OutputArray> arrays_;
  std::vector<bool> taken_;
  std::deque<OutputArray> converted_; ///< the references to them stay
  vtkFieldData* fieldData_;
  const LasOrigin origin_; ///< The file that the cloud came from.
  WriteTask& task_;
  WriterNotes& notes_;
  const vtkIdType rows_;
  const bool isPacked_;

  std::array<const OutputArray*, kNumberOfLasFields> standard_{}; ///< Of kLasFields; null: there is none.
  const OutputArray* gpsTime_ = nullptr;
  const OutputArray* wideColor_ = nullptr;
  const OutputArray* color_ = nullptr;
  const OutputArray* nearInfrared_ = nullptr;

  bool extended_ = false;
  int format_ = 0;
  LasGrid grids_[3];
  std::map<std::size_t, std::vector<Byte>> bytes_; ///< of bit fields, by their place; references stay
  std::vector<std::int16_t> scanSteps_;
  std::vector<std::uint16_t> widened_;
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
    standard_[i] = take(field.name, field.type, 1, most);
    const bool isClass = field.name == std::string_view("Classification");
    for (const char* other : { "scalar_Classification", "Class", "Label", "scalar_Label" })
    {
      standard_[i] = !isClass || standard_[i] ? standard_[i] : take(other, field.type, 1, most, field.name);
    }
  }
  gpsTime_ = take("GpsTime", VTK_DOUBLE);
  wideColor_ = take("Color16", VTK_TYPE_UINT16, 3);
  color_ = take("RGB", VTK_TYPE_UINT8, 3);
  nearInfrared_ = take("NearInfrared", VTK_TYPE_UINT16);
}

const OutputArray* LasWriter::standard(const char* name) const
{
  const auto* const field = std::find_if(std::begin(kLasFields), std::end(kLasFields),
    [&](const LasField& each) { return each.name == std::string_view(name); });
  return standard_[static_cast<std::size_t>(field - std::begin(kLasFields))];
}

void LasWriter::nameArrays()
{
  for (std::size_t i = 1; i < arrays_.size(); ++i)
  {
    if (!taken_[i] && isPointField(arrays_[i].name)) // each LAS point has that field, too
    {
      notes_.add("array " + arrays_[i].name + " has values that its LAS field cannot hold");
      arrays_[i].name += "Extra";
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
  bool needs = nearInfrared_ || static_cast<std::uint64_t>(rows_) > 0xffffffffu;
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

void LasWriter::addField(const OutputArray* array, int component, std::size_t offset, int type)
{
  if (array)
  {
    fields_.push_back({ array->column(component), offset, type });
  }
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

double LasWriter::largestExtent() const
{
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    double range[2];
    arrays_[0].array->GetRange(range, axis);
    extent = std::max(extent, range[1] - range[0]);
  }
  return extent;
}

void LasWriter::planPositions()
{
  const double extent = largestExtent();
  const std::string unit = fieldText(fieldData_, "LengthUnit");
  double worst = 0.0;
  double step = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const ConstColumnView column = arrays_[0].column(axis);
    LasGrid& grid = grids_[axis];
    grid = LasGrid::fit(column, rows_,
      { fieldValue("LasScale", axis, 0.0), fieldValue("LasOffset", axis, 0.0), extent, task_.lasScale,
        LasGrid::usualStep(unit, axis) });
    fields_.push_back({ { reinterpret_cast<const char*>(grid.integers.data()), 4, VTK_TYPE_INT32 },
      static_cast<std::size_t>(4 * axis), VTK_TYPE_INT32 });
    const double error = grid.rounds ? grid.largestError : 0.0;
    step = error > worst ? grid.scale : step;
    worst = std::max(worst, error);
    task_.progress(kGridPart * (axis + 1) / 3);
  }
  if (worst > 0.0)
  {
    notes_.add("coordinates are rounded to steps of " + shortestDecimal(step) + ", by at most " +
      fmt::format("{:.3g}", worst) + "; .vtp and .ply keep every bit, --las-scale sets other steps");
  }
}

void LasWriter::planStandardFields()
{
  for (std::size_t i = 0; i < kNumberOfLasFields; ++i)
  {
    const LasPlace& place = placeOf(i);
    const OutputArray* array = place.offset != 0 ? standard_[i] : nullptr;
    if (array && place.bits > 0)
    {
      const Byte* from = static_cast<const Byte*>(array->array->GetVoidPointer(0));
      for (Byte& byte : bytesAt(place.offset))
      {
        byte = static_cast<Byte>(byte | (*from++ & place.mask()) << place.shift);
      }
    }
    else if (array && extended_ && kLasFields[i].type == VTK_FLOAT)
    {
      planScanSteps(*array, place);
    }
    else
    {
      addField(array, 0, place.offset, place.type);
    }
  }
  const LasPointFormat& places = kLasPointFormats[format_];
  addField(gpsTime_, 0, places.gpsTime, VTK_DOUBLE);
  addField(nearInfrared_, 0, places.nearInfrared, VTK_TYPE_UINT16);
}

void LasWriter::planScanSteps(const OutputArray& array, const LasPlace& place)
{
  const float* angles = static_cast<const float*>(array.array->GetVoidPointer(0));
  bool rounded = false;
  for (vtkIdType i = 0; i < rows_; ++i)
  {
    const double steps = std::isfinite(angles[i])
      ? std::clamp(std::nearbyint(static_cast<double>(angles[i]) / kLasScanAngleStep), -32768.0, 32767.0)
      : 0.0;
    scanSteps_.push_back(static_cast<std::int16_t>(steps));
    rounded = rounded || static_cast<float>(kLasScanAngleStep * steps) != angles[i];
  }
  fields_.push_back(
    { { reinterpret_cast<const char*>(scanSteps_.data()), 2, VTK_TYPE_INT16 }, place.offset, place.type });
  if (rounded)
  {
    notes_.add("scan angles are rounded to steps of 0.006 degrees");
  }
}

void LasWriter::planColors()
{
  const std::size_t place = kLasPointFormats[format_].rgb;
  if (!wideColor_ && color_)
  {
    // 0xabab for 0xab: readers take the high byte.
    const Byte* from = static_cast<const Byte*>(color_->array->GetVoidPointer(0));
    widened_.assign(from, from + 3 * rows_);
    std::transform(widened_.begin(), widened_.end(), widened_.begin(),
      [](std::uint16_t v) { return static_cast<std::uint16_t>(257 * v); });
  }
  for (int channel = 0; channel < 3 && place != 0; ++channel)
  {
    const std::size_t offset = place + 2 * static_cast<std::size_t>(channel);
    if (wideColor_)
    {
      addField(wideColor_, channel, offset, VTK_TYPE_UINT16);
    }
    else
    {
      fields_.push_back({ { reinterpret_cast<const char*>(widened_.data() + channel), 6, VTK_TYPE_UINT16 },
        offset, VTK_TYPE_UINT16 });
    }
  }
}

void LasWriter::addStored(const OutputArray& stored, const LasExtraField& field)
{
  converted_.push_back(stored);
  for (int component = 0; component < field.components; ++component)
  {
    addField(&converted_.back(), component, recordSize_, field.type);
    recordSize_ += static_cast<std::size_t>(sizeOfType(field.type));
  }
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
  addField(&array, component, recordSize_, array.type());
  recordSize_ += static_cast<std::size_t>(sizeOfType(array.type()));
}

void LasWriter::planExtraFields()
{
  std::vector<LasExtraField> known;
  forEachLasRecord(origin_,
    [&](const LasRecord& record)
    {
      const bool describes = record.user == "LASF_Spec" && record.id == kLasExtraBytesRecord;
      known = describes ? lasExtraFields(record.content, 0, kMostRecord) : std::move(known);
    });
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
void LasWriter::putCounts(std::string& bytes, bool isOf14) const
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
    if (i < 5 && !extended_)
    {
      putLittle(bytes, 111 + 4 * i, static_cast<std::uint32_t>(byReturn[i]));
    }
    if (isOf14)
    {
      putLittle(bytes, 255 + 8 * i, byReturn[i]);
    }
  }
  if (!extended_)
  {
    putLittle(bytes, 107, static_cast<std::uint32_t>(rows_));
  }
  if (isOf14)
  {
    putLittle(bytes, 247, static_cast<std::uint64_t>(rows_));
  }
}

std::string LasWriter::header(std::size_t pointsOffset, const LasDescription& records) const
{
  const bool isOf14 = records.isOf14;
  std::string bytes(isOf14 ? kLasHeaderOf14 : kLasHeaderOf12, '\0');
  bytes.replace(0, 4, "LASF");
  bytes.replace(26, 5, "OTHER");
  if (origin_.isHere())
  {
    constexpr std::pair<std::size_t, std::size_t> kKept[] = { { 4, 2 }, { 8, 16 }, { 26, 32 }, { 90, 4 } };
    for (const auto& [at, size] : kKept) // source, GUID, system, date
    {
      bytes.replace(at, size, origin_.header, at, size);
    }
  }
  putLittle(bytes, 6, records.encoding);
  bytes[24] = 1;
  bytes[25] = isOf14 ? 4 : 2;
  const std::string program = "PointHaptics";
  bytes.replace(58, program.size(), program);
  putLittle(bytes, 94, static_cast<std::uint16_t>(bytes.size()));
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
  putCounts(bytes, isOf14);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const LasGrid& grid = grids_[axis];
    const auto ends = std::minmax_element(grid.integers.begin(), grid.integers.end());
    putLittle(bytes, 131 + 8 * axis, grid.scale);
    putLittle(bytes, 155 + 8 * axis, grid.offset);
    putLittle(bytes, 179 + 16 * axis, *ends.second * grid.scale + grid.offset);
    putLittle(bytes, 187 + 16 * axis, *ends.first * grid.scale + grid.offset);
  }
  return bytes;
}

void LasWriter::write()
{
  takeStandardArrays();
  nameArrays();
  extended_ = needsExtended() || origin_.pointFormat() >= 6;
  const bool isColored = wideColor_ || color_;
  format_ = extended_ ? (nearInfrared_ ? 8 : isColored ? 7 : 6) : (gpsTime_ ? 1 : 0) + (isColored ? 2 : 0);
  recordSize_ = kLasPointFormats[format_].size;
  planPositions();
  planStandardFields();
  planColors();
  planExtraFields();

  const LasDescription described(origin_, fieldData_,
    { descriptors_, isPacked_ ? lazDescription(format_, recordSize_) : std::string(), extended_ }, notes_);
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
  const std::vector<vtkIdType> left = rowsNotFinite(arrays[0]);
  if (left.empty())
  {
    LasWriter(arrays, task, isPacked).write();
    return;
  }
  task.points = all - static_cast<vtkIdType>(left.size());
  failFormatIf(task.points == 0, "mend the cloud, or write .vtp, .ply or .pcd",
    "all coordinates are NaN or infinite, and LAS stores them as integers");
  task.notes.add(std::to_string(left.size()) + " of " + std::to_string(all) +
    " points are NaN or infinite and left out: LAS stores coordinates as integers; write .vtp, .ply or .pcd "
    "to keep them");
  LasWriter(withoutRows(arrays, left), task, isPacked).write();
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
