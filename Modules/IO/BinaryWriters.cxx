#include "IO/WriteTask.h"

#include "Bytes/NumericType.h"
#include "Core/Base/FieldNames.h"
#include "IO/Pcd/PcdHeader.h"
#include "IO/Ply/PlyHeader.h"

#include "vtkFieldData.h"
#include "vtkVariant.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace pointhaptics::io
{

namespace
{

std::string plyPropertyName(const OutputArray& array, int component)
{
  /// In the order of ArrayRole.
  static const char* const kNames[][4] = { { "x", "y", "z" }, { "red", "green", "blue", "alpha" },
    { "nx", "ny", "nz" } };
  return array.role == ArrayRole::Other ? array.componentName(component)
                                        : kNames[static_cast<std::size_t>(array.role)][component];
}

/// Points are float or double in every format.
int writtenType(const OutputArray& array)
{
  const bool isPoints = array.role == ArrayRole::Points;
  return isPoints && !isFloatingType(array.type()) ? VTK_DOUBLE : array.type();
}

/// The four header lines that describe the fields.
std::string pcdFieldLines(const std::vector<PcdField>& fields)
{
  std::string names = "FIELDS";
  std::string sizes = "\nSIZE";
  std::string types = "\nTYPE";
  std::string counts = "\nCOUNT";
  for (const PcdField& field : fields)
  {
    const bool isFloat =
      isFloatingType(field.type) || (field.isPackedColor() && field.name == "rgb"); // as PCL
    const int size = sizeOfType(field.type);
    const bool isUnsigned =
      fixedSizeType(field.type) == typeOfKind('u', static_cast<unsigned long long>(size));
    names += " " + field.name;
    sizes += " " + std::to_string(size);
    types += isFloat ? " F" : isUnsigned ? " U" : " I";
    counts += " " + std::to_string(field.count);
  }
  return names + sizes + types + counts + "\n";
}

std::string pcdShape(vtkFieldData* fieldData, vtkIdType rows)
{
  const auto numbers = [&](const char* name, std::vector<double> usual)
  {
    vtkDataArray* stored = fieldData->GetArray(name);
    const bool isThere = stored && stored->GetNumberOfValues() == static_cast<vtkIdType>(usual.size());
    for (std::size_t i = 0; isThere && i < usual.size(); ++i)
    {
      usual[i] = stored->GetVariantValue(static_cast<vtkIdType>(i)).ToDouble();
    }
    return usual;
  };
  const std::vector<double> size = numbers("OrganizedDimensions", { static_cast<double>(rows), 1.0 });
  // A filter may have dropped points since the cloud was read: then it is a plain list.
  const bool isGrid = size[0] >= 1.0 && size[1] >= 1.0 && size[0] * size[1] == static_cast<double>(rows);
  std::vector<std::string> viewpoint;
  for (const double value : numbers("Viewpoint", { 0, 0, 0, 1, 0, 0, 0 }))
  {
    viewpoint.push_back(shortestDecimal(value));
  }
  return fmt::format("WIDTH {}\nHEIGHT {}\nVIEWPOINT {}\nPOINTS {}\nDATA binary\n",
    isGrid ? static_cast<vtkIdType>(size[0]) : rows, isGrid ? static_cast<vtkIdType>(size[1]) : 1,
    fmt::join(viewpoint, " "), rows);
}

/// Colours packed as 0xAARRGGBB; alpha is 0 for three channels, as PCL writes rgb.
std::vector<std::uint32_t> packColors(const OutputArray& colors)
{
  const int channels = colors.components();
  const std::uint8_t* from = static_cast<const std::uint8_t*>(colors.array->GetVoidPointer(0));
  std::vector<std::uint32_t> packed(static_cast<std::size_t>(colors.array->GetNumberOfTuples()));
  for (std::uint32_t& color : packed)
  {
    const std::uint32_t alpha = channels == 4 ? from[3] : 0;
    color =
      alpha << 24 | std::uint32_t{ from[0] } << 16 | std::uint32_t{ from[1] } << 8 | std::uint32_t{ from[2] };
    from += channels;
  }
  return packed;
}

} // namespace

std::string shortestDecimal(double value)
{
  char text[32];
  return { text, std::to_chars(text, text + sizeof(text), value).ptr };
}

std::size_t addRecordFields(
  std::vector<RecordField>& fields, std::size_t offset, const OutputArray& array, int type)
{
  for (int component = 0; component < array.components(); ++component)
  {
    fields.push_back({ array.column(component), offset, type });
    offset += static_cast<std::size_t>(sizeOfType(type));
  }
  return offset;
}

void packRecords(const std::vector<RecordField>& fields, std::size_t recordSize, vtkIdType row,
  vtkIdType count, char* records) noexcept
{
  for (const RecordField& field : fields)
  {
    const ConstColumnView source{ field.source.first + row * field.source.stride, field.source.stride,
      field.source.type };
    copyStrided(
      source, { records + field.offset, static_cast<std::ptrdiff_t>(recordSize), field.type }, count);
  }
}

void writeRecords(const std::vector<RecordField>& fields, std::size_t recordSize, vtkIdType rows,
  WriteTask& task, double begin)
{
  constexpr vtkIdType kBlock = 8192;
  static_assert(kProgressRows % kBlock == 0, "a report falls on the start of a block");
  std::vector<char> block(recordSize * static_cast<std::size_t>(std::min(kBlock, rows)));
  for (vtkIdType row = 0; row < rows; row += kBlock)
  {
    if (row % kProgressRows == 0)
    {
      task.progress(begin + (1.0 - begin) * static_cast<double>(row) / static_cast<double>(rows));
    }
    const vtkIdType count = std::min(kBlock, rows - row);
    packRecords(fields, recordSize, row, count, block.data());
    task.out.write(block.data(), recordSize * static_cast<std::size_t>(count));
  }
  task.progress(1.0);
}

void writePly(WriteTask& task)
{
  std::vector<OutputArray> arrays = withoutLongIntegers(outputArrays(task.cloud, task.notes), task.notes);
  const auto columnsOf = [](const OutputArray& array)
  {
    std::vector<Column> columns = columnsByComponent(array);
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      columns[i] = { plyPropertyName(array, static_cast<int>(i)), writtenType(array) };
    }
    return columns;
  };
  chooseNames(arrays, columnsOf, { NameRule::Words, std::string::npos, &task.comments }, task.notes);
  const vtkIdType rows = arrays[0].array->GetNumberOfTuples();
  std::string header = "ply\nformat ";
  header += kIsLittleEndianHost ? "binary_little_endian" : "binary_big_endian";
  header += " 1.0\ncomment written by PointHaptics\n" + task.comments.lines("comment ");
  header += "element vertex " + std::to_string(rows) + "\n";
  std::vector<RecordField> fields;
  std::size_t recordSize = 0;
  for (const OutputArray& array : arrays)
  {
    for (const Column& column : columnsOf(array))
    {
      header += std::string("property ") + plyTypeName(column.type) + " " + column.name + "\n";
    }
    recordSize = addRecordFields(fields, recordSize, array, writtenType(array));
  }
  task.out.write(header + "end_header\n");
  writeRecords(fields, recordSize, rows, task);
}

/// Name and type of an array in a PCD file: PCL's point types read coordinates, normals, intensity
/// and curvature as floats, and label as an unsigned integer.
struct PcdArray
{
  std::string name;
  int type = VTK_FLOAT;

  PcdArray(const OutputArray& array, const WriteTask& task)
    : name(array.name)
    , type(writtenType(array))
  {
    const bool isScalar = array.role == ArrayRole::Other && array.components() == 1 && !task.keepsDoubles;
    const bool isFloat = isScalar && (isSameField(name, "Intensity") || isSameField(name, "Curvature"));
    if (isFloat || isLabel(array, isScalar))
    {
      name = isSameField(name, "Intensity") ? "intensity" : isFloat ? "curvature" : "label";
      type = isFloat ? VTK_FLOAT : VTK_TYPE_UINT32;
    }
    if (array.role == ArrayRole::Points || array.role == ArrayRole::Normals)
    {
      type = task.keepsDoubles ? type : VTK_FLOAT;
    }
  }
  std::vector<PcdField> fields(const OutputArray& array) const
  {
    if (array.role == ArrayRole::Colors)
    {
      return { { array.components() == 4 ? "rgba" : "rgb", VTK_TYPE_UINT32 } };
    }
    if (array.role == ArrayRole::Other)
    {
      return { { name, type, array.components() } };
    }
    const std::string prefix = array.role == ArrayRole::Normals ? "normal_" : "";
    return { { prefix + "x", type }, { prefix + "y", type }, { prefix + "z", type } };
  }
  bool isLabel(const OutputArray& array, bool isScalar) const
  {
    double range[2] = { -1.0, -1.0 };
    if (isScalar && isSameField(name, "Label") && !isFloatingType(type))
    {
      array.array->GetRange(range, 0);
    }
    return range[0] >= 0.0 && range[1] <= 4294967295.0;
  }
};

/// The largest difference of a value of @p array from what is stored as a float; NaN and infinity aside.
double floatError(const OutputArray& array)
{
  double worst = 0.0;
  withType(array.type(),
    [&](auto zero)
    {
      using T = decltype(zero);
      constexpr bool isLong = std::is_integral_v<T> && sizeof(T) == 8; // more than a double holds
      using Wide = std::conditional_t<isLong, long double, double>;
      const T* values = static_cast<const T*>(array.array->GetVoidPointer(0));
      for (vtkIdType i = 0; i < array.array->GetNumberOfValues(); ++i)
      {
        const Wide error =
          std::abs(static_cast<Wide>(static_cast<float>(values[i])) - static_cast<Wide>(values[i]));
        worst = error > static_cast<Wide>(worst) ? static_cast<double>(error) : worst;
      }
    });
  return worst;
}

/// Errors below this part of a cloud's length, or of a normal's, cannot be seen.
constexpr double kFeltPart = 1e-6;

void notePcdArray(const OutputArray& array, const PcdArray& written, WriteTask& task)
{
  const bool mayRound = written.type == VTK_FLOAT && fixedSizeType(array.type()) != VTK_FLOAT;
  const double error = mayRound ? floatError(array) : 0.0;
  const double unseen = array.role == ArrayRole::Points ? kFeltPart * task.cloud->GetLength()
    : array.role == ArrayRole::Normals                  ? kFeltPart
                                                        : 0.0;
  const bool isLost = error > 0.0 && !(error <= unseen); // NaN: nobody knows
  if (isLost && array.role == ArrayRole::Points)
  {
    task.notes.push_back(
      fmt::format("coordinates are rounded to floats, by at most {:.3g}, as PCL's point types read no "
                  "others; --double keeps every digit, --translate of resample takes a large offset away",
        error));
  }
  else if (isLost)
  {
    task.notes.push_back(fmt::format("array {} is rounded to floats, by at most {:.3g}", array.name, error));
  }
}

void writePcd(WriteTask& task)
{
  std::vector<OutputArray> arrays = outputArrays(task.cloud, task.notes);
  const auto columnsOf = [&](const OutputArray& array)
  {
    std::vector<Column> columns;
    for (const PcdField& field : PcdArray(array, task).fields(array))
    {
      field.isPadding() ? void() : columns.push_back(field.column());
    }
    return columns;
  };
  chooseNames(arrays, columnsOf, { NameRule::Words, std::string::npos, &task.comments }, task.notes);
  const vtkIdType rows = arrays[0].array->GetNumberOfTuples();
  std::vector<PcdField> described;
  std::vector<RecordField> fields;
  std::vector<std::uint32_t> packed;
  std::size_t recordSize = 0;
  for (const OutputArray& array : arrays)
  {
    const PcdArray written(array, task);
    const std::vector<PcdField> own = written.fields(array);
    described.insert(described.end(), own.begin(), own.end());
    if (array.role == ArrayRole::Colors)
    {
      packed = packColors(array);
      fields.push_back({ { reinterpret_cast<const char*>(packed.data()), 4, VTK_TYPE_UINT32 }, recordSize,
        VTK_TYPE_UINT32 });
      recordSize += 4;
      continue;
    }
    notePcdArray(array, written, task);
    recordSize = addRecordFields(fields, recordSize, array, written.type);
  }
  task.out.write("# .PCD v0.7 - Point Cloud Data file format\n" + task.comments.lines("# ") +
    "VERSION 0.7\n" + pcdFieldLines(described) + pcdShape(task.fieldData(), rows));
  writeRecords(fields, recordSize, rows, task);
}

} // namespace pointhaptics::io
