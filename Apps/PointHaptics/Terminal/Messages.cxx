#include "Terminal/Messages.h"

#include "Terminal/CommandLine.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <cstdio>
#include <mutex>

namespace pointhaptics
{
namespace app
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

  std::vector<std::string> TakeErrors() { return this->Take(this->Errors); }
  std::vector<std::string> TakeWarnings() { return this->Take(this->Warnings); }

protected:
  MessageCollector() = default;
  ~MessageCollector() override = default;

private:
  MessageCollector(const MessageCollector&) = delete;
  void operator=(const MessageCollector&) = delete;

  void Keep(std::vector<std::string>& messages, const char* text)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (messages.size() < kCapacity)
    {
      messages.push_back(sentenceOf(text));
    }
  }
  std::vector<std::string> Take(std::vector<std::string>& messages)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    std::vector<std::string> taken;
    taken.swap(messages);
    return taken;
  }

  static constexpr std::size_t kCapacity = 100;
  std::mutex Mutex;
  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

vtkStandardNewMacro(MessageCollector);

MessageCollector* collector()
{
  return MessageCollector::SafeDownCast(vtkOutputWindow::GetInstance());
}

std::string& programName()
{
  static std::string name = "pointhaptics";
  return name;
}

} // namespace

void nameProgram(const std::string& name)
{
  programName() = name;
}

int fail(const std::string& command, const std::string& message)
{
  printNow(stderr, fmt::format("{} {}: {}\n", programName(), command, oneLine(message)));
  return kFailed;
}

void warn(const std::string& command, const std::string& message)
{
  printNow(stderr, fmt::format("{} {}: warning: {}\n", programName(), command, oneLine(message)));
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

void printJson(const nlohmann::ordered_json& object)
{
  fmt::print("{}\n", object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void collectVtkMessages()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<MessageCollector> window;
  vtkOutputWindow::SetInstance(window);
}

std::vector<std::string> takeVtkErrors()
{
  MessageCollector* window = collector();
  return window ? window->TakeErrors() : std::vector<std::string>();
}

std::vector<std::string> takeVtkWarnings()
{
  MessageCollector* window = collector();
  return window ? window->TakeWarnings() : std::vector<std::string>();
}

} // namespace app
} // namespace pointhaptics
