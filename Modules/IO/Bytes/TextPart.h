/// @file
/// The lines of a text that a rank reads, where ranks read it together.
#pragma once

#include "ReadTask.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Bytes of a file that are looked at before it is known what else is needed: headers are much shorter.
constexpr std::size_t kStartOfText = std::size_t{ 1 } << 20;

/// Whole lines that follow each other.
struct TextPart
{
  std::size_t begin = 0; ///< Bytes of the text.
  std::size_t end = 0;
  std::size_t firstLine = 1;     ///< Number of the first line.
  RowRange filled;               ///< Which of the lines that are not blank.
  std::uint64_t filledOfAll = 0; ///< Number of such lines of all ranks.

  /// Rows of this part, where the first @p all lines that are not blank are rows. @throws FileProblem where
  /// the lines of all ranks are too few, of which each is a @p what.
  RowRange rowsOf(std::uint64_t all, const char* what) const
  {
    if (filledOfAll < all)
    {
      failTruncated("the file ends before " + std::string(what) + " " + std::to_string(filledOfAll) + " of " +
        std::to_string(all));
    }
    return { std::min(filled.first, all), std::min(filled.last, all) };
  }
};

/// Collective: of the lines of @p text, a part of task.bytes, from the byte @p bodyOffset and line number @p
/// bodyLine on, those that begin in this rank's part of its bytes; all of them, not counted, where one reads
/// alone. Texts without a line feed in their first bytes are read whole.
TextPart partOfText(ReadTask& task, std::string_view text, std::size_t bodyOffset, std::size_t bodyLine);

} // namespace pointhaptics::io
