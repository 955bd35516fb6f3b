#include "IO/Vtk/VtkLegacyCursor.h"

#include "Bytes/NumericType.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Text/TextScan.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

bool isSpace(char c)
{
  return isBlank(c) || c == '\n';
}

} // namespace

std::string_view VtkLegacyCursor::line()
{
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  const std::string_view text = bytes_.substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  return trimmed(text);
}

std::string_view VtkLegacyCursor::word()
{
  while (at_ < bytes_.size() && isSpace(bytes_[at_]))
  {
    ++at_;
  }
  const std::size_t begin = at_;
  while (at_ < bytes_.size() && !isSpace(bytes_[at_]))
  {
    ++at_;
  }
  return bytes_.substr(begin, at_ - begin);
}

std::string_view VtkLegacyCursor::peek()
{
  const std::size_t before = at_;
  const std::string_view next = word();
  at_ = before;
  return next;
}

VtkLegacyCursor::Count VtkLegacyCursor::count(const char* what)
{
  const std::string_view text = word();
  Count value = 0;
  if (!parseCount(text, value))
  {
    failFormat(where() + inQuotes(text) + " stands where " + what + " was expected",
      "the file is damaged: write it again, or save it as .vtp with ParaView");
  }
  return value;
}

int VtkLegacyCursor::type(std::string_view name) const
{
  struct Known
  {
    std::string_view name;
    int type;
  };
  constexpr Known kTypes[] = { { "float", VTK_FLOAT }, { "double", VTK_DOUBLE },
    { "unsigned_char", VTK_TYPE_UINT8 }, { "char", VTK_TYPE_INT8 }, { "signed_char", VTK_TYPE_INT8 },
    { "unsigned_short", VTK_TYPE_UINT16 }, { "short", VTK_TYPE_INT16 }, { "unsigned_int", VTK_TYPE_UINT32 },
    { "int", VTK_TYPE_INT32 }, { "vtkIdType", VTK_TYPE_INT32 }, { "unsigned_long", VTK_TYPE_UINT64 },
    { "long", VTK_TYPE_INT64 }, { "vtktypeuint64", VTK_TYPE_UINT64 }, { "vtktypeint64", VTK_TYPE_INT64 } };
  for (const Known& known : kTypes)
  {
    if (equalNoCase(known.name, name))
    {
      return known.type;
    }
  }
  failFormat(where() + "values of the type " + inQuotes(name) + " are not read here",
    "save the file as .vtp, for example with ParaView");
}

void VtkLegacyCursor::checkSize(int vtkType, Count count)
{
  const Count available = bytes_.size() - at_;
  const Count least = isBinary_ ? static_cast<Count>(sizeOfType(vtkType)) : 2;
  if (count > (available + 1) / least)
  {
    failTruncated(where() + std::to_string(count) + " values announced, but only " +
      std::to_string(available) + " bytes follow");
  }
  if (isBinary_ && count * least > available)
  {
    failTruncated(where() + "the file ends inside " + std::to_string(count) + " values");
  }
}

double VtkLegacyCursor::number()
{
  const std::string_view text = word();
  double value = 0.0;
  if (text.empty())
  {
    failTruncated(where() + "the file ends where a number was expected");
  }
  if (!parseNumber(text, value))
  {
    failFormat(where() + inQuotes(text) + " is not a number", "write the file again with another program");
  }
  return value;
}

void VtkLegacyCursor::readText(vtkDataArray* array, Count count)
{
  const int type = array->GetDataType();
  const ColumnView target{ static_cast<char*>(array->GetVoidPointer(0)), array->GetDataTypeSize(), type };
  for (Count i = 0; i < count; ++i)
  {
    if (!storeNumber(target, static_cast<vtkIdType>(i), number()))
    {
      failFormat(
        where() + "a number that its integer type cannot hold", "write the array as float or double");
    }
    if (i % static_cast<Count>(kProgressRows) == 0)
    {
      task_.progress(static_cast<double>(at_) / static_cast<double>(bytes_.size()));
    }
  }
}

vtkSmartPointer<vtkDataArray> VtkLegacyCursor::values(
  const std::string& name, int vtkType, Count tuples, Count components)
{
  if (components < 1 || components > kMostColumns)
  {
    failFormat(where() + "an array of " + std::to_string(components) + " components",
      "write the file again with another program");
  }
  if (tuples > bytes_.size())
  {
    failTruncated(where() + std::to_string(tuples) + " tuples announced in a file of " +
      std::to_string(bytes_.size()) + " bytes");
  }
  const Count count = tuples * components;
  if (isBinary_)
  {
    line(); // the rest of the line of words; the values start on the next
  }
  checkSize(vtkType, count);
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(vtkDataArray::CreateDataArray(vtkType));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(components));
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  if (!isBinary_)
  {
    readText(array, count);
    return array;
  }
  const std::ptrdiff_t size = sizeOfType(vtkType);
  copyStrided({ bytes_.data() + at_, size, vtkType },
    { static_cast<char*>(array->GetVoidPointer(0)), size, vtkType }, static_cast<vtkIdType>(count),
    kIsLittleEndianHost);
  at_ += static_cast<std::size_t>(count) * static_cast<std::size_t>(size);
  task_.progress(static_cast<double>(at_) / static_cast<double>(bytes_.size()));
  return array;
}

void VtkLegacyCursor::skipValues(int vtkType, Count count)
{
  if (isBinary_)
  {
    line();
  }
  checkSize(vtkType, count);
  if (isBinary_)
  {
    at_ += static_cast<std::size_t>(count) * static_cast<std::size_t>(sizeOfType(vtkType));
  }
  for (Count i = 0; i < count && !isBinary_; ++i)
  {
    number();
  }
}

} // namespace pointhaptics::io
