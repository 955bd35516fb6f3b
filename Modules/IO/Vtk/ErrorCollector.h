/// @file
/// Catches the messages of VTK objects that would otherwise be printed.
#pragma once

#include "vtkCommand.h"

#include <string>

namespace pointhaptics::io
{

/// Observer of ErrorEvent and WarningEvent: keeps the first error's own words, prints nothing.
class ErrorCollector : public vtkCommand
{
public:
  static ErrorCollector* New() { return new ErrorCollector; }
  void Execute(vtkObject* caller, unsigned long event, void* callData) override;
  const std::string& first() const { return first_; }

private:
  std::string first_;
};

} // namespace pointhaptics::io
