#include "IO/Bytes/XmlTree.h"

#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"

#include "vtk_expat.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <type_traits>

namespace pointhaptics::io
{

namespace
{

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
  TreeBuilder(XML_Parser parser, bool wantsTexts)
    : parser_(parser)
  {
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, &TreeBuilder::onStart, &TreeBuilder::onEnd);
    wantsTexts ? XML_SetCharacterDataHandler(parser, &TreeBuilder::onText) : void();
    XML_SetStartDoctypeDeclHandler(parser, &TreeBuilder::onDocumentType);
  }
  void feed(std::string_view bytes, bool isLast)
  {
    const XML_Status status = XML_Parse(parser_, bytes.data(), static_cast<int>(bytes.size()), isLast);
    if (problem_)
    {
      std::rethrow_exception(problem_);
    }
    if (status != XML_STATUS_OK)
    {
      fail(XML_ErrorString(XML_GetErrorCode(parser_)));
    }
    fed_ += static_cast<std::int64_t>(bytes.size());
    const std::int64_t at = XML_GetCurrentByteIndex(parser_);
    if (!isLast && at >= 0 && fed_ - at > static_cast<std::int64_t>(kLongestXmlTag))
    {
      failFormat(
        fmt::format("XML line {}: a tag or comment of more than {} bytes", lineOf(parser_), kLongestXmlTag),
        "write it with shorter ones; texts belong between tags");
    }
  }
  XmlElement takeRoot()
  {
    return document_.children.empty() ? XmlElement() : std::move(document_.children.front());
  }

private:
  [[noreturn]] void fail(const std::string& what) const
  {
    failFormat(fmt::format("XML line {}: {}", lineOf(parser_), what), kDamagedCure);
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
    open_.size() > kMostXmlDepth
      ? fail(fmt::format("more than {} XML elements inside each other", kMostXmlDepth))
      : void();
    ++elements_ > kMostXmlElements ? fail(fmt::format("more than {} XML elements", kMostXmlElements))
                                   : void();
    // An open element's siblings come after it is closed, so that the addresses of open ones stay.
    XmlElement& element = open_.back()->children.emplace_back();
    element.name = name;
    element.begin = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_));
    element.end = element.begin + static_cast<std::size_t>(XML_GetCurrentByteCount(parser_));
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
  XmlElement document_;
  std::vector<XmlElement*> open_{ &document_ };
  std::size_t elements_ = 0;
  std::int64_t fed_ = 0; ///< Bytes so far.
  std::exception_ptr problem_;
};

struct FreeParser
{
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};

} // namespace

const XmlElement* XmlElement::child(std::string_view childName) const
{
  const auto found = std::find_if(
    children.begin(), children.end(), [&](const XmlElement& element) { return element.name == childName; });
  return found == children.end() ? nullptr : &*found;
}

std::string_view XmlElement::attribute(std::string_view attributeName) const
{
  const auto found = std::find_if(attributes.begin(), attributes.end(),
    [&](const auto& attribute) { return attribute.first == attributeName; });
  return found == attributes.end() ? std::string_view() : found->second;
}

std::string_view XmlElement::textOf(std::string_view childName) const
{
  const XmlElement* found = child(childName);
  return found ? found->trimmedText() : std::string_view();
}

std::string_view XmlElement::trimmedText() const
{
  const auto first = std::find_if_not(text.begin(), text.end(), isSpace);
  const auto last = std::find_if_not(text.rbegin(), text.rend(), isSpace).base();
  return first == text.end() ? std::string_view()
                             : std::string_view(text).substr(static_cast<std::size_t>(first - text.begin()),
                                 static_cast<std::size_t>(last - first));
}

void forEachElement(const XmlElement& root, const std::function<void(const XmlElement&)>& visit)
{
  visit(root);
  for (const XmlElement& child : root.children)
  {
    forEachElement(child, visit);
  }
}

XmlElement parseXml(const std::function<std::string_view()>& next, bool wantsTexts, XmlPart part)
{
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeParser> parser(XML_ParserCreate(nullptr));
  if (!parser)
  {
    throw std::bad_alloc();
  }
  TreeBuilder builder(parser.get(), wantsTexts);
  for (std::string_view piece = next(); !piece.empty(); piece = next())
  {
    builder.feed(piece, false);
  }
  part == XmlPart::Whole ? builder.feed({}, true) : void();
  return builder.takeRoot();
}

} // namespace pointhaptics::io
