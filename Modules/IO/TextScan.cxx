#include "TextScan.h"

#include <cctype>
#include <charconv>
#include <cmath>

namespace pointhaptics::io
{

bool LineReader::next(std::string_view& line)
{
  if (position_ >= text_.size())
  {
    return false;
  }
  const std::size_t found = text_.find(end_, position_);
  const std::size_t end = found == std::string_view::npos ? text_.size() : found;
  line = text_.substr(position_, end - position_);
  if (!line.empty() && line.back() == '\r')
  {
    line.remove_suffix(1);
  }
  position_ = found == std::string_view::npos ? end : end + 1;
  ++lineNumber_;
  return true;
}

std::string_view trimmed(std::string_view text)
{
  while (!text.empty() && isBlank(text.front()))
  {
    text.remove_prefix(1);
  }
  while (!text.empty() && isBlank(text.back()))
  {
    text.remove_suffix(1);
  }
  return text;
}

std::string_view takeWord(std::string_view& line)
{
  std::size_t begin = 0;
  while (begin < line.size() && isBlank(line[begin]))
  {
    ++begin;
  }
  std::size_t end = begin;
  while (end < line.size() && !isBlank(line[end]))
  {
    ++end;
  }
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

bool equalNoCase(std::string_view a, std::string_view b)
{
  if (a.size() != b.size())
  {
    return false;
  }
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    if (std::tolower(static_cast<unsigned char>(a[i])) != std::tolower(static_cast<unsigned char>(b[i])))
    {
      return false;
    }
  }
  return true;
}

const char* parseNumber(const char* first, const char* last, double& value) noexcept
{
  if (last - first > 1 && first[0] == '+' && first[1] != '-')
  {
    ++first;
  }
  const std::from_chars_result result = std::from_chars(first, last, value);
  if (result.ec == std::errc())
  {
    return result.ptr;
  }
  if (result.ec == std::errc::result_out_of_range)
  {
    const std::string_view word(first, static_cast<std::size_t>(result.ptr - first));
    const std::size_t exponent = word.find_first_of("eE");
    const bool tiny = exponent == std::string_view::npos
      ? word.find_first_of("123456789") > word.find('.')
      : word.substr(exponent).find('-') != std::string_view::npos;
    if (tiny)
    {
      value = 0.0;
      return result.ptr;
    }
  }
  return nullptr;
}

bool parseNumber(std::string_view word, double& value) noexcept
{
  const char* last = word.data() + word.size();
  return !word.empty() && parseNumber(word.data(), last, value) == last;
}

bool parseCount(std::string_view word, unsigned long long& value) noexcept
{
  const char* last = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), last, value);
  return result.ec == std::errc() && result.ptr == last;
}

int significantDigits(std::string_view word) noexcept
{
  int digits = 0;
  int zeros = 0;
  for (const char c : word)
  {
    if (c == 'e' || c == 'E')
    {
      break;
    }
    if (c >= '1' && c <= '9')
    {
      digits += zeros + 1;
      zeros = 0;
    }
    else if (c == '0' && digits > 0)
    {
      ++zeros;
    }
  }
  return digits;
}

bool fitsFloat(std::string_view word, double value) noexcept
{
  const double size = std::abs(value);
  return significantDigits(word) <= kFloatDigits && (!(size > 1e37) || std::isinf(size)) &&
    !(size > 0.0 && size < 1e-37);
}

} // namespace pointhaptics::io
