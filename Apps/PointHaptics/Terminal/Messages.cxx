#include "Terminal/Messages.h"

#include "Terminal/StopSignals.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <utility>

#include <poll.h>
#include <unistd.h>

namespace pointhaptics::app
{
namespace
{

/// A message and what it quotes from a file may hold line breaks; the user gets one line.
std::string oneLine(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  const std::size_t end = text.find_last_not_of(' ');
  return end == std::string::npos ? std::string() : text.substr(0, end + 1);
}

/// "ERROR: In file.cxx, line 12\nvtkFoo (0x1234): what happened\n\n" without all that comes before "what
/// happened".
std::string sentenceOf(const std::string& text)
{
  std::size_t begin = 0;
  if (text.rfind("ERROR: In ", 0) == 0 || text.rfind("Warning: In ", 0) == 0)
  {
    const std::size_t line = text.find('\n');
    begin = line == std::string::npos ? 0 : line + 1;
  }
  if (text.compare(begin, 3, "vtk") == 0)
  {
    const std::size_t address = text.find("): ", begin);
    begin = address == std::string::npos ? begin : address + 3;
  }
  return oneLine(text.substr(begin));
}

class MessageCollector : public vtkOutputWindow
{
public:
  static MessageCollector* New();
  vtkTypeMacro(MessageCollector, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { this->Keep(this->Errors, text); }
  void DisplayWarningText(const char* text) override { this->Keep(this->Warnings, text); }
  void DisplayGenericWarningText(const char* text) override { this->Keep(this->Warnings, text); }
  void DisplayDebugText(const char*) override {}

  using Messages = std::vector<std::string>;
  static Messages Take(Messages MessageCollector::*kind)
  {
    auto* own = MessageCollector::SafeDownCast(vtkOutputWindow::GetInstance());
    Messages taken;
    if (own)
    {
      const std::lock_guard<std::mutex> lock(own->Mutex);
      taken.swap(own->*kind);
    }
    return taken;
  }

  Messages Errors;
  Messages Warnings;

private:
  void Keep(Messages& messages, const char* text)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (messages.size() < kCapacity)
    {
      messages.push_back(sentenceOf(text));
    }
  }

  static constexpr std::size_t kCapacity = 100;
  std::mutex Mutex;
};

vtkStandardNewMacro(MessageCollector);

struct KeptWarning
{
  std::string key; ///< Without numbers.
  std::string file;
  std::string text;
  int count = 0;
  bool isPrinted = false;
};

/// State of the program's messages.
struct Speech
{
  std::string program = "pointhaptics";
  std::string command;
  Verbosity verbosity = Verbosity::Usual;
  std::vector<KeptWarning> warnings;
  std::vector<std::pair<std::string, std::string>> shownAs;
  std::string firstError;
  bool isOutputTaken = false;
  bool promisesJson = false;

  std::string name() const { return program + (command.empty() ? "" : " ") + command; }
};

Speech& speech()
{
  static Speech state;
  return state;
}

constexpr int kBrokenPipe = 128 + SIGPIPE; ///< As a shell counts it.

bool isReaderGone()
{
  struct pollfd output = { STDOUT_FILENO, 0, 0 };
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/// How many letters are to be changed, left out, added or swapped.
std::size_t distance(const std::string& a, const std::string& b)
{
  std::vector<std::vector<std::size_t>> table(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
  {
    for (std::size_t j = 0; j <= b.size(); ++j)
    {
      if (i == 0 || j == 0)
      {
        table[i][j] = i + j;
        continue;
      }
      table[i][j] = std::min(
        { table[i - 1][j] + 1, table[i][j - 1] + 1, table[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1) });
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      {
        table[i][j] = std::min(table[i][j], table[i - 2][j - 2] + 1);
      }
    }
  }
  return table[a.size()][b.size()];
}

std::string lowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Text by which warnings are counted: two that differ only in a number outside quotation marks are one.
std::string withoutNumbers(const std::string& text)
{
  std::string result;
  bool isQuoted = false;
  const auto isLetter = [&](std::size_t i)
  { return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0; };
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const bool isMark = text[i] == '\'' && !(isLetter(i - 1) && isLetter(i + 1)); // "PCL's" has none
    isQuoted = isQuoted != isMark;
    const bool isNumber = std::isdigit(static_cast<unsigned char>(text[i])) != 0 || text[i] == '.';
    result += isNumber && !isQuoted ? "" : text.substr(i, 1);
  }
  return result;
}

/// Keeps the first error for printPromisedJson(), too.
void printError(const std::string& speaker, const std::string& message, const std::string& end)
{
  const std::string line = shownLine(message);
  speech().firstError = speech().firstError.empty() ? line : speech().firstError;
  printNow(stderr, fmt::format("{}: {}{}\n", speaker, line, end));
}

} // namespace

void nameProgram(const std::string& name)
{
  speech().program = name;
}

void nameCommand(const std::string& name)
{
  speech().command = name;
  endCleanlyOnAbort(speech().name());
}

int failStandardOutput(int error)
{
  return isReaderGone()
    ? kBrokenPipe
    : fail(fmt::format("the standard output cannot be written{}{}; check the space left, and who reads it",
        error == 0 ? "" : ": ", error == 0 ? "" : std::strerror(error)));
}

int fail(const std::string& message)
{
  if (message.find(std::strerror(EPIPE)) != std::string::npos && isReaderGone())
  {
    return kBrokenPipe;
  }
  showKeptWarnings();
  printError(speech().name(), message, "");
  return kFailed;
}

int failUsage(const std::string& command, const std::string& message)
{
  printError(command, message, "; see " + command + " --help");
  return kUsage;
}

void warn(const std::string& message, const std::string& file)
{
  if (message.empty())
  {
    return;
  }
  auto& all = speech().warnings;
  const std::string key = withoutNumbers(message);
  auto known =
    std::find_if(all.begin(), all.end(), [&](const KeptWarning& other) { return other.key == key; });
  known = known == all.end() ? all.insert(known, { key, file, message, 0, false }) : known;
  ++known->count;
}

void showKeptWarnings()
{
  for (KeptWarning& warning : speech().warnings)
  {
    if (!warning.isPrinted && speech().verbosity != Verbosity::Quiet)
    {
      const std::string file = warning.file.empty() ? "" : warning.file + ": ";
      const std::string count = warning.count > 1 ? fmt::format(" ({} times)", warning.count) : "";
      printNow(
        stderr, fmt::format("{}: warning: {}{}\n", speech().name(), shownLine(file + warning.text), count));
    }
    warning.isPrinted = true;
  }
}

void showAs(const std::string& path, const std::string& shown)
{
  speech().shownAs.emplace_back(path, shown);
}

std::string shownLine(const std::string& given)
{
  std::string text = oneLine(given);
  for (const auto& [path, shown] : speech().shownAs)
  {
    for (std::size_t at = 0; (at = text.find(path, at)) != std::string::npos; at += shown.size())
    {
      text.replace(at, path.size(), shown);
    }
  }
  return text;
}

void setVerbosity(Verbosity verbosity)
{
  speech().verbosity = verbosity;
}

void say(const std::string& message, const std::string& label)
{
  if (speech().verbosity == Verbosity::Verbose)
  {
    printNow(stderr, fmt::format("{}: {}\n", label.empty() ? speech().command : label, shownLine(message)));
  }
}

void takeStandardOutput()
{
  speech().isOutputTaken = true;
}

void printSummary(const std::string& line)
{
  if (speech().verbosity != Verbosity::Quiet && !speech().isOutputTaken)
  {
    fmt::print("{}\n", line);
  }
}

void promiseJson()
{
  speech().promisesJson = true;
}

void printPromisedJson(int exitCode)
{
  if (speech().promisesJson && exitCode != kSuccess)
  {
    printJson({ { "error", speech().firstError }, { "exit_code", exitCode } });
  }
}

std::string didYouMean(const std::string& given, const std::vector<std::string>& words)
{
  const std::size_t size = given.size();
  const auto nearestOf = [&](std::size_t most, const auto& partOf)
  {
    std::string nearest;
    for (const std::string& word : words)
    {
      const std::size_t d = distance(lowerCase(given), lowerCase(partOf(word)));
      if (d < most || (d == most && nearest.empty()))
      {
        nearest = word;
        most = d;
      }
    }
    return nearest;
  };
  // A third of the letters; else the beginning of a long word, a fifth of them.
  std::string nearest = nearestOf(std::max<std::size_t>(1, size / 3), [](const std::string& w) { return w; });
  for (const std::size_t length : { size, size + 1 })
  {
    const bool isLong = nearest.empty() && size > 2;
    nearest =
      isLong ? nearestOf(size / 5, [&](const std::string& w) { return w.substr(0, length); }) : nearest;
  }
  return nearest.empty() || given.empty() ? std::string() : fmt::format("; did you mean {}?", nearest);
}

std::string countOfPoints(std::int64_t count)
{
  return fmt::format("{} point{}", count, count == 1 ? "" : "s");
}

std::string ofThemInvalid(std::int64_t count)
{
  return count > 0 ? fmt::format(", {} of them NaN or infinite", count) : std::string();
}

void printNow(std::FILE* stream, const std::string& text) noexcept
{
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stream));
  static_cast<void>(std::fflush(stream));
}

std::string jsonText(const nlohmann::ordered_json& object, int indent)
{
  return object.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void printJson(const nlohmann::ordered_json& object)
{
  speech().promisesJson = false;
  fmt::print("{}\n", jsonText(object));
}

void printResult(bool asJson, const nlohmann::ordered_json& object, const std::string& summary)
{
  asJson ? printJson(object) : printSummary(summary);
}

void collectVtkMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<MessageCollector> window;
  vtkOutputWindow::SetInstance(window);
}

std::vector<std::string> takeVtkErrors()
{
  return MessageCollector::Take(&MessageCollector::Errors);
}

std::vector<std::string> takeVtkWarnings()
{
  return MessageCollector::Take(&MessageCollector::Warnings);
}

} // namespace pointhaptics::app
