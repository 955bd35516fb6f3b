#include "IO/E57/E57Scan.h"

#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Bytes/XmlTree.h"
#include "IO/Columns/CloudColumns.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

namespace pointhaptics::io
{

namespace
{

/// Numbers of one scan, with its name in the message of what is none.
struct Numbers
{
  std::string where;

  /// An empty text is @p otherwise: E57 leaves out zeros, and attributes with their default.
  std::int64_t integer(std::string_view text, const std::string& what, std::int64_t otherwise) const
  {
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, otherwise);
    failIf(!text.empty() && (end != last || error != std::errc()), what, text, "is no integer of 64 bits");
    return otherwise;
  }
  double real(std::string_view text, const std::string& what, double otherwise) const
  {
    const bool isNumber = text.empty() || (parseNumber(text, otherwise) && std::isfinite(otherwise));
    failIf(!isNumber, what, text, "is no finite number");
    return otherwise;
  }
  std::uint64_t count(std::string_view text, const std::string& what) const
  {
    unsigned long long value = 0;
    failIf(!parseCount(text, value), what, text, "is no count");
    return value;
  }
  void failIf(bool isWrong, const std::string& what, std::string_view text, const char* fault) const
  {
    failFormatIf(isWrong, kRewriteCure, "{}: {} {} {}", where, what, isWrong ? inQuotes(text) : "", fault);
  }
};

/// The value of an element that is Integer, ScaledInteger or Float.
double numberOf(const XmlElement& element, const Numbers& numbers)
{
  const double value = numbers.real(element.trimmedText(), element.name, 0.0);
  return element.attribute("type") == "ScaledInteger"
    ? value * numbers.real(element.attribute("scale"), element.name + " scale", 1.0) +
      numbers.real(element.attribute("offset"), element.name + " offset", 0.0)
    : value;
}

double numberOf(const XmlElement* parent, const char* name, const Numbers& numbers)
{
  const XmlElement* element = parent ? parent->child(name) : nullptr;
  return element ? numberOf(*element, numbers) : 0.0;
}

/// @p text for one line.
std::string inOneLine(std::string_view text)
{
  std::string line(text);
  std::replace_if(
    line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return line;
}

unsigned bitsOfRange(std::int64_t minimum, std::int64_t maximum)
{
  const std::uint64_t range = static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(minimum);
  unsigned bits = 0;
  while (bits < 64 && range >> bits != 0)
  {
    ++bits;
  }
  return bits;
}

void setIntegerRange(E57Field& field, const XmlElement& element, const Numbers& numbers)
{
  using Limits = std::numeric_limits<std::int64_t>;
  field.minimum = numbers.integer(element.attribute("minimum"), field.name + " minimum", Limits::min());
  field.maximum = numbers.integer(element.attribute("maximum"), field.name + " maximum", Limits::max());
  numbers.failIf(field.maximum < field.minimum, field.name + " maximum", element.attribute("maximum"),
    "is below the minimum");
  field.bits = bitsOfRange(field.minimum, field.maximum);
}

void addFields(const XmlElement& parent, const std::string& prefix, const Numbers& numbers, E57Scan& scan)
{
  for (const XmlElement& element : parent.children)
  {
    const std::string_view type = element.attribute("type");
    E57Field field;
    field.name = prefix + element.name;
    if (type == "Structure" || type == "Vector")
    {
      addFields(element, field.name + "/", numbers, scan);
      continue;
    }
    if (type == "Integer" || type == "ScaledInteger")
    {
      field.kind = type == "Integer" ? E57Field::Kind::Integer : E57Field::Kind::Scaled;
      setIntegerRange(field, element, numbers);
      field.scale = numbers.real(element.attribute("scale"), field.name + " scale", 1.0);
      field.offset = numbers.real(element.attribute("offset"), field.name + " offset", 0.0);
    }
    else if (type == "Float")
    {
      const bool isSingle = element.attribute("precision") == "single";
      field.kind = isSingle ? E57Field::Kind::Float : E57Field::Kind::Double;
      field.bits = isSingle ? 32 : 64;
    }
    else
    {
      numbers.failIf(type != "String", field.name, type, "is no type of a record's field");
      field.kind = E57Field::Kind::Text;
      field.bits = 0;
    }
    scan.fields.push_back(field);
    failFormatIf(scan.fields.size() > kMostColumns, kRewriteCure, "{}: more than {} fields", numbers.where,
      kMostColumns);
  }
}

void checkNames(const E57Scan& scan, const Numbers& numbers)
{
  std::set<std::string> names;
  for (const E57Field& field : scan.fields)
  {
    numbers.failIf(!names.insert(field.name).second, "a field", field.name, "comes twice");
  }
}

E57Pose poseOf(const XmlElement* element, const Numbers& numbers)
{
  E57Pose pose;
  const XmlElement* rotation = element ? element->child("rotation") : nullptr;
  const XmlElement* translation = element ? element->child("translation") : nullptr;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const char axis[] = { static_cast<char>('x' + i), '\0' };
    pose.translation[i] = numberOf(translation, axis, numbers);
    pose.rotation[i + 1] = numberOf(rotation, axis, numbers);
  }
  if (!rotation)
  {
    return pose;
  }
  pose.rotation[0] = numberOf(rotation, "w", numbers);
  const std::array<double, 4>& q = pose.rotation;
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  failFormatIf(!(length > 0.0) || !std::isfinite(length), kRewriteCure,
    "{}: the rotation of the pose is a quaternion of length {:f}, not 1", numbers.where, length);
  // Rounded digits are no other rotation: within them the quaternion stays as it is written.
  constexpr double kRounded = 1e-15;
  if (std::abs(length - 1.0) > kRounded)
  {
    for (double& component : pose.rotation)
    {
      component /= length;
    }
  }
  return pose;
}

void setColorLimits(const XmlElement* limits, const Numbers& numbers, E57Scan& scan)
{
  const char* const names[3] = { "colorRed", "colorGreen", "colorBlue" };
  for (std::size_t i = 0; limits && i < 3; ++i)
  {
    const std::string name = names[i];
    if (limits->child(name + "Maximum"))
    {
      scan.colorLimits[i] = E57Limits{ numberOf(limits, (name + "Minimum").c_str(), numbers),
        numberOf(limits, (name + "Maximum").c_str(), numbers) };
    }
  }
}

/// The standard has one codec, which is used where none is named.
void checkCodecs(const XmlElement* codecs, const Numbers& numbers)
{
  const auto isKnown = [](const XmlElement& codec) { return codec.child("bitPackCodec") != nullptr; };
  failFormatIf(codecs && !std::all_of(codecs->children.begin(), codecs->children.end(), isKnown),
    kRewriteCure, "{}: its points are packed by another codec than bitPackCodec", numbers.where);
}

E57Scan scanOf(const XmlElement& element, std::size_t number)
{
  E57Scan scan;
  scan.number = number - 1;
  const std::string ordinal = "scan " + std::to_string(number);
  scan.name = inOneLine(element.textOf("name"));
  const Numbers numbers{ scan.name.empty() ? ordinal : ordinal + " " + inQuotes(scan.name) };
  scan.name = scan.name.empty() ? ordinal : scan.name;
  scan.pose = poseOf(element.child("pose"), numbers);
  setColorLimits(element.child("colorLimits"), numbers, scan);
  const XmlElement* points = element.child("points");
  if (!points)
  {
    return scan;
  }
  const XmlElement* prototype = points->child("prototype");
  failFormatIf(points->attribute("type") != "CompressedVector" || !prototype, kRewriteCure,
    "{}: its points are no CompressedVector with a prototype", numbers.where);
  scan.records = numbers.count(points->attribute("recordCount"), "recordCount");
  scan.fileOffset = numbers.count(points->attribute("fileOffset"), "fileOffset");
  addFields(*prototype, "", numbers, scan);
  checkNames(scan, numbers);
  checkCodecs(points->child("codecs"), numbers);
  return scan;
}

} // namespace

bool E57Pose::isIdentity() const
{
  return translation == std::array<double, 3>{} && std::abs(rotation[0]) == 1.0 && rotation[1] == 0.0 &&
    rotation[2] == 0.0 && rotation[3] == 0.0;
}

std::size_t E57Scan::find(const std::string& fieldName) const
{
  const auto found = std::find_if(
    fields.begin(), fields.end(), [&](const E57Field& field) { return field.name == fieldName; });
  return found == fields.end() ? npos : static_cast<std::size_t>(found - fields.begin());
}

E57Contents parseE57Contents(const XmlElement& root)
{
  failFormatIf(
    root.name != "e57Root", kRewriteCure, "the XML begins with {}, not with 'e57Root'", inQuotes(root.name));
  E57Contents contents;
  contents.generator = inOneLine(root.textOf("e57LibraryVersion"));
  contents.coordinateSystem = root.textOf("coordinateMetadata");
  const XmlElement* images = root.child("images2D");
  contents.images = images ? images->children.size() : 0;
  if (const XmlElement* scans = root.child("data3D"))
  {
    for (const XmlElement& scan : scans->children)
    {
      contents.scans.push_back(scanOf(scan, contents.scans.size() + 1));
    }
  }
  return contents;
}

} // namespace pointhaptics::io
