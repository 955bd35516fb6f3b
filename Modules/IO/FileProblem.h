/// @file
/// Fault of a file in a format reader or writer: one exception type that never leaves this module.
/// vtkPointCloudReader and vtkPointCloudWriter turn it into an error code and a message.
#pragma once

#include "vtkErrorCode.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Fault of a file (with line or byte offset and value) and its cure.
class FileProblem : public std::runtime_error
{
public:
  FileProblem(unsigned long vtkCode, const std::string& what, const std::string& cure)
    : std::runtime_error(what + "; " + cure)
    , code(vtkCode)
  {
  }
  /// @p message: with its cure.
  FileProblem(unsigned long vtkCode, const std::string& message)
    : std::runtime_error(message)
    , code(vtkCode)
  {
  }
  unsigned long code; ///< One of vtkErrorCode::ErrorIds.
};

/// "a.ply: PLY: message"; without a format where it is not known.
inline std::string messageOf(const char* fileName, const std::string& format, const std::string& message)
{
  return (fileName ? fileName : "no file name") + (": " + format) + (format.empty() ? "" : ": ") + message;
}

/// Reading or writing was stopped from a progress observer (vtkAlgorithm::AbortExecute).
class StoppedOnRequest : public std::exception
{
};

/// "line 12: ", in front of what is there.
inline std::string atLine(std::size_t line)
{
  return "line " + std::to_string(line) + ": ";
}

/// The content is not what the format asks for.
[[noreturn]] inline void failFormat(const std::string& what, const std::string& cure)
{
  throw FileProblem(vtkErrorCode::FileFormatError, what, cure);
}

/// Throws as failFormat() where @p isWrong: fmt makes the text of @p what and @p parts only then. Not for
/// loops over points: the parts are evaluated each time.
template <typename... Parts>
void failFormatIf(
  bool isWrong, const char* cure, fmt::format_string<const Parts&...> what, const Parts&... parts)
{
  if (isWrong)
  {
    failFormat(fmt::format(what, parts...), cure);
  }
}

inline constexpr const char* kDamagedCure = "the file is damaged: copy or write it again";
/// Behind the cure of a file that is cut.
inline constexpr const char* kSalvageCure = ", or read what is there by --salvage (in VTK: SalvageOn())";
inline constexpr const char* kRewriteCure = "write the file again with another program";

/// "byte 12: ", in front of what is there.
inline std::string atByte(std::uint64_t offset)
{
  return "byte " + std::to_string(offset) + ": ";
}

/// What stands at @p offset cannot be.
[[noreturn]] inline void failDamaged(std::uint64_t offset, const std::string& what)
{
  failFormat(atByte(offset) + what, kDamagedCure);
}

/// @p offset: of the bytes that cannot be.
template <typename... Parts>
void failDamagedIf(
  bool isWrong, std::uint64_t offset, fmt::format_string<const Parts&...> what, const Parts&... parts)
{
  if (isWrong)
  {
    failDamaged(offset, fmt::format(what, parts...));
  }
}

/// The file ends before the points its header promises. @param more of the cure.
[[noreturn]] inline void failTruncated(const std::string& what, const std::string& more = {})
{
  throw FileProblem(vtkErrorCode::PrematureEndOfFileError, what,
    "the file is cut short or its header is wrong: copy it again" + more);
}

template <typename... Parts>
void failTruncatedIf(bool isWrong, fmt::format_string<const Parts&...> what, const Parts&... parts)
{
  if (isWrong)
  {
    failTruncated(fmt::format(what, parts...));
  }
}

/// The file is valid and announces no points: what it says beside them is worth knowing.
class NoPoints : public FileProblem
{
public:
  explicit NoPoints(const std::string& what = "the file holds no points")
    : FileProblem(
        vtkErrorCode::FileFormatError, what, "export the cloud again and check that it is not empty")
  {
  }
};

[[noreturn]] inline void failNoPoints()
{
  throw NoPoints();
}

/// @p text in quotes, cut to 40 bytes, with what is no printable UTF-8 shown as '?': safe to print.
std::string inQuotes(std::string_view text);

} // namespace pointhaptics::io
