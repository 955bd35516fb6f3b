/// @file
/// Lines, words and numbers of a text in memory. Independent of the locale; nothing here allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace pointhaptics::io
{

/// Walks over lines ended by LF, CR LF or, in a text without any LF, CR.
class LineReader
{
public:
  explicit LineReader(std::string_view text, std::size_t firstLineNumber = 1)
    : text_(text)
    , end_(text.find('\n') == std::string_view::npos ? '\r' : '\n')
    , lineNumber_(firstLineNumber - 1)
  {
  }
  /// The next line without its end. @return false at the end of the text.
  bool next(std::string_view& line);
  /// The next line that has more than blanks.
  bool nextFilled(std::string_view& line);
  std::size_t lineNumber() const { return lineNumber_; } ///< of the line returned last; the first is 1
  bool isAtEnd() const { return position_ >= text_.size(); }
  std::size_t position() const { return position_; } ///< byte just after the line returned last

private:
  std::string_view text_;
  std::size_t position_ = 0;
  char end_;
  std::size_t lineNumber_;
};

inline bool isBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// A blank or the end of a line.
inline bool isSpace(char c)
{
  return isBlank(c) || c == '\n';
}

/// @p text without white space at both ends.
std::string_view trimmed(std::string_view text);

/// Takes the next word off the front of @p line; empty when there is none left.
std::string_view takeWord(std::string_view& line);

/// Without regard to case, for ASCII.
bool equalNoCase(std::string_view a, std::string_view b);

/// Index of @p word among @p words; their number where it is none of them.
template <std::size_t Count>
std::size_t indexOf(const std::string_view (&words)[Count], std::string_view word)
{
  return static_cast<std::size_t>(std::find(words, words + Count, word) - words);
}

/// How a number was written, which determines the type that holds it.
struct NumberShape
{
  bool isInteger = false; ///< digits only: no point, exponent, nan or inf
  bool fitsFloat = false; ///< at most kFloatDigits significant digits, and well within a float's range
};

/// Most significant digits that every float keeps.
constexpr int kFloatDigits = 6;

/// Parses a decimal number, nan or inf at @p first, with an optional sign; 0 for one too small for a double.
/// Correctly rounded. @return one past its end, or null when there is none or it is too large for a double.
const char* parseNumber(
  const char* first, const char* last, double& value, NumberShape* shape = nullptr) noexcept;

/// Parses the whole of @p word. @return false when it is not exactly one number.
bool parseNumber(std::string_view word, double& value, NumberShape* shape = nullptr) noexcept;

/// Takes a number and the blanks before it off the front of @p line. @return false, and only the blanks are
/// taken, when the next word is not exactly one number.
bool takeNumber(std::string_view& line, double& value, NumberShape* shape = nullptr) noexcept;

/// Parses the whole of @p word as a count. @return false when it is anything else or beyond 64 bits.
bool parseCount(std::string_view word, unsigned long long& value) noexcept;

} // namespace pointhaptics::io
