#include "Terminal/StandardStreams.h"

#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace pointhaptics::app
{
namespace
{

constexpr std::size_t kBlock = std::size_t{ 1 } << 20;

struct Descriptor
{
  const int number;
  ~Descriptor() { ::close(this->number); } // -1 fails
};

/// Waits, as a read cannot be ended by a signal that restarts it. False: a signal came.
bool waitFor(int descriptor, short events)
{
  struct pollfd one = { descriptor, events, 0 };
  while (!stopIsRequested() && ::poll(&one, 1, -1) < 0 && errno == EINTR)
  {
  }
  return !stopIsRequested();
}

/// False: errno says why, or a signal came.
bool copyAll(int from, int to)
{
  std::vector<char> block(kBlock);
  while (waitFor(from, POLLIN))
  {
    const ssize_t got = ::read(from, block.data(), block.size());
    if (got == 0)
    {
      return true;
    }
    if (got < 0 && errno != EINTR && errno != EAGAIN)
    {
      return false;
    }
    for (ssize_t done = 0; done < got;)
    {
      if (!waitFor(to, POLLOUT))
      {
        return false;
      }
      const ssize_t put = ::write(to, block.data() + done, static_cast<std::size_t>(got - done));
      if (put < 0 && errno != EINTR && errno != EAGAIN)
      {
        return false;
      }
      done += put > 0 ? put : 0;
    }
  }
  return false;
}

std::string reason()
{
  return stopIsRequested() ? "stopped on request; start it again"
                           : std::string(std::strerror(errno)) + "; check the pipe and the space in TMPDIR";
}

} // namespace

TemporaryFolder::TemporaryFolder()
{
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "pointhaptics-XXXXXX").string();
  if (error || !::mkdtemp(name.data()))
  {
    throw Failure(std::string("no temporary folder can be made: ") +
      (error ? error.message() : std::strerror(errno)) + "; set TMPDIR to one with space");
  }
  folder_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void copyInput(const std::string& from, const std::string& path)
{
  rememberStopSignals();
  const Descriptor source{ from.empty() ? ::dup(STDIN_FILENO) : ::open(from.c_str(), O_RDONLY | O_CLOEXEC) };
  const Descriptor file{ ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600) };
  const bool isCopied = source.number >= 0 && file.number >= 0 && copyAll(source.number, file.number);
  require(
    isCopied, (from.empty() ? "standard input" : from) + ": cannot be read into " + path + ": " + reason());
}

void copyToStandardOutput(const std::string& path)
{
  const Descriptor file{ ::open(path.c_str(), O_RDONLY | O_CLOEXEC) };
  const bool isCopied = file.number >= 0 && copyAll(file.number, STDOUT_FILENO);
  require(isCopied, "standard output cannot be written: " + reason());
}

} // namespace pointhaptics::app
