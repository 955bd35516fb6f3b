/// @file
/// XML as a tree. The parser is expat, which VTK's own XML readers bring along.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pointhaptics::io
{

/// Elements inside each other; E57 needs about ten, and VTK a frame of its stack for each.
constexpr std::size_t kMostXmlDepth = 64;
/// Elements of the whole text: scans and images of E57 have about fifty each.
constexpr std::size_t kMostXmlElements = 500000;
/// Bytes of a tag or a comment: parsers that are given less at once, as VTK's are, look at each one again and
/// again.
constexpr std::size_t kLongestXmlTag = std::size_t{ 1 } << 16;

/// One element: <name attribute="value">text<child/></name>.
struct XmlElement
{
  std::string name; ///< with its prefix: "nor:normalX"
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;      ///< between the tags, without that of the children; empty where no texts are wanted
  std::size_t begin = 0; ///< byte of its '<'
  std::size_t end = 0;   ///< byte behind the '>' of its first tag
  std::vector<XmlElement> children;

  /// The first child of that name; null when there is none.
  const XmlElement* child(std::string_view childName) const;
  /// Empty when it is not there.
  std::string_view attribute(std::string_view attributeName) const;
  std::string_view trimmedText() const; ///< without white space around it
  /// The text of a child without white space around it; empty when there is no such child.
  std::string_view textOf(std::string_view childName) const;
};

/// Calls @p visit for @p root and all below it, in the order of the text.
void forEachElement(const XmlElement& root, const std::function<void(const XmlElement&)>& visit);

/// How much of a text there is.
enum class XmlPart
{
  Whole,
  Start, ///< It ends behind a tag, which need not be closed.
};

/// The root of the text that @p next gives, in pieces of at most kLongestXmlTag bytes, until it is empty; the
/// start of a text may have none, and then it has no name. @throws FileProblem with the line of a fault, for
/// document types (and with them for entities), and beyond the limits above.
XmlElement parseXml(
  const std::function<std::string_view()>& next, bool wantsTexts, XmlPart part = XmlPart::Whole);

} // namespace pointhaptics::io
