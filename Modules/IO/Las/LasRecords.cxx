#include "IO/Las/LasRecords.h"

#include "Bytes/NumericType.h"
#include "ReadTask.h"

#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>

namespace pointhaptics::io
{

namespace
{

using Byte = std::uint8_t;

vtkSmartPointer<vtkUnsignedCharArray> makeZeros(const char* name, vtkIdType rows)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  auto* values = static_cast<Byte*>(std::calloc(static_cast<std::size_t>(std::max<vtkIdType>(rows, 1)), 1));
  if (!values)
  {
    throw std::bad_alloc();
  }
  array->SetArray(values, rows, 0, vtkUnsignedCharArray::VTK_DATA_ARRAY_FREE);
  array->SetName(name);
  return array;
}

} // namespace

void RareBits::fill(const LasBlock& block, std::size_t stride, const LasPlace& place)
{
  const char* const end = block.first + static_cast<std::size_t>(block.count) * stride;
  const auto bitsAt = [&](const char* record)
  { return byteAt(record, place.offset) >> place.shift & place.mask(); };
  int any = 0;
  for (const char* record = block.first; record != end; record += stride)
  {
    any |= bitsAt(record);
  }
  if (any != 0)
  {
    isSet = true;
    Byte* to = array->GetPointer(block.row);
    for (const char* record = block.first; record != end; record += stride)
    {
      *to++ = static_cast<Byte>(bitsAt(record));
    }
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
    const LasField& field = kLasFields[i];
    fields[i] = all.size();
    if (!field.isRare && field.placeIn(header.pointFormat).offset != 0)
    {
      all.push_back({ field.name, field.type, field.components });
    }
  }
  firstExtra = all.size();
  for (const LasExtraField& field : header.extraFields)
  {
    // "RGB" is the name of the colours that are shown.
    const bool isTaken = header.fields().rgb != 0 && field.name == "RGB";
    all.push_back({ isTaken ? "RGB_2" : field.name, field.arrayType(), field.components });
  }
}

LasRecords::LasRecords(const LasHeader& header, bool onlyPositions)
  : header_(header)
  , onlyPositions_(onlyPositions)
  , names_(header, onlyPositions)
  , rows_(static_cast<vtkIdType>(header.count))
  , columns_(names_.all, rows_)
{
  for (std::size_t i = 0; i < kNumberOfLasFields && !onlyPositions; ++i)
  {
    const bool isThere = kLasFields[i].isRare && kLasFields[i].placeIn(header.pointFormat).offset != 0;
    rare_[i].array = isThere ? makeZeros(kLasFields[i].name, rows_) : nullptr;
  }
  // Files that (against the standard) store 0..255 have bytes there.
  header.fields().rgb != 0 && !onlyPositions ? columns_.showColors(names_.fields[kLasColor]) : void();
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

/// target[i] = number of @p type at @p offset in record i.
void LasRecords::copyColumn(
  const LasBlock& block, std::size_t column, std::size_t offset, int type, int component) const
{
  copyStrided({ block.first + offset, static_cast<std::ptrdiff_t>(header_.recordLength), type },
    columns_.target(column, component).fromRow(block.row), block.count, !kIsLittleEndianHost);
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
  const LasPlace place = field.placeIn(header_.pointFormat);
  const std::size_t column = names_.fields[index];
  if (place.offset == 0)
  {
    return;
  }
  if (field.isRare)
  {
    rare_[index].fill(block, header_.recordLength, place);
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
    for (int i = 0; i < field.components; ++i)
    {
      copyColumn(
        block, column, place.offset + static_cast<std::size_t>(i * sizeOfType(place.type)), place.type, i);
    }
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
          const std::size_t column = names_.firstExtra + i;
          !field.hasNoData && !field.isScaled ? copyColumn(block, column, at, field.type, component)
            : field.arrayType() == VTK_FLOAT  ? fillColumn<T, float>(block, column, at, value, component)
                                              : fillColumn<T, double>(block, column, at, value, component);
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
  for (std::size_t i = 0; i < kNumberOfLasFields; ++i)
  {
    fillField(block, i);
  }
  fillExtra(block);
}

void LasRecords::moveTo(vtkPolyData* cloud, ReadTask& task)
{
  columns_.cut(task.pointsThere);
  rows_ = static_cast<vtkIdType>(std::min(task.pointsThere, static_cast<std::uint64_t>(rows_)));
  columns_.moveTo(cloud, task);
  std::array<bool, kNumberOfLasFields> areSet{};
  std::transform(
    rare_.begin(), rare_.end(), areSet.begin(), [](const RareBits& bits) { return bits.isSet.load(); });
  const std::vector<std::array<bool, kNumberOfLasFields>> ofRanks = task.ofRanks(areSet);
  for (std::size_t i = 0; i < kNumberOfLasFields; ++i)
  {
    const RareBits& bits = rare_[i];
    if (std::any_of(ofRanks.begin(), ofRanks.end(), [i](const auto& found) { return found[i]; }))
    {
      rows_ < bits.array->GetNumberOfTuples() ? void(bits.array->Resize(rows_)) : void();
      cloud->GetPointData()->AddArray(bits.array);
    }
  }
}

} // namespace pointhaptics::io
