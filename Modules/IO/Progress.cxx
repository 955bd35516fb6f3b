#include "Progress.h"

#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Base/Host/StopRequest.h"
#include "FileProblem.h"

#include "vtkAlgorithm.h"

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

} // namespace pointhaptics::io
