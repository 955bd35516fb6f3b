#include "IO/Las/LasRecords.h"

#include "Bytes/NumericType.h"

#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace pointhaptics::io
{

namespace
{

using Byte = std::uint8_t;

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
};

} // namespace

template <typename Bits>
void RareBits::fill(const LasBlock& block, std::size_t stride, vtkIdType rows, Bits bits)
{
  Byte* values = values_.load(std::memory_order_acquire);
  if (!values)
  {
    Byte any = 0;
    for (vtkIdType i = 0; i < block.count; ++i)
    {
      any = static_cast<Byte>(any | bits(block.first + static_cast<std::size_t>(i) * stride));
    }
    if (any == 0)
    {
      return;
    }
    values = allocate(rows);
  }
  for (vtkIdType i = 0; i < block.count; ++i)
  {
    values[block.row + i] = bits(block.first + static_cast<std::size_t>(i) * stride);
  }
}

std::uint8_t* RareBits::allocate(vtkIdType rows)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!array_)
  {
    array_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
    array_->SetName(name_);
    array_->SetNumberOfValues(rows);
    std::fill_n(array_->GetPointer(0), rows, Byte{ 0 });
    values_.store(array_->GetPointer(0), std::memory_order_release);
  }
  return array_->GetPointer(0);
}

void RareBits::moveTo(vtkPolyData* cloud) const
{
  if (array_)
  {
    cloud->GetPointData()->AddArray(array_);
  }
}

LasRecords::Columns::Columns(const LasHeader& header, bool onlyPositions)
  : all{ { "x", VTK_DOUBLE }, { "y", VTK_DOUBLE }, { "z", VTK_DOUBLE } }
{
  if (onlyPositions)
  {
    return;
  }
  for (const Column& column : { Column{ "Intensity", VTK_TYPE_UINT16 },
         Column{ "ReturnNumber", VTK_TYPE_UINT8 }, Column{ "NumberOfReturns", VTK_TYPE_UINT8 },
         Column{ "Classification", VTK_TYPE_UINT8 }, Column{ "ScanAngle", VTK_FLOAT },
         Column{ "UserData", VTK_TYPE_UINT8 }, Column{ "PointSourceId", VTK_TYPE_UINT16 } })
  {
    all.push_back(column);
  }
  const LasPointFormat& fields = header.fields();
  gpsTime = addIf(fields.gpsTime, { "GpsTime", VTK_DOUBLE });
  wideColor = addIf(fields.rgb, { "Color16", VTK_TYPE_UINT16, 3 });
  color = addIf(fields.rgb, { "RGB", VTK_TYPE_UINT8, 3 });
  nearInfrared = addIf(fields.nearInfrared, { "NearInfrared", VTK_TYPE_UINT16 });
  firstExtra = all.size();
  for (const LasExtraField& field : header.extraFields)
  {
    all.push_back({ field.name, field.arrayType(), field.components });
  }
}

std::size_t LasRecords::Columns::addIf(std::size_t offset, const Column& column)
{
  if (offset != 0)
  {
    all.push_back(column);
  }
  return all.size() - 1;
}

LasRecords::LasRecords(const LasHeader& header, bool onlyPositions)
  : header_(header)
  , onlyPositions_(onlyPositions)
  , names_(header, onlyPositions)
  , rows_(static_cast<vtkIdType>(header.count))
  , columns_(names_.all, rows_)
{
}

/// target[i] = change(number at offset in record i).
template <typename From, typename To, typename Change>
void LasRecords::fillColumn(
  const LasBlock& block, std::size_t column, std::size_t offset, Change change, int component) const
{
  const ColumnView view = columns_.target(column, component).fromRow(block.row);
  char* to = view.first;
  const char* from = block.first + offset;
  for (vtkIdType i = 0; i < block.count; ++i, from += header_.recordLength, to += view.stride)
  {
    const To value = static_cast<To>(change(loadLittle<From>(from)));
    std::memcpy(to, &value, sizeof(To));
  }
}

template <typename T>
void LasRecords::copyColumn(
  const LasBlock& block, std::size_t column, std::size_t offset, int component) const
{
  fillColumn<T, T>(
    block, column, offset, [](T value) { return value; }, component);
}

void LasRecords::fillPosition(const LasBlock& block) const
{
  const ColumnView view = columns_.target(kX).fromRow(block.row);
  const std::array<double, 3> scale = header_.scale;
  const std::array<double, 3> offset = header_.offset;
  const char* from = block.first;
  char* to = view.first;
  for (vtkIdType i = 0; i < block.count; ++i, from += header_.recordLength, to += view.stride)
  {
    const double point[3] = { loadLittle<std::int32_t>(from) * scale[0] + offset[0],
      loadLittle<std::int32_t>(from + 4) * scale[1] + offset[1],
      loadLittle<std::int32_t>(from + 8) * scale[2] + offset[2] };
    std::memcpy(to, point, sizeof(point));
  }
}

void LasRecords::fillLegacy(const LasBlock& block)
{
  fillColumn<Byte, Byte>(block, kReturnNumber, 14, [](Byte b) { return b & 0x07; });
  fillColumn<Byte, Byte>(block, kNumberOfReturns, 14, [](Byte b) { return b >> 3 & 0x07; });
  fillColumn<Byte, Byte>(block, kClassification, 15, [](Byte b) { return b & 0x1f; });
  fillColumn<std::int8_t, float>(block, kScanAngle, 16, [](std::int8_t degrees) { return degrees; });
  copyColumn<Byte>(block, kUserData, 17);
  copyColumn<std::uint16_t>(block, kPointSourceId, 18);
  fillRare(block, flags_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) >> 5); });
  fillRare(
    block, scanDirection_, [](const char* record) { return static_cast<Byte>(byteAt(record, 14) >> 6 & 1); });
  fillRare(
    block, edgeOfFlightLine_, [](const char* record) { return static_cast<Byte>(byteAt(record, 14) >> 7); });
}

void LasRecords::fillExtended(const LasBlock& block)
{
  fillColumn<Byte, Byte>(block, kReturnNumber, 14, [](Byte b) { return b & 0x0f; });
  fillColumn<Byte, Byte>(block, kNumberOfReturns, 14, [](Byte b) { return b >> 4; });
  copyColumn<Byte>(block, kClassification, 16);
  copyColumn<Byte>(block, kUserData, 17);
  fillColumn<std::int16_t, float>(
    block, kScanAngle, 18, [](std::int16_t steps) { return kScanAngleStep * static_cast<double>(steps); });
  copyColumn<std::uint16_t>(block, kPointSourceId, 20);
  fillRare(block, flags_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) & 0x0f); });
  fillRare(block, scannerChannel_,
    [](const char* record) { return static_cast<Byte>(byteAt(record, 15) >> 4 & 3); });
  fillRare(
    block, scanDirection_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) >> 6 & 1); });
  fillRare(
    block, edgeOfFlightLine_, [](const char* record) { return static_cast<Byte>(byteAt(record, 15) >> 7); });
}

void LasRecords::fillExtra(const LasBlock& block) const
{
  for (std::size_t i = 0; i < header_.extraFields.size(); ++i)
  {
    const LasExtraField& field = header_.extraFields[i];
    for (int component = 0; component < field.components; ++component)
    {
      const std::size_t at = field.offset + static_cast<std::size_t>(component * sizeOfType(field.type));
      const std::size_t third = static_cast<std::size_t>(std::min(component, 2));
      const double scale = field.scale[third];
      const double shift = field.shift[third];
      withType(field.type,
        [&](auto zero)
        {
          using T = decltype(zero);
          const auto value = [&field, third, scale, shift](T v)
          {
            return field.isNoData(v, third) ? std::numeric_limits<double>::quiet_NaN()
                                            : scale * static_cast<double>(v) + shift;
          };
          if (field.arrayType() == VTK_FLOAT && (field.hasNoData || field.isScaled))
          {
            fillColumn<T, float>(block, names_.firstExtra + i, at, value, component);
          }
          else if (field.hasNoData || field.isScaled)
          {
            fillColumn<T, double>(block, names_.firstExtra + i, at, value, component);
          }
          else
          {
            copyColumn<T>(block, names_.firstExtra + i, at, component);
          }
        });
    }
  }
}

void LasRecords::fill(const LasBlock& block)
{
  fillPosition(block);
  if (onlyPositions_)
  {
    return;
  }
  const LasPointFormat& fields = header_.fields();
  copyColumn<std::uint16_t>(block, kIntensity, 12);
  header_.isExtended() ? fillExtended(block) : fillLegacy(block);
  if (fields.gpsTime != 0)
  {
    copyColumn<double>(block, names_.gpsTime, fields.gpsTime);
  }
  for (int channel = 0; channel < 3 && fields.rgb != 0; ++channel)
  {
    copyColumn<std::uint16_t>(
      block, names_.wideColor, fields.rgb + 2 * static_cast<std::size_t>(channel), channel);
  }
  if (fields.nearInfrared != 0)
  {
    copyColumn<std::uint16_t>(block, names_.nearInfrared, fields.nearInfrared);
  }
  fillExtra(block);
}

/// Files that (against the standard) store 0..255 have none.
bool LasRecords::hasWideColors() const
{
  if (header_.fields().rgb == 0 || onlyPositions_)
  {
    return false;
  }
  const auto* from = reinterpret_cast<const std::uint16_t*>(columns_.target(names_.wideColor).first);
  return std::any_of(from, from + 3 * rows_, [](std::uint16_t v) { return v > 255; });
}

void LasRecords::agree(SharedReading& shared)
{
  struct Found
  {
    bool rare[4];
    bool wideColors;
  };
  RareBits* const rare[4] = { &flags_, &scannerChannel_, &scanDirection_, &edgeOfFlightLine_ };
  Found own{};
  std::transform(rare, rare + 4, own.rare, [](const RareBits* bits) { return bits->isHere(); });
  own.wideColors = hasWideColors();
  for (const Found& found : shared.gatherValues(own))
  {
    othersHaveWideColors_ = othersHaveWideColors_ || found.wideColors;
    for (std::size_t i = 0; i < 4; ++i)
    {
      if (found.rare[i])
      {
        rare[i]->allocate(rows_);
      }
    }
  }
}

/// 8-bit colours: the high byte, or the value itself where no value of the file needs more.
void LasRecords::fillColors()
{
  if (header_.fields().rgb == 0 || onlyPositions_)
  {
    return;
  }
  const std::uint16_t* from = reinterpret_cast<const std::uint16_t*>(columns_.target(names_.wideColor).first);
  Byte* to = reinterpret_cast<Byte*>(columns_.target(names_.color).first);
  const vtkIdType values = 3 * rows_;
  const int shift = othersHaveWideColors_ || hasWideColors() ? 8 : 0;
  std::transform(from, from + values, to, [=](std::uint16_t v) { return static_cast<Byte>(v >> shift); });
}

void LasRecords::moveTo(vtkPolyData* cloud)
{
  fillColors();
  columns_.moveTo(cloud);
  for (const RareBits* bits : { &flags_, &scannerChannel_, &scanDirection_, &edgeOfFlightLine_ })
  {
    bits->moveTo(cloud);
  }
}

} // namespace pointhaptics::io
