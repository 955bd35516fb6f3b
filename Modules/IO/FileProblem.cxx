#include "FileProblem.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

struct Character
{
  std::size_t bytes = 0; ///< 0: there is none.
  std::uint32_t code = 0;
};

/// The character of UTF-8 at the front of @p text.
Character characterAt(std::string_view text)
{
  constexpr std::uint32_t kLeast[] = { 0, 0, 0x80, 0x800, 0x10000 }; // by bytes: fewer would do below
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t bytes = byte(0) < 0x80 ? 1 : byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  bool isRight = byte(0) < 0x80 || (byte(0) >= 0xc0 && byte(0) < 0xf8 && text.size() >= bytes);
  std::uint32_t code = bytes == 1 ? byte(0) : byte(0) & (0xffU >> (bytes + 1));
  for (std::size_t i = 1; isRight && i < bytes; ++i)
  {
    isRight = (byte(i) & 0xc0) == 0x80;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  isRight = isRight && code >= kLeast[bytes] && code <= 0x10ffff && !(code >= 0xd800 && code < 0xe000);
  return isRight ? Character{ bytes, code } : Character();
}

/// False for control characters, and for those without a shape that turn a text around or end its line.
bool isPrintable(std::uint32_t code)
{
  const auto isWithin = [code](std::uint32_t first, std::uint32_t last)
  { return code >= first && code <= last; };
  return code >= 0x20 && !isWithin(0x7f, 0x9f) && !isWithin(0x200b, 0x200f) && !isWithin(0x2028, 0x202e) &&
    !isWithin(0x2060, 0x206f);
}

} // namespace

std::size_t characterBytes(std::string_view text)
{
  return characterAt(text).bytes;
}

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  while (!text.empty())
  {
    const Character character = characterAt(text);
    const std::string_view shown = isPrintable(character.code) ? text.substr(0, character.bytes) : "?";
    if (result.size() + shown.size() > kLongest + 1)
    {
      return result + "...'";
    }
    result += shown;
    text.remove_prefix(std::max<std::size_t>(character.bytes, 1));
  }
  return result + "'";
}

} // namespace pointhaptics::io
