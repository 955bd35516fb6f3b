#include "Progress.h"

#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Base/Host/StopRequest.h"
#include "FileProblem.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkNew.h"

#include <algorithm>

namespace pointhaptics::io
{

void reportProgress(vtkAlgorithm* algorithm, double fraction)
{
  algorithm->UpdateProgress(fraction);
  runSignalHandlers();
  if (shallStop(algorithm, 0))
  {
    throw StoppedOnRequest();
  }
}

RelayedProgress::RelayedProgress(vtkAlgorithm* inner, vtkAlgorithm* outer, double begin, double end)
  : inner_(inner)
  , outer_(outer)
  , begin_(begin)
  , end_(end)
  , reached_(begin)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* self, void* fraction)
    {
      if (fraction)
      {
        static_cast<RelayedProgress*>(self)->relay(*static_cast<double*>(fraction));
      }
    });
  observer_ = inner_->AddObserver(vtkCommand::ProgressEvent, command);
}

RelayedProgress::~RelayedProgress()
{
  inner_->RemoveObserver(observer_);
}

void RelayedProgress::relay(double fraction)
{
  const double now = begin_ + (end_ - begin_) * std::clamp(fraction, 0.0, 1.0);
  if (now > reached_)
  {
    reached_ = now;
    outer_->UpdateProgress(now);
    runSignalHandlers();
  }
  // An exception must not pass through VTK: finish() throws it.
  if (outer_->GetAbortExecute())
  {
    inner_->SetAbortExecute(1);
  }
}

void RelayedProgress::finish()
{
  reportProgress(outer_, end_);
}

} // namespace pointhaptics::io
