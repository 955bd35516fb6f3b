/// @file
/// Writes small E57 files for tests, bit by bit and without any of the reader's code.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// One field of a scan's prototype with the bits of its records.
struct E57TestField
{
  std::string name;
  std::string attributes; ///< type="Integer" minimum="0" ...
  unsigned bits = 0;
  std::vector<std::uint64_t> stored;
};

E57TestField e57Integer(const std::string& name, std::int64_t minimum, std::int64_t maximum,
  const std::vector<std::int64_t>& values, const std::string& type = "Integer", const std::string& more = "");
/// @p values are the raw ones: a reader gives value * scale + offset.
E57TestField e57Scaled(const std::string& name, std::int64_t minimum, std::int64_t maximum, double scale,
  double offset, const std::vector<std::int64_t>& values);
E57TestField e57Float(const std::string& name, const std::vector<float>& values);
E57TestField e57Double(const std::string& name, const std::vector<double>& values);

struct E57TestScan
{
  std::vector<E57TestField> fields;
  std::string xml{};             ///< beside its points: name, pose, colorLimits
  std::string recordCount{};     ///< instead of the true one
  std::size_t bytesPerPart = 37; ///< of each stream in a packet: records do not end there
};

struct E57TestFile
{
  std::vector<E57TestScan> scans{};
  std::string xml{};          ///< beside data3D
  std::string prologue{};     ///< before the root element
  bool sharesSection = false; ///< all scans point at the first one's
  /// The file with its checksums.
  std::string bytes() const;
};

/// The content of all pages of @p file, and the other way round with new checksums.
std::string e57Logical(const std::string& file);
std::string e57Physical(const std::string& logical);

/// A pose in XML: rotation w x y z, translation x y z.
std::string e57Pose(const std::vector<double>& rotation, const std::vector<double>& translation);
