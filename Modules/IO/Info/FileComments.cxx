#include "IO/Info/FileComments.h"

#include "IO/Bytes/TextScan.h"
#include "IO/Info/FieldText.h"
#include "IO/Info/LengthUnit.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>

namespace pointhaptics::io
{

namespace
{

/// Words before "unit" that mean places; units of other things are none of theirs.
constexpr std::string_view kOfPlaces[] = { "coordinate", "coordinates", "length", "linear", "model", "point",
  "points", "position", "positions", "xyz" };
/// Geographic systems that are in use; others among 4001 to 4999 are projected or geocentric.
constexpr std::string_view kGeographic[] = { "EPSG:4258", "EPSG:4267", "EPSG:4269", "EPSG:4277", "EPSG:4283",
  "EPSG:4326", "EPSG:4490", "EPSG:4612", "EPSG:4937", "EPSG:4979", "EPSG:6318", "EPSG:6319", "EPSG:6668",
  "EPSG:7844" };
constexpr std::string_view kUnit = "LengthUnit ";
constexpr std::string_view kHeight = "HeightUnit ";
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

/// "mm" of "units: mm" and "Coordinate Unit = mm"; empty where @p comment says no unit that is known.
std::string saidUnit(std::string_view comment)
{
  const std::size_t mark = std::min(comment.find_first_of(":="), comment.size());
  std::string_view words = mark < comment.size() ? comment.substr(0, mark) : std::string_view();
  std::string_view last;
  bool isOfPlaces = true;
  for (std::string_view word = takeWord(words); !word.empty(); word = takeWord(words))
  {
    isOfPlaces = isOfPlaces &&
      (last.empty() ||
        std::any_of(std::begin(kOfPlaces), std::end(kOfPlaces),
          [last](std::string_view known) { return equalNoCase(last, known); }));
    last = word;
  }
  std::string_view rest = mark < comment.size() ? comment.substr(mark + 1) : comment;
  last = mark < comment.size() ? last : takeWord(rest); // "units mm"
  const std::string unit(trimmed(rest));
  const bool isSaid = isOfPlaces && (equalNoCase(last, "unit") || equalNoCase(last, "units"));
  return isSaid && !lengthUnitCalled(unit).empty() ? unit : std::string();
}

/// Adds the numbers behind "EPSG:", "epsg::" or "EPSG = ", as "EPSG:26917", that @p systems lack.
void addSystems(std::string_view comment, std::vector<std::string>& systems)
{
  constexpr unsigned kMost = 99999;
  for (std::size_t at = 0; at + 5 < comment.size(); ++at)
  {
    unsigned code = 0;
    if (equalNoCase(comment.substr(at, 4), "EPSG"))
    {
      const std::size_t digits = std::min(comment.find_first_not_of(": =", at + 4), comment.size());
      std::from_chars(comment.data() + digits, comment.data() + comment.size(), code);
    }
    const std::string system = "EPSG:" + std::to_string(code);
    const bool isNew = std::find(systems.begin(), systems.end(), system) == systems.end();
    code > 0 && code <= kMost&& isNew ? systems.push_back(system) : void();
  }
}

/// True if x and y may be longitude and latitude.
bool mayBeDegrees(vtkPolyData* cloud)
{
  double bounds[6];
  cloud->GetBounds(bounds);
  return bounds[0] >= -180.0 && bounds[1] <= 360.0 && bounds[2] >= -90.0 && bounds[3] <= 90.0;
}

} // namespace

bool isUnitWord(std::string_view unit)
{
  constexpr std::size_t kLongest = 40;
  bool result = !unit.empty() && unit.size() <= kLongest && unit.front() != ' ' && unit.back() != ' ';
  for (const char c : unit)
  {
    const auto byte = static_cast<unsigned char>(c);
    result = result && (c == ' ' || c == '-' || byte >= 0x80 || std::isalnum(byte) != 0);
  }
  return result;
}

bool FileComments::add(std::string_view comment)
{
  constexpr std::size_t kMostNames = 4096;
  comment = trimmed(comment);
  for (const auto& [key, said] : { std::pair{ kUnit, &unit }, std::pair{ kHeight, &heightUnit } })
  {
    if (comment.substr(0, key.size()) == key && isUnitWord(comment.substr(key.size())))
    {
      *said = comment.substr(key.size());
      return true;
    }
  }
  if (std::string said = saidUnit(comment); !said.empty())
  {
    unit = std::move(said);
    return true;
  }
  addSystems(comment, systems);
  if (comment.substr(0, kName.size()) != kName || names.size() == kMostNames)
  {
    return false;
  }
  comment.remove_prefix(kName.size());
  const std::string inFile = vtksys::SystemTools::DecodeURL(std::string(takeWord(comment)));
  const std::string name = vtksys::SystemTools::DecodeURL(std::string(takeWord(comment)));
  const bool isName = !name.empty() && name.find('\0') == std::string::npos && trimmed(comment).empty();
  isName ? void(names.emplace_back(inFile, name)) : void();
  return isName;
}

std::string FileComments::lines(const std::string& mark) const
{
  std::string text = unit.empty() ? std::string() : mark + std::string(kUnit) + unit + "\n";
  text += heightUnit.empty() ? std::string() : mark + std::string(kHeight) + heightUnit + "\n";
  for (const auto& [inFile, name] : names)
  {
    text += mark + std::string(kName) + encoded(inFile) + " " + encoded(name) + "\n";
  }
  return text;
}

void FileComments::moveTo(vtkPolyData* cloud, std::vector<std::string>& notes) const
{
  const std::string system = systems.size() == 1 ? systems.front() : std::string();
  const bool isGeographic =
    std::find(std::begin(kGeographic), std::end(kGeographic), system) != std::end(kGeographic);
  addFieldText(cloud, "CoordinateSystem", system);
  addFieldText(cloud, "LengthUnit", unit.empty() && isGeographic && mayBeDegrees(cloud) ? "degree" : unit);
  addFieldText(cloud, kHeightUnit, heightUnit);
  if (systems.size() > 1)
  {
    notes.push_back("comments name several coordinate systems, " + systems[0] + " and " + systems[1] +
      ", of which none is taken");
  }
  vtkPointData* data = cloud->GetPointData();
  for (const auto& [inFile, name] : names)
  {
    vtkDataArray* array = data->GetArray(inFile.c_str());
    array && !data->HasArray(name.c_str()) ? array->SetName(name.c_str()) : void();
  }
}

} // namespace pointhaptics::io
