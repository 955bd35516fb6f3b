#include "IO/Info/FileComments.h"

#include "IO/Info/FieldText.h"
#include "IO/Text/TextScan.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <cctype>
#include <charconv>

namespace pointhaptics::io
{

namespace
{

constexpr std::string_view kUnit = "LengthUnit ";
constexpr std::string_view kName = "ArrayName ";

/// One word in one line: blanks and control characters as %20.
std::string encoded(const std::string& name)
{
  constexpr char kDigits[] = "0123456789abcdef";
  std::string word;
  for (const char c : name)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool isPlain = byte > ' ' && byte != 0x7f && c != '%';
    word += isPlain ? std::string(1, c) : std::string{ '%', kDigits[byte >> 4], kDigits[byte & 15] };
  }
  return word;
}

std::string decoded(std::string_view word)
{
  std::string name;
  for (std::size_t i = 0; i < word.size(); ++i)
  {
    unsigned char byte = 0;
    const std::string_view code = word[i] == '%' ? word.substr(i + 1, 2) : std::string_view();
    const bool isCode = code.size() == 2 &&
      std::from_chars(code.data(), code.data() + 2, byte, 16).ptr == code.data() + 2 && byte != 0;
    name += isCode ? static_cast<char>(byte) : word[i];
    i += isCode ? 2 : 0;
  }
  return name;
}

} // namespace

bool isUnitWord(std::string_view unit)
{
  constexpr std::size_t kLongest = 40;
  bool result = !unit.empty() && unit.size() <= kLongest && unit.front() != ' ' && unit.back() != ' ';
  for (const char c : unit)
  {
    const auto byte = static_cast<unsigned char>(c);
    result = result && (c == ' ' || byte >= 0x80 || std::isalnum(byte) != 0);
  }
  return result;
}

bool FileComments::add(std::string_view comment)
{
  constexpr std::size_t kMostNames = 4096;
  comment = trimmed(comment);
  if (comment.substr(0, kUnit.size()) == kUnit && isUnitWord(comment.substr(kUnit.size())))
  {
    unit = comment.substr(kUnit.size());
    return true;
  }
  if (comment.substr(0, kName.size()) != kName || names.size() == kMostNames)
  {
    return false;
  }
  comment.remove_prefix(kName.size());
  const std::string inFile = decoded(takeWord(comment));
  const std::string name = decoded(takeWord(comment));
  const bool isName = !name.empty() && trimmed(comment).empty();
  isName ? void(names.emplace_back(inFile, name)) : void();
  return isName;
}

std::string FileComments::lines(const std::string& mark) const
{
  std::string text = unit.empty() ? std::string() : mark + std::string(kUnit) + unit + "\n";
  for (const auto& [inFile, name] : names)
  {
    text += mark + std::string(kName) + encoded(inFile) + " " + encoded(name) + "\n";
  }
  return text;
}

void FileComments::moveTo(vtkPolyData* cloud) const
{
  addFieldText(cloud, "LengthUnit", unit);
  vtkPointData* data = cloud->GetPointData();
  for (const auto& [inFile, name] : names)
  {
    vtkDataArray* array = data->GetArray(inFile.c_str());
    array && !data->HasArray(name.c_str()) ? array->SetName(name.c_str()) : void();
  }
}

} // namespace pointhaptics::io
