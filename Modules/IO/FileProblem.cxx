#include "FileProblem.h"

namespace pointhaptics::io
{

namespace
{

/// Characters without a shape that turn a text around or end its line: U+200B..F, U+2028..E and U+2060..F.
bool isDirection(std::string_view text)
{
  const std::string_view start = text.substr(0, 2);
  const auto last = static_cast<unsigned char>(text.size() > 2 ? text[2] : 0);
  return (start == "\xe2\x80" && ((last >= 0x8b && last <= 0x8f) || (last >= 0xa8 && last <= 0xae))) ||
    (start == "\xe2\x81" && last >= 0xa0 && last <= 0xaf);
}

/// Bytes of the printable UTF-8 character at the front of @p text; 0 where none stands there.
std::size_t printableBytes(std::string_view text)
{
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80)
  {
    return byte(0) >= 0x20 && byte(0) != 0x7f ? 1 : 0;
  }
  const std::size_t size = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < size)
  {
    return 0;
  }
  for (std::size_t i = 1; i < size; ++i)
  {
    if ((byte(i) & 0xc0) != 0x80)
    {
      return 0;
    }
  }
  const bool isControl = byte(0) == 0xc2 && byte(1) < 0xa0;
  const bool isTooLong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool isNoCharacter = (byte(0) == 0xed && byte(1) >= 0xa0) || (byte(0) == 0xf4 && byte(1) >= 0x90);
  return isControl || isTooLong || isNoCharacter || isDirection(text) ? 0 : size;
}

} // namespace

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  while (!text.empty())
  {
    const std::size_t size = printableBytes(text);
    const std::string_view shown = size > 0 ? text.substr(0, size) : "?";
    if (result.size() + shown.size() > kLongest + 1)
    {
      return result + "...'";
    }
    result += shown;
    text.remove_prefix(shown.size());
  }
  return result + "'";
}

} // namespace pointhaptics::io
