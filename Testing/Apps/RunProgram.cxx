#include "RunProgram.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pointhaptics
{
namespace apptest
{
namespace
{

std::string contentOf(const std::string& fileName)
{
  std::ifstream stream(fileName, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

void redirect(const std::string& fileName, int descriptor)
{
  const int file = open(fileName.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  dup2(file, descriptor);
  close(file);
}

} // namespace

CommandLine::CommandLine()
{
  std::string pattern = (std::filesystem::temp_directory_path() / "pointhaptics-test-XXXXXX").string();
  folder_ = mkdtemp(pattern.data()) ? pattern : std::string();
}

CommandLine::~CommandLine()
{
  std::error_code error;
  std::filesystem::remove_all(folder_, error);
  std::filesystem::remove_all(folder_ + ".out", error);
  std::filesystem::remove_all(folder_ + ".err", error);
}

pid_t CommandLine::start(const std::vector<std::string>& arguments, int output) const
{
  std::vector<char*> words = { const_cast<char*>(POINTHAPTICS_PROGRAM) };
  for (const std::string& argument : arguments)
  {
    words.push_back(const_cast<char*>(argument.c_str()));
  }
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0)
  {
    redirect(folder_ + ".out", STDOUT_FILENO);
    if (output >= 0)
    {
      dup2(output, STDOUT_FILENO);
    }
    redirect(folder_ + ".err", STDERR_FILENO);
    std::signal(SIGPIPE, SIG_DFL); // as a shell starts it
    if (chdir(folder_.c_str()) == 0)
    {
      execv(POINTHAPTICS_PROGRAM, words.data());
    }
    _exit(127);
  }
  return child;
}

Outcome CommandLine::run(const std::vector<std::string>& arguments) const
{
  return this->finish(this->start(arguments));
}

Outcome CommandLine::finish(pid_t child) const
{
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  const int exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return { exitCode, contentOf(folder_ + ".out"), contentOf(folder_ + ".err") };
}

std::string CommandLine::succeed(const std::vector<std::string>& arguments) const
{
  const Outcome outcome = this->run(arguments);
  EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  return outcome.output;
}

void CommandLine::refuse(
  int exitCode, const std::vector<std::string>& arguments, const std::vector<std::string>& parts) const
{
  const std::vector<std::string> before = this->files();
  const Outcome outcome = this->run(arguments);
  EXPECT_EQ(outcome.exitCode, exitCode) << outcome.errors;
  EXPECT_EQ(outcome.output, "");
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  EXPECT_EQ(outcome.errors.rfind("pointhaptics", 0), 0u) << outcome.errors;
  for (const std::string& part : parts)
  {
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << "no \"" << part << "\" in: " << outcome.errors;
  }
  EXPECT_EQ(this->files(), before) << "a failed command left files behind";
}

void CommandLine::write(const std::string& name, const std::string& content) const
{
  std::ofstream(folder_ + "/" + name, std::ios::binary) << content;
}

std::string CommandLine::read(const std::string& name) const
{
  return contentOf(folder_ + "/" + name);
}

bool CommandLine::exists(const std::string& name) const
{
  return std::filesystem::exists(folder_ + "/" + name);
}

std::vector<std::string> CommandLine::files() const
{
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
  {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

InputFrom::InputFrom(const std::string& path)
  : before_(::dup(STDIN_FILENO))
{
  const int file = ::open(path.c_str(), O_RDONLY);
  ::dup2(file, STDIN_FILENO);
  ::close(file);
}

InputFrom::~InputFrom()
{
  ::dup2(before_, STDIN_FILENO);
  ::close(before_);
}

Table parseTable(const std::string& text)
{
  std::istringstream lines(text);
  std::string line, cell;
  std::vector<std::string> names;
  std::getline(lines, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');)
  {
    names.push_back(cell);
  }
  Table table;
  while (std::getline(lines, line))
  {
    std::size_t column = 0;
    for (std::istringstream cells(line); std::getline(cells, cell, ',') && column < names.size(); ++column)
    {
      table[names[column]].push_back(std::strtod(cell.c_str(), nullptr));
    }
    EXPECT_EQ(column, names.size()) << line;
  }
  return table;
}

} // namespace apptest
} // namespace pointhaptics
