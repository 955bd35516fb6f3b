/// @file
/// The XML section of an E57 file as a tree. The parser is expat, which VTK's own XML readers bring along.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pointhaptics::io
{

class E57Pages;

/// Elements inside each other; E57 itself needs about ten.
constexpr std::size_t kMostE57Depth = 64;
/// Elements of the whole section: scans and images have about fifty each.
constexpr std::size_t kMostE57Elements = 500000;

/// One element: <name attribute="value">text<child/></name>.
struct E57Element
{
  std::string name; ///< with its prefix: "nor:normalX"
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text; ///< between the tags, without that of the children
  std::vector<E57Element> children;

  /// The first child of that name; null when there is none.
  const E57Element* child(std::string_view childName) const;
  /// Empty when it is not there.
  std::string_view attribute(std::string_view attributeName) const;
  std::string_view trimmedText() const; ///< without white space around it
  /// The text of a child without white space around it; empty when there is no such child.
  std::string_view textOf(std::string_view childName) const;
};

/// @throws FileProblem with the line of a fault, for document types (and with them for entities), and beyond
/// the limits above.
E57Element parseE57Xml(const E57Pages& pages);

} // namespace pointhaptics::io
