#include "vtkHapticOverlay.h"

#include "vtkCoordinate.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkStdString.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkWindow.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

vtkStandardNewMacro(vtkHapticOverlay);

namespace
{

constexpr int kLargestHelp = 16;
/// Least font of the help where all lines are shown at once: a smaller one is not read.
constexpr int kReadableHelp = 9;
/// Font of a help page, where not all lines fit at once, and the least where the page is too wide for the
/// window.
constexpr int kPageFont = 12;
constexpr int kSmallestHelp = 7;
/// Letters of a line of the help, at least: the longest key and a little of what it does.
constexpr std::size_t kNarrowest = 16;
/// Lines of the plate beside the list: margins, and the number of the page.
constexpr std::size_t kPlateLines = 2;
constexpr std::size_t kFooterLines = 2;
/// Part of the renderer that the list of keys may take.
constexpr double kHelpPart = 0.98;
/// Opacity of plates.
constexpr double kTextPlate = 0.6;
constexpr double kHelpPlate = 0.92;

void styleText(vtkTextProperty* text, int size, double plateOpacity)
{
  text->SetFontSize(size);
  text->SetColor(0.08, 0.08, 0.10);
  text->SetBackgroundColor(1.0, 1.0, 1.0);
  text->SetBackgroundOpacity(plateOpacity);
  text->SetLineSpacing(1.15);
}

std::vector<std::string> linesOf(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

std::size_t longestOf(const std::vector<std::string>& lines)
{
  std::size_t longest = 0;
  for (const std::string& line : lines)
  {
    longest = std::max(longest, line.size());
  }
  return longest;
}

/// Two blanks between the columns of @p line.
std::string withoutColumns(const std::string& line)
{
  std::string result;
  for (const char letter : line)
  {
    const bool isWide = letter == ' ' && result.size() > 1 && result.compare(result.size() - 2, 2, "  ") == 0;
    result.append(isWide ? 0 : 1, letter);
  }
  return result;
}

/// Lines of one length: centred as a block, their columns stay in line; with a margin around.
std::string padded(const std::vector<std::string>& lines)
{
  const std::size_t longest = longestOf(lines);
  std::string result(longest + 4, ' ');
  for (const std::string& line : lines)
  {
    result += "\n  " + line + std::string(longest - line.size() + 2, ' ');
  }
  return result + "\n" + std::string(longest + 4, ' ');
}

void placeCorner(vtkTextActor* actor, bool right, bool top)
{
  styleText(actor->GetTextProperty(), 15, kTextPlate);
  right ? actor->GetTextProperty()->SetJustificationToRight()
        : actor->GetTextProperty()->SetJustificationToLeft();
  top ? actor->GetTextProperty()->SetVerticalJustificationToTop()
      : actor->GetTextProperty()->SetVerticalJustificationToBottom();
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(right ? 0.988 : 0.012, top ? 0.985 : 0.015);
  actor->VisibilityOff();
}

/// The @p most lines from @p first on; the first one tells its group again, whose name only the group's first
/// line has.
std::vector<std::string> pageOf(const std::vector<std::string>& lines, std::size_t first, std::size_t most)
{
  std::vector<std::string> page(lines.begin() + std::ptrdiff_t(first),
    lines.begin() + std::ptrdiff_t(std::min(lines.size(), first + most)));
  std::size_t heading = first;
  while (heading > 0 && lines[heading].rfind(' ', 0) == 0)
  {
    --heading;
  }
  const std::string group = lines[heading].substr(0, lines[heading].find(' '));
  if (heading < first && page[0].find_first_not_of(' ') > group.size())
  {
    page[0].replace(0, group.size(), group);
  }
  return page;
}

/// Whole groups on the left, the others beside them.
std::vector<std::string> inTwoColumns(const std::vector<std::string>& lines)
{
  constexpr std::size_t kGap = 4;
  std::size_t split = (lines.size() + 1) / 2;
  std::size_t higher = lines.size();
  for (std::size_t i = 1; i < lines.size(); ++i)
  {
    if (!lines[i].empty() && lines[i].front() != ' ' && std::max(i, lines.size() - i) < higher)
    {
      split = i;
      higher = std::max(i, lines.size() - i);
    }
  }
  std::vector<std::string> left(lines.begin(), lines.begin() + std::ptrdiff_t(split));
  const std::vector<std::string> right = pageOf(lines, split, lines.size() - split);
  const std::size_t longest = longestOf(left);
  left.resize(std::max(left.size(), right.size()));
  for (std::size_t i = 0; i < right.size(); ++i)
  {
    left[i] += std::string(longest + kGap - left[i].size(), ' ') + right[i];
  }
  return left;
}

/// Bytes of a letter in UTF-8.
constexpr std::size_t kLongestLetter = 4;

/// Lines of at most @p longest bytes, 8 at least, broken at blanks, or within a word that is longer itself.
std::vector<std::string> wrapped(const std::vector<std::string>& lines, std::size_t longest)
{
  std::vector<std::string> result;
  for (std::string rest : lines)
  {
    while (rest.size() > longest)
    {
      std::size_t end = rest.rfind(' ', longest);
      const bool atBlank = end != std::string::npos && end > longest / 3;
      end = atBlank ? end : longest;
      while (!atBlank && end + kLongestLetter > longest &&
        (static_cast<unsigned char>(rest[end]) & 0xC0U) == 0x80U)
      {
        --end; // not within a character of UTF-8
      }
      result.push_back(rest.substr(0, end));
      rest = "  " + rest.substr(end + (atBlank ? 1 : 0));
    }
    result.push_back(rest);
  }
  return result;
}

/// At most @p most lines, but two at least: the first ones, and the last, which names the key of the help.
std::string firstOf(std::vector<std::string> lines, std::size_t most)
{
  if (lines.size() > most)
  {
    lines.erase(lines.begin() + std::ptrdiff_t(std::max<std::size_t>(2, most) - 2), lines.end() - 1);
    lines.insert(lines.end() - 1, "...");
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

} // namespace

vtkHapticOverlay::vtkHapticOverlay()
{
  placeCorner(this->Blocks[StatusBlock].actor, false, true);
  placeCorner(this->Blocks[PanelBlock].actor, true, true);
  placeCorner(this->Blocks[DetailBlock].actor, false, false);
  vtkTextActor* help = this->Blocks[HelpBlock].actor;
  styleText(help->GetTextProperty(), kLargestHelp, kHelpPlate);
  help->GetTextProperty()->SetFontFamilyToCourier();
  help->GetTextProperty()->SetJustificationToCentered();
  help->GetTextProperty()->SetVerticalJustificationToCentered();
  help->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  help->SetPosition(0.5, 0.5);
  help->VisibilityOff();
}

vtkHapticOverlay::~vtkHapticOverlay() = default;

/// Before every render: the largest font with which all lines are seen, in one column or two, else a page of
/// them.
void vtkHapticOverlay::FitHelp()
{
  const int* size = this->Renderer->GetSize();
  const int dots = this->Renderer->GetVTKWindow() ? this->Renderer->GetVTKWindow()->GetDPI() : 0;
  const bool fits = size[0] == this->FittedTo[0] && size[1] == this->FittedTo[1] && dots == this->FittedTo[2];
  if (fits || !this->GetHelpVisibility() || size[0] < 1 || size[1] < 1)
  {
    return;
  }
  std::copy(size, size + 2, this->FittedTo);
  this->FittedTo[2] = dots;
  vtkTextActor* help = this->Blocks[HelpBlock].actor;
  const std::vector<std::string> lines = linesOf(this->GetHelp());
  this->HelpPages = 1;
  const std::string texts[2] = { padded(inTwoColumns(lines)), padded(lines) };
  int fonts[2] = { 0, 0 };
  for (int i = 0; i < 2; ++i)
  {
    fonts[i] =
      this->FitHelpFont(texts[i], kLargestHelp, kReadableHelp, kHelpPart * size[0], kHelpPart * size[1]);
  }
  if (fonts[0] > fonts[1])
  {
    help->SetInput(texts[0].c_str());
    help->GetTextProperty()->SetFontSize(fonts[0]);
  }
  else if (fonts[1] == 0)
  {
    this->FitHelpPage(lines, kHelpPart * size[0], kHelpPart * size[1]);
  }
}

/// Sets @p text in the largest font from @p smallest to @p largest with which its plate is no larger. 0:
/// none.
int vtkHapticOverlay::FitHelpFont(
  const std::string& text, int largest, int smallest, double width, double height)
{
  vtkTextActor* help = this->Blocks[HelpBlock].actor;
  vtkTextRenderer* texts = vtkTextRenderer::GetInstance();
  vtkWindow* window = this->Renderer->GetVTKWindow();
  help->SetInput(text.c_str());
  // To measure is to draw: the smallest font tells about how large one fits.
  const auto room = [&](int font)
  {
    help->GetTextProperty()->SetFontSize(font);
    int box[4] = {};
    const bool isMeasured =
      texts->GetBoundingBox(help->GetTextProperty(), vtkStdString(text), box, window ? window->GetDPI() : 72);
    return isMeasured ? std::min(width / (box[1] - box[0] + 1), height / (box[3] - box[2] + 1)) : 0.0;
  };
  const double most = room(smallest);
  int font = std::min(largest, int(smallest * most) + 1);
  while (font > smallest && room(font) < 1.0)
  {
    --font;
  }
  help->GetTextProperty()->SetFontSize(std::max(font, smallest));
  return most < 1.0 ? 0 : font;
}

/// Fills the page with as many of @p all, the lines of the help, as fit in a font that is read well. In a
/// narrow window the columns give way.
void vtkHapticOverlay::FitHelpPage(const std::vector<std::string>& all, double width, double height)
{
  constexpr double kAnyHeight = std::numeric_limits<double>::max();
  std::vector<std::string> lines = all;
  if (this->FitHelpFont(padded(lines), kPageFont, kSmallestHelp, width, kAnyHeight) == 0)
  {
    std::transform(all.begin(), all.end(), lines.begin(), withoutColumns);
    const std::vector<std::string> whole = lines;
    std::size_t longest = longestOf(lines);
    while (this->FitHelpFont(padded(lines), kPageFont, kSmallestHelp, width, kAnyHeight) == 0 &&
      longest > kNarrowest)
    {
      longest -= 2;
      lines = wrapped(whole, longest);
    }
  }
  double needed[2] = { 0.0, 0.0 };
  this->Blocks[HelpBlock].actor->GetSize(this->Renderer, needed);
  const auto room = std::size_t(height * double(lines.size() + kPlateLines) / needed[1]);
  const std::size_t most = std::max(room, kPlateLines + kFooterLines + 1) - kPlateLines - kFooterLines;
  this->HelpPages = int((lines.size() + most - 1) / most);
  this->HelpPage = std::min(this->HelpPage, this->HelpPages - 1);
  std::vector<std::string> page = pageOf(lines, std::size_t(this->HelpPage) * most, most);
  const std::string next = this->HelpPage + 1 < this->HelpPages ? ": next" : ": close";
  page.push_back("");
  page.push_back("page " + std::to_string(this->HelpPage + 1) + " of " + std::to_string(this->HelpPages) +
    (this->HelpKey.empty() ? "" : "    " + this->HelpKey + next));
  this->Blocks[HelpBlock].actor->SetInput(padded(page).c_str());
}

bool vtkHapticOverlay::IsBlockShown(int block) const
{
  return block == HelpBlock ? this->GetHelpVisibility()
                            : this->TextVisibility && !this->Blocks[block].text.empty();
}

void vtkHapticOverlay::MeasureBlock(int block, int font, double width, int lines, double size[2])
{
  constexpr std::size_t kShortest = 8;
  vtkTextActor* actor = this->Blocks[block].actor;
  if (block == HelpBlock)
  {
    this->FitHelp();
    actor->GetSize(this->Renderer, size);
    return;
  }
  actor->GetTextProperty()->SetFontSize(font);
  const std::vector<std::string> all = linesOf(this->Blocks[block].text);
  std::size_t longest = std::max(kShortest, longestOf(all));
  const std::size_t most = std::size_t(std::max(1, lines));
  actor->SetInput(firstOf(all, most).c_str());
  actor->GetSize(this->Renderer, size);
  // Letters differ in width: a little shorter until it fits.
  while (size[0] > width && longest > kShortest)
  {
    longest = std::max(kShortest, std::min(longest - 1, std::size_t(double(longest) * width / size[0])));
    actor->SetInput(firstOf(wrapped(all, longest), most).c_str());
    actor->GetSize(this->Renderer, size);
  }
}

void vtkHapticOverlay::PlaceBlock(int block, double left, double bottom)
{
  vtkTextActor* actor = this->Blocks[block].actor;
  double box[4];
  actor->GetBoundingBox(this->Renderer, box);
  actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  actor->SetPosition(left - box[0], bottom - box[2]);
  actor->VisibilityOn();
}

/// Empty hides it. True: it is another text than before.
bool vtkHapticOverlay::SetText(int block, const std::string& text)
{
  TextBlock& shown = this->Blocks[block];
  if (text == shown.text)
  {
    return false;
  }
  shown.text = text;
  shown.actor->SetInput(text.c_str());
  shown.actor->SetVisibility(this->IsBlockShown(block));
  return true;
}

void vtkHapticOverlay::SetHelp(const std::string& text, const std::string& key)
{
  this->Blocks[HelpBlock].text = text;
  this->HelpKey = key;
  this->Blocks[HelpBlock].actor->SetInput(padded(linesOf(text)).c_str());
  this->FittedTo[0] = 0;
}

bool vtkHapticOverlay::ShowNextHelpPage()
{
  if (!this->GetHelpVisibility() || this->HelpPage + 1 >= this->HelpPages)
  {
    return false;
  }
  ++this->HelpPage;
  this->FittedTo[0] = 0;
  return true;
}

void vtkHapticOverlay::SetHelpVisibility(bool visible)
{
  this->Blocks[HelpBlock].actor->SetVisibility(visible);
  this->HelpPage = 0;
  this->HelpPages = 1;
  this->FittedTo[0] = 0;
}

void vtkHapticOverlay::SetTextVisibility(bool visible)
{
  this->TextVisibility = visible;
  for (const int block : { StatusBlock, PanelBlock, DetailBlock })
  {
    this->Blocks[block].actor->SetVisibility(this->IsBlockShown(block));
  }
}

void vtkHapticOverlay::SetOpaque(bool opaque)
{
  this->Opaque = opaque;
  for (TextBlock& block : this->Blocks)
  {
    const double usual = &block == &this->Blocks[HelpBlock] ? kHelpPlate : kTextPlate;
    block.actor->GetTextProperty()->SetBackgroundOpacity(opaque ? 1.0 : usual);
  }
}

void vtkHapticOverlay::AddTo(vtkRenderer* renderer)
{
  this->Renderer = renderer;
  this->FittedTo[0] = 0;
  this->Fitting.follow(renderer);
  for (TextBlock& block : this->Blocks)
  {
    renderer->AddActor2D(block.actor);
  }
}
