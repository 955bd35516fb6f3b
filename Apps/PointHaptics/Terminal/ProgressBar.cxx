#include "Terminal/ProgressBar.h"

#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include <fmt/format.h>
#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include <unistd.h>

namespace pointhaptics::app
{
namespace
{

constexpr auto kProgressDelay = std::chrono::milliseconds(500);
constexpr auto kPeriod = std::chrono::milliseconds(100);
constexpr int kWidth = 40;

} // namespace

ProgressBar::ProgressBar(std::string label)
  : label_(std::move(label))
  , onTerminal_(isatty(STDERR_FILENO) == 1)
  , next_(Clock::now() + kProgressDelay)
{
}

ProgressBar::ProgressBar(std::string label, vtkAlgorithm* algorithm)
  : ProgressBar(std::move(label))
{
  algorithm_ = algorithm;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* self, void* fraction)
    {
      if (stopIsRequested())
      {
        static_cast<ProgressBar*>(self)->algorithm_->SetAbortExecute(1);
      }
      if (fraction)
      {
        static_cast<ProgressBar*>(self)->show(*static_cast<double*>(fraction));
      }
    });
  observer_ = algorithm->AddObserver(vtkCommand::ProgressEvent, command);
}

ProgressBar::~ProgressBar()
{
  if (algorithm_)
  {
    algorithm_->RemoveObserver(observer_);
  }
  if (drawn_)
  {
    printNow(stderr, "\r\033[K");
  }
}

void ProgressBar::show(double fraction)
{
  if (!onTerminal_ || Clock::now() < next_)
  {
    return;
  }
  next_ = Clock::now() + kPeriod;
  drawn_ = true;
  const double part = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(part * kWidth);
  printNow(stderr,
    fmt::format("\r{} [{:#<{}}{: >{}}] {:3.0f} %", label_, "", filled, "", kWidth - filled, 100.0 * part));
}

} // namespace pointhaptics::app
