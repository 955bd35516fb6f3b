#include "IO/Vtk/XmlTags.h"

#include "FileProblem.h"

namespace pointhaptics::io
{

namespace
{

/// VTK's own files stay below 10.
constexpr int kMostDepth = 64;
constexpr std::string_view kAppendedData = "<AppendedData";

[[noreturn]] void failAt(std::size_t byte, const std::string& what)
{
  failFormat("byte " + std::to_string(byte) + ": " + what, "the file is damaged: copy or write it again");
}

} // namespace

XmlTags::XmlTags(std::string_view bytes)
  : bytes_(bytes)
  , appended_(bytes.find(kAppendedData))
{
}

/// True if @p start stands at begin_; then position_ is behind the next @p end.
bool XmlTags::passOver(std::string_view start, std::string_view end)
{
  if (bytes_.substr(begin_, start.size()) != start)
  {
    return false;
  }
  const std::size_t found = bytes_.find(end, begin_ + start.size());
  if (found == std::string_view::npos)
  {
    failAt(begin_, "what begins here with " + inQuotes(start) + " has no end");
  }
  position_ = found + end.size();
  return true;
}

void XmlTags::findEnd()
{
  char quote = '\0';
  for (end_ = begin_ + 1; end_ < bytes_.size(); ++end_)
  {
    const char c = bytes_[end_];
    if (quote != '\0')
    {
      quote = c == quote ? '\0' : quote;
    }
    else if (c == '"' || c == '\'')
    {
      quote = c;
    }
    else if (c == '>')
    {
      return;
    }
  }
  failAt(begin_, "a tag without end");
}

void XmlTags::countDepth()
{
  if (tag().substr(0, 2) == "</")
  {
    --depth_;
  }
  else if (tag().back() != '/')
  {
    ++depth_;
  }
  if (depth_ > kMostDepth)
  {
    failAt(begin_, "more than " + std::to_string(kMostDepth) + " XML elements inside each other");
  }
}

/// VTK takes the first text "<AppendedData" for the tag, wherever it stands.
void XmlTags::checkAppended() const
{
  if (position_ > appended_ && !isLast_)
  {
    failAt(appended_, inQuotes(kAppendedData) + " in a place where it is no tag");
  }
}

bool XmlTags::next()
{
  while (!isLast_)
  {
    begin_ = bytes_.find('<', position_);
    if (begin_ == std::string_view::npos)
    {
      return false;
    }
    if (passOver("<!--", "-->") || passOver("<![CDATA[", "]]>") || passOver("<?", "?>"))
    {
      checkAppended();
      continue;
    }
    if (bytes_.substr(begin_, 2) == "<!")
    {
      failAt(begin_, "XML entities have no place in a point cloud");
    }
    findEnd();
    position_ = end();
    isLast_ = begin_ == appended_;
    checkAppended();
    countDepth();
    return true;
  }
  return false;
}

} // namespace pointhaptics::io
