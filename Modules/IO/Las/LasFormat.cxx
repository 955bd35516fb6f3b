#include "FormatReaders.h"

#include "CloudColumns.h"
#include "IO/Las/LasHeader.h"
#include "IO/Las/LazPoints.h"
#include "NumericType.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace pointhaptics::io
{

namespace
{

using Byte = std::uint8_t;

/// Records of a block stay in the cache while their columns are filled one after the other.
constexpr vtkIdType kBlockRows = 4096;
/// Degrees of one step of the scan angle in point formats 6 to 10.
constexpr double kScanAngleStep = 0.006;

/// Indices into the list of columns, in its order.
enum LasColumn : std::size_t
{
  kX,
  kY,
  kZ,
  kIntensity,
  kReturnNumber,
  kNumberOfReturns,
  kClassification,
  kScanAngle,
  kUserData,
  kPointSourceId,
  kFixedColumns
};

/// The columns, and which of them holds what only some files have.
struct LasColumns
{
  std::vector<Column> all = { { "x", VTK_DOUBLE }, { "y", VTK_DOUBLE }, { "z", VTK_DOUBLE },
    { "Intensity", VTK_TYPE_UINT16 }, { "ReturnNumber", VTK_TYPE_UINT8 },
    { "NumberOfReturns", VTK_TYPE_UINT8 }, { "Classification", VTK_TYPE_UINT8 }, { "ScanAngle", VTK_FLOAT },
    { "UserData", VTK_TYPE_UINT8 }, { "PointSourceId", VTK_TYPE_UINT16 } };
  std::size_t gpsTime;
  std::size_t wideColor;
  std::size_t color;
  std::size_t nearInfrared;
  std::size_t firstExtra;

  explicit LasColumns(const LasHeader& header)
  {
    const LasPointFormat& fields = header.fields();
    gpsTime = addIf(fields.gpsTime, { "GpsTime", VTK_DOUBLE });
    wideColor = addIf(fields.rgb, { "Color16", VTK_TYPE_UINT16, 3 });
    color = addIf(fields.rgb, { "RGB", VTK_TYPE_UINT8, 3 });
    nearInfrared = addIf(fields.nearInfrared, { "NearInfrared", VTK_TYPE_UINT16 });
    firstExtra = all.size();
    for (const LasExtraField& field : header.extraFields)
    {
      all.push_back({ field.name, field.isScaled ? VTK_DOUBLE : field.type, field.components });
    }
  }

private:
  std::size_t addIf(std::size_t offset, const Column& column)
  {
    if (offset != 0)
    {
      all.push_back(column);
    }
    return all.size() - 1;
  }
};

/// An array for bits that most files leave at zero: it comes to be with the first one that is set.
class RareBits
{
public:
  explicit RareBits(const char* name)
    : name_(name)
  {
  }
  /// values[i] = bits(record i) for @p count records, the first of which is the point @p row of @p rows.
  template <typename Bits>
  void fill(
    const char* records, std::size_t stride, vtkIdType row, vtkIdType count, vtkIdType rows, Bits bits)
  {
    if (!array_)
    {
      Byte any = 0;
      for (vtkIdType i = 0; i < count; ++i)
      {
        any = static_cast<Byte>(any | bits(records + static_cast<std::size_t>(i) * stride));
      }
      if (any == 0)
      {
        return;
      }
      array_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
      array_->SetName(name_);
      array_->SetNumberOfValues(rows);
      std::fill_n(array_->GetPointer(0), rows, Byte{ 0 });
    }
    Byte* to = array_->GetPointer(row);
    for (vtkIdType i = 0; i < count; ++i)
    {
      to[i] = bits(records + static_cast<std::size_t>(i) * stride);
    }
  }
  void moveTo(vtkPolyData* cloud) const
  {
    if (array_)
    {
      cloud->GetPointData()->AddArray(array_);
    }
  }

private:
  const char* name_;
  vtkSmartPointer<vtkUnsignedCharArray> array_;
};

Byte byteAt(const char* record, std::size_t offset)
{
  return static_cast<Byte>(record[offset]);
}

/// Fills the arrays block by block; one object per file.
class LasRecords
{
public:
  explicit LasRecords(const LasHeader& header)
    : header_(header)
    , names_(header)
    , rows_(static_cast<vtkIdType>(header.count))
    , columns_(names_.all, rows_)
  {
  }
  /// @p records: @p count of them, the first of which is the point @p row.
  void fill(const char* records, vtkIdType row, vtkIdType count);
  void fillColors();
  void moveTo(vtkPolyData* cloud);

private:
  /// target[i] = change(number at offset in record i).
  template <typename From, typename To, typename Change>
  void fillColumn(std::size_t column, std::size_t offset, Change change, int component = 0) const
  {
    const ColumnView view = columns_.target(column, component).fromRow(row_);
    char* to = view.first;
    const char* from = first_ + offset;
    for (vtkIdType i = 0; i < count_; ++i, from += header_.recordLength, to += view.stride)
    {
      const To value = static_cast<To>(change(loadLittle<From>(from)));
      std::memcpy(to, &value, sizeof(To));
    }
  }
  template <typename T>
  void copyColumn(std::size_t column, std::size_t offset, int component = 0) const
  {
    fillColumn<T, T>(
      column, offset, [](T value) { return value; }, component);
  }
  void fillPosition() const;
  void fillLegacy();
  void fillExtended();
  void fillExtra() const;
  template <typename Bits>
  void fillRare(RareBits& array, Bits bits) const
  {
    array.fill(first_, header_.recordLength, row_, count_, rows_, bits);
  }

  const LasHeader& header_;
  const LasColumns names_;
  const vtkIdType rows_;
  CloudColumns columns_;
  const char* first_ = nullptr; ///< of the block
  vtkIdType row_ = 0;           ///< of the block
  vtkIdType count_ = 0;         ///< of the block
  RareBits flags_{ "ClassificationFlags" };
  RareBits scannerChannel_{ "ScannerChannel" };
  RareBits scanDirection_{ "ScanDirection" };
  RareBits edgeOfFlightLine_{ "EdgeOfFlightLine" };
};

void LasRecords::fillPosition() const
{
  const ColumnView view = columns_.target(kX).fromRow(row_);
  const std::array<double, 3> scale = header_.scale;
  const std::array<double, 3> offset = header_.offset;
  const char* from = first_;
  char* to = view.first;
  for (vtkIdType i = 0; i < count_; ++i, from += header_.recordLength, to += view.stride)
  {
    const double point[3] = { loadLittle<std::int32_t>(from) * scale[0] + offset[0],
      loadLittle<std::int32_t>(from + 4) * scale[1] + offset[1],
      loadLittle<std::int32_t>(from + 8) * scale[2] + offset[2] };
    std::memcpy(to, point, sizeof(point));
  }
}

void LasRecords::fillLegacy()
{
  fillColumn<Byte, Byte>(kReturnNumber, 14, [](Byte b) { return b & 0x07; });
  fillColumn<Byte, Byte>(kNumberOfReturns, 14, [](Byte b) { return b >> 3 & 0x07; });
  fillColumn<Byte, Byte>(kClassification, 15, [](Byte b) { return b & 0x1f; });
  fillColumn<std::int8_t, float>(kScanAngle, 16, [](std::int8_t degrees) { return degrees; });
  copyColumn<Byte>(kUserData, 17);
  copyColumn<std::uint16_t>(kPointSourceId, 18);
  fillRare(flags_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) >> 5); });
  fillRare(scanDirection_, [](const char* record) { return static_cast<Byte>(byteAt(record, 14) >> 6 & 1); });
  fillRare(edgeOfFlightLine_, [](const char* record) { return static_cast<Byte>(byteAt(record, 14) >> 7); });
}

void LasRecords::fillExtended()
{
  fillColumn<Byte, Byte>(kReturnNumber, 14, [](Byte b) { return b & 0x0f; });
  fillColumn<Byte, Byte>(kNumberOfReturns, 14, [](Byte b) { return b >> 4; });
  copyColumn<Byte>(kClassification, 16);
  copyColumn<Byte>(kUserData, 17);
  fillColumn<std::int16_t, float>(
    kScanAngle, 18, [](std::int16_t steps) { return kScanAngleStep * static_cast<double>(steps); });
  copyColumn<std::uint16_t>(kPointSourceId, 20);
  fillRare(flags_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) & 0x0f); });
  fillRare(
    scannerChannel_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) >> 4 & 3); });
  fillRare(scanDirection_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) >> 6 & 1); });
  fillRare(edgeOfFlightLine_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) >> 7); });
}

void LasRecords::fillExtra() const
{
  for (std::size_t i = 0; i < header_.extraFields.size(); ++i)
  {
    const LasExtraField& field = header_.extraFields[i];
    for (int component = 0; component < field.components; ++component)
    {
      const std::size_t at = field.offset + static_cast<std::size_t>(component * sizeOfType(field.type));
      const double scale = field.scale[static_cast<std::size_t>(std::min(component, 2))];
      const double shift = field.shift[static_cast<std::size_t>(std::min(component, 2))];
      withType(field.type,
        [&](auto zero)
        {
          using T = decltype(zero);
          if (field.isScaled)
          {
            fillColumn<T, double>(
              names_.firstExtra + i, at, [=](T v) { return scale * static_cast<double>(v) + shift; },
              component);
          }
          else
          {
            copyColumn<T>(names_.firstExtra + i, at, component);
          }
        });
    }
  }
}

void LasRecords::fill(const char* records, vtkIdType row, vtkIdType count)
{
  row_ = row;
  count_ = count;
  first_ = records;
  const LasPointFormat& fields = header_.fields();
  fillPosition();
  copyColumn<std::uint16_t>(kIntensity, 12);
  header_.isExtended() ? fillExtended() : fillLegacy();
  if (fields.gpsTime != 0)
  {
    copyColumn<double>(names_.gpsTime, fields.gpsTime);
  }
  for (int channel = 0; channel < 3 && fields.rgb != 0; ++channel)
  {
    copyColumn<std::uint16_t>(names_.wideColor, fields.rgb + 2 * static_cast<std::size_t>(channel), channel);
  }
  if (fields.nearInfrared != 0)
  {
    copyColumn<std::uint16_t>(names_.nearInfrared, fields.nearInfrared);
  }
  fillExtra();
}

/// 8-bit colours: the high byte, or the value itself in files that (against the standard) store 0..255.
void LasRecords::fillColors()
{
  if (header_.fields().rgb == 0)
  {
    return;
  }
  const std::uint16_t* from = reinterpret_cast<const std::uint16_t*>(columns_.target(names_.wideColor).first);
  Byte* to = reinterpret_cast<Byte*>(columns_.target(names_.color).first);
  const vtkIdType values = 3 * rows_;
  const bool sixteenBit = std::any_of(from, from + values, [](std::uint16_t v) { return v > 255; });
  const int shift = sixteenBit ? 8 : 0;
  std::transform(from, from + values, to, [=](std::uint16_t v) { return static_cast<Byte>(v >> shift); });
}

void LasRecords::moveTo(vtkPolyData* cloud)
{
  columns_.moveTo(cloud);
  for (const RareBits* bits : { &flags_, &scannerChannel_, &scanDirection_, &edgeOfFlightLine_ })
  {
    bits->moveTo(cloud);
  }
}

void addText(vtkPolyData* cloud, const char* name, const std::string& text)
{
  if (!text.empty())
  {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    cloud->GetFieldData()->AddArray(array);
  }
}

void addTriple(vtkPolyData* cloud, const char* name, const std::array<double, 3>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->InsertNextTuple(values.data());
  cloud->GetFieldData()->AddArray(array);
}

} // namespace

void readLas(ReadTask& task, vtkPolyData* cloud)
{
  const std::string version =
    task.bytes.size() > 25 ? " 1." + std::to_string(byteAt(task.bytes.data(), 25)) : std::string();
  task.format = "LAS" + version;
  const LasHeader header = parseLasHeader(task.bytes);
  task.format = (header.packing.empty() ? "LAS" : header.packing) + version + " (point format " +
    std::to_string(header.pointFormat) + ")";
  std::optional<LazPoints> packed;
  if (!header.packing.empty())
  {
    packed.emplace(task, header);
  }
  LasRecords records(header);
  const vtkIdType rows = static_cast<vtkIdType>(header.count);
  const char* plain = task.bytes.data() + header.pointsOffset;
  for (vtkIdType row = 0; row < rows; row += kBlockRows)
  {
    const vtkIdType count = std::min(kBlockRows, rows - row);
    records.fill(
      packed ? packed->next(count) : plain + static_cast<std::size_t>(row) * header.recordLength, row, count);
    if (row % (16 * kBlockRows) == 0)
    {
      task.progress(static_cast<double>(row + count) / static_cast<double>(rows));
    }
  }
  records.fillColors();
  records.moveTo(cloud);
  addTriple(cloud, "LasScale", header.scale);
  addTriple(cloud, "LasOffset", header.offset);
  vtkNew<vtkIntArray> encoding;
  encoding->SetName("LasGlobalEncoding");
  encoding->InsertNextValue(header.globalEncoding);
  cloud->GetFieldData()->AddArray(encoding);
  addText(cloud, "CoordinateSystem", header.coordinateSystem);
  addText(cloud, "LengthUnit", header.lengthUnit);
}

} // namespace pointhaptics::io
