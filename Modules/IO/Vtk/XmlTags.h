/// @file
/// The tags of an XML text, one after the other, as an XML parser would find them.
#pragma once

#include <cstddef>
#include <string_view>

namespace pointhaptics::io
{

/// Walks over the tags of @p bytes, which must outlive it; comments, CDATA sections and processing
/// instructions are passed over, and so is '>' inside quotes. The tag AppendedData is the last one: VTK puts
/// anything behind it.
class XmlTags
{
public:
  explicit XmlTags(std::string_view bytes);
  /// Goes to the next tag; false when there is none. @throws FileProblem where one does not end, where
  /// entities are declared, and where more elements stand inside each other than any VTK file has: VTK would
  /// need as many frames of its stack.
  bool next();

  /// The tag with its '<' and without its '>'.
  std::string_view tag() const { return bytes_.substr(begin_, end_ - begin_); }
  std::size_t begin() const { return begin_; }
  /// The byte after its '>'.
  std::size_t end() const { return end_ + 1; }

private:
  bool passOver(std::string_view start, std::string_view end);
  void findEnd();
  void countDepth();
  void checkAppended() const;

  std::string_view bytes_;
  std::size_t appended_; ///< where the tag AppendedData begins; npos where there is none
  std::size_t begin_ = 0;
  std::size_t end_ = 0; ///< of the tag's '>'
  std::size_t position_ = 0;
  int depth_ = 0;
  bool isLast_ = false;
};

} // namespace pointhaptics::io
