#include "IO/Bytes/TextPart.h"

#include "IO/Text/TextScan.h"

#include <limits>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kBlock = std::size_t{ 1 } << 16;

/// A text whose bytes are loaded when they are needed.
struct LoadedText
{
  const ReadTask& task;
  std::string_view text;

  std::string_view part(std::size_t begin, std::size_t size) const
  {
    task.need(static_cast<std::size_t>(text.data() - task.bytes.data()) + begin, size);
    return text.substr(begin, size);
  }
  /// Where the first line begins that does not begin before @p at, which is above 0.
  std::size_t lineFrom(std::size_t at) const
  {
    for (std::size_t begin = at - 1; begin < text.size(); begin += kBlock)
    {
      const std::size_t found = part(begin, kBlock).find('\n');
      if (found != std::string_view::npos)
      {
        return begin + found + 1;
      }
    }
    return text.size();
  }
};

struct LineCounts
{
  std::uint64_t lines = 0;
  std::uint64_t filled = 0;
};

LineCounts countLines(std::string_view text)
{
  LineCounts counts;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line))
  {
    ++counts.lines;
    counts.filled += trimmed(line).empty() ? 0 : 1;
  }
  return counts;
}

} // namespace

TextPart partOfText(ReadTask& task, std::string_view text, std::size_t bodyOffset, std::size_t bodyLine)
{
  constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();
  const LoadedText loaded{ task, text };
  if (!task.shared || loaded.part(bodyOffset, kStartOfText).find('\n') == std::string_view::npos)
  {
    task.takeWhole();
    return { bodyOffset, text.size(), bodyLine, { 0, kAll }, kAll };
  }
  const std::size_t body = text.size() - bodyOffset;
  const RowRange bytes = task.rowsOf(body);
  const auto cut = [&](std::uint64_t at)
  {
    return at == 0 ? bodyOffset
      : at == body ? text.size()
                   : loaded.lineFrom(bodyOffset + static_cast<std::size_t>(at));
  };
  TextPart part;
  part.begin = cut(bytes.first);
  part.end = cut(bytes.last);
  part.firstLine = bodyLine;
  const LineCounts own = countLines(loaded.part(part.begin, part.end - part.begin));
  const std::vector<LineCounts> all = task.shared->gatherValues(own);
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    part.firstLine += rank < task.shared->rank() ? static_cast<std::size_t>(all[rank].lines) : 0;
    part.filled.first += rank < task.shared->rank() ? all[rank].filled : 0;
    part.filledOfAll += all[rank].filled;
  }
  part.filled.last = part.filled.first + own.filled;
  return part;
}

} // namespace pointhaptics::io
