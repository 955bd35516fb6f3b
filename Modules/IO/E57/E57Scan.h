/// @file
/// Scans of an E57 file, as its XML section describes them. Layout: ASTM E2807-11, tables 1 to 20.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointhaptics::io
{

struct XmlElement;

/// One column of a scan's records, stored as a stream of its own.
struct E57Field
{
  enum class Kind
  {
    Integer, ///< stored + minimum
    Scaled,  ///< (stored + minimum) * scale + offset
    Float,
    Double,
    Text, ///< not read
  };
  std::string name; ///< "cartesianX", "nor:normalX"; "outer/inner" inside a structure
  Kind kind = Kind::Double;
  unsigned bits = 64; ///< of a record; 0 for integers whose minimum is their maximum
  std::int64_t minimum = 0;
  std::int64_t maximum = 0;
  double scale = 1.0;
  double offset = 0.0;
};

/// Where a scanner stood: file = rotation (unit quaternion w x y z) of the scanner's frame, then translation,
/// metres.
struct E57Pose
{
  std::array<double, 4> rotation{ 1, 0, 0, 0 };
  std::array<double, 3> translation{};
  bool isIdentity() const;
};

/// Least and greatest value of a colour that the scanner can give.
struct E57Limits
{
  double least = 0.0;
  double most = 0.0;
};

struct E57Scan
{
  std::string name;       ///< the file's, or "scan 3" (counted from 1) where it has none
  std::size_t number = 0; ///< in the file, from 0
  std::vector<E57Field> fields;
  E57Pose pose;
  std::array<std::optional<E57Limits>, 3> colorLimits; ///< red, green, blue
  std::uint64_t records = 0;
  std::uint64_t fileOffset = 0; ///< physical, of the section with the records

  /// Index of a field; npos when there is none.
  std::size_t find(const std::string& fieldName) const;
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
};

/// The file: its scans, and what else it says.
struct E57Contents
{
  std::vector<E57Scan> scans;
  std::string generator;        ///< the library or program that wrote it; may be empty
  std::string coordinateSystem; ///< well-known text; may be empty
  std::size_t images = 0;
};

/// @throws FileProblem with the scan, the field and the value for what is missing or cannot be.
E57Contents parseE57Contents(const XmlElement& root);

} // namespace pointhaptics::io
