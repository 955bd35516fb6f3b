#include "IO/E57/E57Xml.h"

#include "FileProblem.h"
#include "IO/E57/E57Pages.h"

#include "vtk_expat.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <memory>

namespace pointhaptics::io
{

namespace
{

constexpr const char* kCure = "the file is damaged: copy or write it again";

/// The line that the parser is at, from 1.
std::uint64_t lineOf(XML_Parser parser)
{
#if XML_MAJOR_VERSION > 2 || (XML_MAJOR_VERSION == 2 && XML_MINOR_VERSION >= 8)
  return XML_GetCurrentLineNumber64(parser); // the other is deprecated there
#else
  return XML_GetCurrentLineNumber(parser);
#endif
}

/// Builds the tree as expat calls; nothing is thrown through expat, which is C.
class TreeBuilder
{
public:
  explicit TreeBuilder(XML_Parser parser)
    : parser_(parser)
  {
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, &TreeBuilder::onStart, &TreeBuilder::onEnd);
    XML_SetCharacterDataHandler(parser, &TreeBuilder::onText);
    XML_SetStartDoctypeDeclHandler(parser, &TreeBuilder::onDocumentType);
  }
  void feed(const char* bytes, std::size_t size, bool isLast)
  {
    const XML_Status status = XML_Parse(parser_, bytes, static_cast<int>(size), isLast);
    if (problem_)
    {
      std::rethrow_exception(problem_);
    }
    if (status != XML_STATUS_OK)
    {
      fail(XML_ErrorString(XML_GetErrorCode(parser_)));
    }
  }
  E57Element takeRoot() { return std::move(document_.children.front()); }

private:
  [[noreturn]] void fail(const std::string& what) const
  {
    failFormat("XML line " + std::to_string(lineOf(parser_)) + ": " + what, kCure);
  }
  template <typename F>
  static void guarded(void* self, F&& f)
  {
    TreeBuilder& builder = *static_cast<TreeBuilder*>(self);
    try
    {
      if (!builder.problem_)
      {
        f(builder);
      }
    }
    catch (...)
    {
      builder.problem_ = std::current_exception();
      XML_StopParser(builder.parser_, XML_FALSE);
    }
  }
  void start(const char* name, const char** attributes)
  {
    if (open_.size() > kMostE57Depth)
    {
      fail("more than " + std::to_string(kMostE57Depth) + " elements inside each other");
    }
    if (++elements_ > kMostE57Elements)
    {
      fail("more than " + std::to_string(kMostE57Elements) + " elements");
    }
    // An open element's siblings come after it is closed, so that the addresses of open ones stay.
    E57Element& element = open_.back()->children.emplace_back();
    element.name = name;
    for (; attributes[0]; attributes += 2)
    {
      element.attributes.emplace_back(attributes[0], attributes[1]);
    }
    open_.push_back(&element);
  }

  static void onStart(void* self, const char* name, const char** attributes)
  {
    guarded(self, [&](TreeBuilder& builder) { builder.start(name, attributes); });
  }
  static void onEnd(void* self, const char*)
  {
    guarded(self, [](TreeBuilder& builder) { builder.open_.pop_back(); });
  }
  static void onText(void* self, const char* text, int size)
  {
    guarded(self,
      [&](TreeBuilder& builder) { builder.open_.back()->text.append(text, static_cast<std::size_t>(size)); });
  }
  static void onDocumentType(void* self, const char*, const char*, const char*, int)
  {
    guarded(
      self, [](TreeBuilder& builder) { builder.fail("a document type, which could declare entities"); });
  }

  XML_Parser parser_;
  E57Element document_;
  std::vector<E57Element*> open_{ &document_ };
  std::size_t elements_ = 0;
  std::exception_ptr problem_;
};

bool isXmlSpace(char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

struct FreeParser
{
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

} // namespace

const E57Element* E57Element::child(std::string_view childName) const
{
  const auto found = std::find_if(
    children.begin(), children.end(), [&](const E57Element& element) { return element.name == childName; });
  return found == children.end() ? nullptr : &*found;
}

std::string_view E57Element::attribute(std::string_view attributeName) const
{
  for (const auto& [key, value] : attributes)
  {
    if (key == attributeName)
    {
      return value;
    }
  }
  return {};
}

std::string_view E57Element::textOf(std::string_view childName) const
{
  const E57Element* found = child(childName);
  return found ? found->trimmedText() : std::string_view();
}

std::string_view E57Element::trimmedText() const
{
  const auto first = std::find_if_not(text.begin(), text.end(), isXmlSpace);
  const auto last = std::find_if_not(text.rbegin(), text.rend(), isXmlSpace).base();
  return first == text.end() ? std::string_view()
                             : std::string_view(text).substr(static_cast<std::size_t>(first - text.begin()),
                                 static_cast<std::size_t>(last - first));
}

E57Element parseE57Xml(const E57Pages& pages)
{
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeParser> parser(XML_ParserCreate(nullptr));
  if (!parser)
  {
    throw std::bad_alloc();
  }
  TreeBuilder builder(parser.get());
  std::array<char, 65536> part;
  std::uint64_t left = pages.xmlLength();
  std::uint64_t at = pages.xmlOffset();
  do
  {
    const std::size_t size = static_cast<std::size_t>(std::min<std::uint64_t>(left, part.size()));
    pages.copy(at, size, part.data());
    at += size;
    left -= size;
    builder.feed(part.data(), size, left == 0);
  } while (left > 0);
  return builder.takeRoot();
}

} // namespace pointhaptics::io
