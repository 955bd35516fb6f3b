#include "Bytes/ShownColors.h"

#include "Bytes/NumericType.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <type_traits>

namespace pointhaptics::io
{

namespace
{

struct ValueRange
{
  double least = 0.0;
  double most = 0.0;
};

template <typename T>
ValueRange rangeOf(const T* values, vtkIdType count)
{
  ValueRange range;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double value = static_cast<double>(values[i]);
    range.least = value < range.least ? value : range.least; // false for NaN
    range.most = value > range.most ? value : range.most;
  }
  return range;
}

template <typename T>
void fillBytes(const T* values, vtkIdType count, double most, unsigned char* bytes)
{
  constexpr bool isInteger = std::is_integral_v<T>;
  const double factor = isInteger ? (most > 255.0 ? 1.0 / 256.0 : 1.0)
                                  : (most > 255.0 ? 1.0 / 257.0 : (most > 1.0 ? 1.0 : 255.0));
  const double rounding = isInteger ? 0.0 : 0.5;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double value = factor * static_cast<double>(values[i]) + rounding;
    bytes[i] =
      value >= 0.0 ? static_cast<unsigned char>(std::min(value, 255.0)) : static_cast<unsigned char>(0);
  }
}

} // namespace

vtkSmartPointer<vtkDataArray> shownColors(vtkDataArray* colors, SharedReading* shared)
{
  const vtkIdType count = colors->GetNumberOfValues();
  ValueRange range;
  withType(colors->GetDataType(),
    [&](auto zero)
    { range = rangeOf(static_cast<const decltype(zero)*>(colors->GetVoidPointer(0)), count); });
  if (shared)
  {
    for (const ValueRange& each : shared->gatherValues(range))
    {
      range = { std::min(range.least, each.least), std::max(range.most, each.most) };
    }
  }
  if (range.least < 0.0 || range.most > 65535.0)
  {
    return nullptr;
  }
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->SetName("RGB");
  bytes->SetNumberOfComponents(colors->GetNumberOfComponents());
  bytes->SetNumberOfTuples(colors->GetNumberOfTuples());
  withType(colors->GetDataType(),
    [&](auto zero)
    {
      fillBytes(static_cast<const decltype(zero)*>(colors->GetVoidPointer(0)), count, range.most,
        bytes->GetPointer(0));
    });
  return bytes;
}

} // namespace pointhaptics::io
