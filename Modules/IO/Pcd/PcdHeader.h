/// @file
/// The header of a PCD file, checked before anything of the claimed sizes is allocated.
#pragma once

#include "IO/Columns/CloudColumns.h"
#include "IO/Info/FileComments.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

struct ReadTask;

/// In the order of PcdEncoding.
constexpr std::string_view kPcdEncodings[] = { "ascii", "binary", "binary_compressed" };

enum class PcdEncoding
{
  Ascii,
  Binary,
  Compressed,
};

struct PcdField
{
  std::string name;
  int type = 0; ///< VTK type
  int count = 1;
  std::size_t offset = 0; ///< inside a binary record
  std::size_t index = 0;  ///< of its column, unless it is padding

  bool isPadding() const { return name == "_"; }
  /// "rgb" or "rgba" of 4 bytes: three or four bytes packed into one number.
  bool isPackedColor() const;
  /// Name, type and components of the array that the field becomes. Padding becomes none.
  Column column() const;
};

struct PcdHeader
{
  PcdEncoding encoding = PcdEncoding::Ascii;
  std::vector<PcdField> fields;
  unsigned long long width = 0;
  unsigned long long height = 1;
  unsigned long long points = 0;
  std::array<double, 7> viewpoint{ 0, 0, 0, 1, 0, 0, 0 }; ///< position, then quaternion w x y z
  FileComments comments;
  std::size_t bodyOffset = 0;
  std::size_t bodyLine = 0;
  std::size_t recordSize = 0;           ///< bytes of a binary record
  std::size_t compressedRecordSize = 0; ///< the same without padding, where compressed files leave it out
  std::size_t compressedSize = 0; ///< bytes of a compressed file's points, which follow 8 bytes of sizes
  std::size_t numbersPerLine = 0; ///< of an ASCII record
};

/// @throws FileProblem with line and value, also when the file is too short for what the header promises: one
/// that is not compressed is read as far as task.endAt() decides.
PcdHeader parsePcdHeader(ReadTask& task);

} // namespace pointhaptics::io
