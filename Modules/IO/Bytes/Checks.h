/// @file
/// Checks of what a file says: a condition, the text of the fault, and its cure.
#pragma once

#include "FileProblem.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace pointhaptics::io
{

/// Each check throws as the function of FileProblem.h that it is named after, where @p isWrong: fmt makes the
/// text of @p what and @p parts only then. Not for loops over points: the parts are evaluated each time.
template <typename... Parts>
void failFormatIf(
  bool isWrong, const char* cure, fmt::format_string<const Parts&...> what, const Parts&... parts)
{
  if (isWrong)
  {
    failFormat(fmt::format(what, parts...), cure);
  }
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

template <typename... Parts>
void failTruncatedIf(bool isWrong, fmt::format_string<const Parts&...> what, const Parts&... parts)
{
  if (isWrong)
  {
    failTruncated(fmt::format(what, parts...));
  }
}

} // namespace pointhaptics::io
