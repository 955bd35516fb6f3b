#include "IO/Las/LasRecords.h"

#include "Bytes/NumericType.h"
#include "ReadTask.h"

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

/// The bits of @p place in a record.
Byte bitsAt(const char* record, const LasPlace& place)
{
  return static_cast<Byte>(byteAt(record, place.offset) >> place.shift & place.mask());
}

} // namespace

void RareBits::fill(
  const LasBlock& block, std::size_t stride, vtkIdType rows, const LasField& field, const LasPlace& place)
{
  Byte* values = values_.load(std::memory_order_acquire);
  const char* end = block.first + static_cast<std::size_t>(block.count) * stride;
  const Byte bits = static_cast<Byte>(place.mask() << place.shift);
  Byte any = values ? bits : Byte{ 0 };
  for (const char* record = block.first; record != end && !values; record += stride)
  {
    any = static_cast<Byte>(any | byteAt(record, place.offset));
  }
  if ((any & bits) == 0)
  {
    return;
  }
  Byte* to = (values ? values : allocate(rows, field)) + block.row;
  for (const char* record = block.first; record != end; record += stride)
  {
    *to++ = bitsAt(record, place);
  }
}

std::uint8_t* RareBits::allocate(vtkIdType rows, const LasField& field)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!array_)
  {
    array_ = vtkSmartPointer<vtkUnsignedCharArray>::New();
    array_->SetName(field.name);
    array_->SetNumberOfValues(rows);
    std::fill_n(array_->GetPointer(0), rows, Byte{ 0 });
    values_.store(array_->GetPointer(0), std::memory_order_release);
  }
  return array_->GetPointer(0);
}

void RareBits::moveTo(vtkPolyData* cloud, vtkIdType rows) const
{
  if (array_)
  {
    rows < array_->GetNumberOfTuples() ? void(array_->Resize(rows)) : void();
    cloud->GetPointData()->AddArray(array_);
  }
}

LasRecords::Columns::Columns(const LasHeader& header, bool onlyPositions)
{
  if (onlyPositions)
  {
    return;
  }
  for (std::size_t i = 0; i < kNumberOfLasFields; ++i)
  {
    fields[i] = addIf(!kLasFields[i].isRare, { kLasFields[i].name, kLasFields[i].type });
  }
  const LasPointFormat& format = header.fields();
  gpsTime = addIf(format.gpsTime != 0, { "GpsTime", VTK_DOUBLE });
  wideColor = addIf(format.rgb != 0, { "Color16", VTK_TYPE_UINT16, 3 });
  color = addIf(format.rgb != 0, { "RGB", VTK_TYPE_UINT8, 3 });
  nearInfrared = addIf(format.nearInfrared != 0, { "NearInfrared", VTK_TYPE_UINT16 });
  firstExtra = all.size();
  for (const LasExtraField& field : header.extraFields)
  {
    all.push_back({ field.name, field.arrayType(), field.components });
  }
}

std::size_t LasRecords::Columns::addIf(bool isThere, const Column& column)
{
  isThere ? all.push_back(column) : void();
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
  const ColumnView view = columns_.target(0).fromRow(block.row);
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

void LasRecords::fillField(const LasBlock& block, std::size_t index)
{
  const LasField& field = kLasFields[index];
  const LasPlace& place = header_.isExtended() ? field.extended : field.basic;
  const std::size_t column = names_.fields[index];
  if (place.offset == 0)
  {
    return;
  }
  if (field.isRare)
  {
    rare_[index].fill(block, header_.recordLength, rows_, field, place);
  }
  else if (place.bits > 0)
  {
    fillColumn<Byte, Byte>(block, column, place.offset,
      [shift = place.shift, mask = place.mask()](Byte byte) { return byte >> shift & mask; });
  }
  else if (field.type == VTK_FLOAT)
  {
    const double step = header_.isExtended() ? kLasScanAngleStep : 1.0;
    withType(place.type,
      [&](auto zero)
      {
        using T = decltype(zero);
        fillColumn<T, float>(
          block, column, place.offset, [step](T steps) { return step * static_cast<double>(steps); });
      });
  }
  else
  {
    withType(place.type, [&](auto zero) { copyColumn<decltype(zero)>(block, column, place.offset); });
  }
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
  for (std::size_t i = 0; i < kNumberOfLasFields; ++i)
  {
    fillField(block, i);
  }
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
    bool rare[kNumberOfLasFields];
    bool wideColors;
  };
  Found own{};
  std::transform(rare_.begin(), rare_.end(), own.rare, [](const RareBits& bits) { return bits.isHere(); });
  own.wideColors = hasWideColors();
  for (const Found& found : shared.gatherValues(own))
  {
    othersHaveWideColors_ = othersHaveWideColors_ || found.wideColors;
    for (std::size_t i = 0; i < kNumberOfLasFields; ++i)
    {
      found.rare[i] ? void(rare_[i].allocate(rows_, kLasFields[i])) : void();
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

void LasRecords::moveTo(vtkPolyData* cloud, const ReadTask& task)
{
  columns_.cut(task.pointsThere);
  rows_ = static_cast<vtkIdType>(std::min(task.pointsThere, static_cast<std::uint64_t>(rows_)));
  fillColors();
  columns_.moveTo(cloud, task);
  for (const RareBits& bits : rare_)
  {
    bits.moveTo(cloud, rows_);
  }
}

} // namespace pointhaptics::io
