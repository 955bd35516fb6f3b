#include "IO/E57/E57Decoder.h"

#include "Bytes/LittleEndian.h"
#include "Bytes/NumericType.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointhaptics::io
{

namespace
{

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// Bytes that a value may be read beyond its own.
constexpr std::size_t kReadBeyond = 16;

/// Calls store(i, stored integer) for @p count integers of @p bits bits, one after the other, the least
/// significant bit first; the first begins at bit @p firstBit of @p bytes.
template <typename Store>
void unpack(const char* bytes, unsigned firstBit, unsigned bits, vtkIdType count, Store&& store)
{
  const std::uint64_t mask = bits == 64 ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << bits) - 1;
  std::uint64_t bit = firstBit;
  for (vtkIdType i = 0; i < count; ++i, bit += bits)
  {
    const char* at = bytes + bit / 8;
    const unsigned shift = static_cast<unsigned>(bit % 8);
    std::uint64_t value = loadLittle<std::uint64_t>(at) >> shift;
    if (shift + bits > 64)
    {
      value |= std::uint64_t{ static_cast<unsigned char>(at[8]) } << (64 - shift);
    }
    store(i, value & mask);
  }
}

void load(ColumnView column, vtkIdType count, double* to)
{
  copyStrided({ column.first, column.stride, column.type },
    { reinterpret_cast<char*>(to), sizeof(double), VTK_DOUBLE }, count);
}

void store(const double* from, vtkIdType count, ColumnView column)
{
  copyStrided({ reinterpret_cast<const char*>(from), sizeof(double), VTK_DOUBLE }, column, count);
}

/// value[i] = f(stored integer) in the type of the column.
template <typename F>
void fillColumn(
  ColumnView column, const char* bytes, unsigned firstBit, unsigned bits, vtkIdType count, F&& f)
{
  withType(column.type,
    [&](auto zero)
    {
      using T = decltype(zero);
      unpack(bytes, firstBit, bits, count,
        [&](vtkIdType i, std::uint64_t stored)
        {
          const T value = static_cast<T>(f(stored));
          std::memcpy(column.first + i * column.stride, &value, sizeof(T));
        });
    });
}

void fillConstant(ColumnView column, vtkIdType count, double value)
{
  copyStrided({ reinterpret_cast<const char*>(&value), 0, VTK_DOUBLE }, column, count);
}

} // namespace

struct E57Decoder::Block
{
  vtkIdType row; ///< of the scan
  vtkIdType count;
};

E57Decoder::E57Decoder(const E57Columns& plan, const CloudColumns& columns, const E57Scan& scan,
  std::size_t scanNumber, const E57Packets& packets, vtkIdType first, bool applyPose)
  : plan_(plan)
  , columns_(columns)
  , scan_(scan)
  , scanNumber_(scanNumber)
  , packets_(packets)
  , first_(first)
  , rows_(static_cast<vtkIdType>(scan.records))
  , isMoved_(applyPose && !scan.pose.isIdentity())
  , isSpherical_(plan.isSpherical(scanNumber))
  , state_(columnOf(isSpherical_ ? "sphericalInvalidState" : "cartesianInvalidState"))
  , spherical_{ columnOf("sphericalRange"), columnOf("sphericalAzimuth"), columnOf("sphericalElevation") }
  , missing_(plan.missing(scanNumber))
{
  std::fill_n(normals_, 3, E57Columns::npos);
  for (std::size_t i = 0; i < scan.fields.size(); ++i)
  {
    const std::size_t column = plan.place(scanNumber, i).column;
    const std::string name = column == E57Columns::npos ? std::string() : plan.all()[column].name;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const char normal[] = { 'n', static_cast<char>('x' + axis), '\0' };
      normals_[axis] = name == normal ? column : normals_[axis];
    }
  }
  const auto [w, x, y, z] = scan.pose.rotation;
  const double rotation[3][3] = { { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y) },
    { 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x) },
    { 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } };
  std::copy(&rotation[0][0], &rotation[0][0] + 9, &matrix_[0][0]);
  const char* const channels[3] = { "colorRed", "colorGreen", "colorBlue" };
  for (std::size_t i = 0; i < 3 && hasE57Colors(scan); ++i)
  {
    const E57Field& field = scan.fields[scan.find(channels[i])];
    colorIsInteger_ = field.kind == E57Field::Kind::Integer;
    const E57Limits own{ colorIsInteger_ ? static_cast<double>(field.minimum) : 0.0,
      colorIsInteger_ ? static_cast<double>(field.maximum) : 1.0 };
    const E57Limits limits = scan.colorLimits[i].value_or(own);
    // 256 steps of equal width for integers, so that 65535 is 255 and the byte is the value's first.
    const double range = limits.most - limits.least + (colorIsInteger_ ? 1.0 : 0.0);
    colorLeast_[i] = limits.least;
    colorFactor_[i] = range > 0.0 ? (colorIsInteger_ ? 256.0 : 255.0) / range : 0.0;
  }
}

std::size_t E57Decoder::columnOf(const char* fieldName) const
{
  const std::size_t field = scan_.find(fieldName);
  return field == E57Scan::npos ? E57Columns::npos : plan_.place(scanNumber_, field).column;
}

ColumnView E57Decoder::target(std::size_t column, int component, const Block& block) const
{
  return columns_.target(column, component).fromRow(first_ + block.row);
}

void E57Decoder::decode(vtkIdType number) const
{
  const vtkIdType row = number * kBlockRows;
  const Block block{ row, std::min(kBlockRows, rows_ - row) };
  for (std::size_t i = 0; i < scan_.fields.size(); ++i)
  {
    if (plan_.place(scanNumber_, i).column != E57Columns::npos)
    {
      decodeField(i, block);
    }
  }
  fillMissing(block);
  if (isMoved_ || isSpherical_ || state_ != E57Columns::npos)
  {
    placePoints(block);
  }
  if (isMoved_ && std::count(normals_, normals_ + 3, E57Columns::npos) == 0)
  {
    turnNormals(block);
  }
  if (plan_.madeColor() != E57Columns::npos)
  {
    makeColors(block);
  }
}

void E57Decoder::decodeField(std::size_t index, const Block& block) const
{
  const E57Field& field = scan_.fields[index];
  const E57Columns::Place& place = plan_.place(scanNumber_, index);
  const ColumnView column = target(place.column, place.component, block);
  const std::uint64_t firstBit = static_cast<std::uint64_t>(block.row) * field.bits;
  const unsigned inByte = static_cast<unsigned>(firstBit % 8);
  const std::size_t size = (inByte + static_cast<std::size_t>(block.count) * field.bits + 7) / 8;
  char bytes[kBlockRows * 8 + kReadBeyond];
  packets_.gather(index, firstBit / 8, size, bytes);
  std::fill_n(bytes + size, kReadBeyond - 1, '\0');
  const std::uint64_t least =
    static_cast<std::uint64_t>(field.minimum) + static_cast<std::uint64_t>(place.added);
  switch (field.kind)
  {
    case E57Field::Kind::Integer:
      fillColumn(column, bytes, inByte, field.bits, block.count,
        [=](std::uint64_t stored) { return static_cast<std::int64_t>(stored + least); });
      break;
    case E57Field::Kind::Scaled:
      fillColumn(column, bytes, inByte, field.bits, block.count,
        [=, &field](std::uint64_t stored) {
          return static_cast<double>(static_cast<std::int64_t>(stored + least)) * field.scale + field.offset;
        });
      break;
    default: // Text is not read.
      copyStrided({ bytes, field.bits / 8, typeOfKind('f', field.bits / 8) }, column, block.count,
        !kIsLittleEndianHost);
  }
}

void E57Decoder::fillMissing(const Block& block) const
{
  for (const std::size_t column : missing_)
  {
    const Column& missing = plan_.all()[column];
    for (int component = 0; component < missing.components; ++component)
    {
      fillConstant(target(column, component, block), block.count, isFloatingType(missing.type) ? kNaN : 0.0);
    }
  }
  if (plan_.scanIndex() != E57Columns::npos)
  {
    fillConstant(target(plan_.scanIndex(), 0, block), block.count, static_cast<double>(scan_.number));
  }
}

/// Turns @p vectors as the scanner stood, and moves them.
void E57Decoder::turn(const std::array<double, 3>& shift, vtkIdType count, Values* vectors) const
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double x = vectors[0][i], y = vectors[1][i], z = vectors[2][i];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double* row = matrix_[axis];
      vectors[axis][i] = row[0] * x + row[1] * y + row[2] * z + shift[axis];
    }
  }
}

void E57Decoder::placePoints(const Block& block) const
{
  Values p[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    load(target(isSpherical_ ? spherical_[axis] : axis, 0, block), block.count, p[axis]);
  }
  for (vtkIdType i = 0; i < block.count && isSpherical_; ++i)
  {
    const double range = p[0][i], azimuth = p[1][i], elevation = p[2][i];
    p[0][i] = range * std::cos(elevation) * std::cos(azimuth);
    p[1][i] = range * std::cos(elevation) * std::sin(azimuth);
    p[2][i] = range * std::sin(elevation);
  }
  isMoved_ ? turn(scan_.pose.translation, block.count, p) : void();
  if (state_ != E57Columns::npos)
  {
    Values state;
    load(target(state_, 0, block), block.count, state);
    for (vtkIdType i = 0; i < block.count; ++i)
    {
      if (state[i] != 0.0)
      {
        p[0][i] = p[1][i] = p[2][i] = kNaN;
      }
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    store(p[axis], block.count, target(axis, 0, block));
  }
}

void E57Decoder::turnNormals(const Block& block) const
{
  Values n[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    load(target(normals_[axis], 0, block), block.count, n[axis]);
  }
  turn({}, block.count, n);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    store(n[axis], block.count, target(normals_[axis], 0, block));
  }
}

void E57Decoder::makeColors(const Block& block) const
{
  for (int channel = 0; channel < 3; ++channel)
  {
    Values color;
    std::fill_n(color, block.count, 0.0);
    if (hasE57Colors(scan_))
    {
      load(target(plan_.storedColor(), channel, block), block.count, color);
      const double rounding = colorIsInteger_ ? 0.0 : 0.5;
      for (vtkIdType i = 0; i < block.count; ++i)
      {
        const double scaled = (color[i] - colorLeast_[channel]) * colorFactor_[channel] + rounding;
        color[i] = scaled > 0.0 ? std::min(std::floor(scaled), 255.0) : 0.0; // NaN is black
      }
    }
    store(color, block.count, target(plan_.madeColor(), channel, block));
  }
}

} // namespace pointhaptics::io
