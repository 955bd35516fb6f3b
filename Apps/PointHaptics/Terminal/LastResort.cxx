#include "Terminal/LastResort.h"

#include "Terminal/Messages.h"

#include "Core/Base/OutputFile.h"
#include "Core/Base/Status.h"

#include <csignal>
#include <exception>
#include <string>

#include <unistd.h>

namespace pointhaptics::app
{
namespace
{

/// Made before memory is short.
std::string lastWords;

/// abort() is called, not interrupted: what it finds is as whole as memory allows.
void endNow(int)
{
  OutputFile::discardAll();
  static_cast<void>(!::write(STDERR_FILENO, lastWords.data(), lastWords.size()));
  ::_exit(kFailed);
}

} // namespace

void endCleanlyOnAbort(const std::string& command)
{
  lastWords = "pointhaptics" + (command.empty() ? "" : " " + command) +
    ": the system gave no memory, or no OpenGL to a window; " + message(Status::OutOfMemory) +
    ", or look which graphics driver is missing (glxinfo)\n";
  std::signal(SIGABRT, endNow);
  std::set_terminate([] { endNow(SIGABRT); });
}

} // namespace pointhaptics::app
