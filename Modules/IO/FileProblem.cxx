#include "FileProblem.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

/// False for control characters, and for those without a shape that turn a text around or end its line:
/// U+200B..F, U+2028..E and U+2060..F.
bool isPrintable(std::string_view character)
{
  const std::string_view start = character.substr(0, 2);
  const auto first = static_cast<unsigned char>(character.empty() ? 0 : character[0]);
  const auto last = static_cast<unsigned char>(character.empty() ? 0 : character.back());
  const bool isDirection =
    (start == "\xe2\x80" && ((last >= 0x8b && last <= 0x8f) || (last >= 0xa8 && last <= 0xae))) ||
    (start == "\xe2\x81" && last >= 0xa0 && last <= 0xaf);
  return first >= 0x20 && first != 0x7f && !(first == 0xc2 && last < 0xa0) && !isDirection;
}

} // namespace

void TextPiece::appendTo(std::string& message) const
{
  message += text_;
  message += isNegative_ ? "-" : "";
  message += isNumber_ ? std::to_string(isNegative_ ? 0 - number_ : number_) : std::string();
}

std::string joined(TextPieces pieces)
{
  std::string message;
  for (const TextPiece& piece : pieces)
  {
    piece.appendTo(message);
  }
  return message;
}

std::size_t characterBytes(std::string_view text)
{
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80)
  {
    return 1;
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
  const bool isTooLong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool isNoCharacter = (byte(0) == 0xed && byte(1) >= 0xa0) || (byte(0) == 0xf4 && byte(1) >= 0x90);
  return isTooLong || isNoCharacter ? 0 : size;
}

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  while (!text.empty())
  {
    const std::string_view character = text.substr(0, characterBytes(text));
    const std::string_view shown = isPrintable(character) ? character : "?";
    if (result.size() + shown.size() > kLongest + 1)
    {
      return result + "...'";
    }
    result += shown;
    text.remove_prefix(std::max<std::size_t>(character.size(), 1));
  }
  return result + "'";
}

} // namespace pointhaptics::io
