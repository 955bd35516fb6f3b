#include "FileProblem.h"

#include "vtk_utf8.h"

#include <cstdint>

namespace pointhaptics::io
{
namespace
{

/// False for control characters, and for those without a shape that turn a text around or end its line.
bool isPrintable(std::uint32_t code)
{
  const auto isWithin = [code](std::uint32_t first, std::uint32_t last)
  { return code >= first && code <= last; };
  return code >= 0x20 && !isWithin(0x7f, 0x9f) && !isWithin(0x200b, 0x200f) && !isWithin(0x2028, 0x202e) &&
    !isWithin(0x2060, 0x206f);
}

} // namespace

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t kLongest = 40;
  std::string result = "'";
  for (const char* at = text.data(); at != text.data() + text.size();)
  {
    const char* const character = at;
    std::uint32_t code = 0; // no printable one
    try
    {
      code = utf8::next(at, text.data() + text.size());
    }
    catch (const utf8::exception&)
    {
      ++at;
    }
    const std::string shown = isPrintable(code) ? std::string(character, at) : "?";
    if (result.size() + shown.size() > kLongest + 1)
    {
      return result + "...'";
    }
    result += shown;
  }
  return result + "'";
}

} // namespace pointhaptics::io
