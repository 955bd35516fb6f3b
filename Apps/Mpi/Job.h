/// @file
/// The processes that mpirun has started, and how they fail together.
#pragma once

#include "MpiRanks.h"

#include <vtkNew.h>

#include <string>

class vtkMPIController;

namespace pointhaptics::app
{

/// Lives as long as main(): starts and ends MPI.
class Job
{
public:
  Job(int* argc, char*** argv);
  /// Ends all processes at once where this one has not gone the whole way with the others: finish().
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  MpiRanks& ranks() { return ranks_; }
  bool isRoot() const { return ranks_.rank() == 0; }
  /// Whether no rank has a @p problem. Else the first one that has prints it as fail() does, and says which
  /// rank it is where not all have the same.
  bool agree(const std::string& command, const std::string& problem);
  /// Of the codes of all ranks the largest: what each is to end with. The last exchange of a job.
  int finish(int exitCode);

private:
  vtkNew<vtkMPIController> controller_;
  MpiRanks ranks_;
  bool isFinished_ = false;
};

} // namespace pointhaptics::app
