/// @file
/// The processes that mpirun has started; a failure of one ends all.
#pragma once

#include "MpiRanks.h"

#include <vtkNew.h>

#include <functional>

class vtkMPIController;

namespace pointhaptics::app
{

/// A rank has failed, and said so.
struct EndOfJob
{
};

/// Starts MPI and ends it with main().
class Job
{
public:
  Job(int* argc, char*** argv);
  /// Ends all processes at once if this one has not reached finish().
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  MpiRanks& ranks() { return ranks_; }
  bool isRoot() const { return ranks_.rank() == 0; }
  /// Does @p work on this rank. Where one throws a Failure rank 0 prints that of the first as fail() does,
  /// and says which rank it is where not all have the same. @throws EndOfJob on all ranks then.
  void attempt(const std::function<void()>& work);
  /// Returns the largest exit code of all ranks: each ends with it. The last exchange of a job.
  int finish(int exitCode);

private:
  vtkNew<vtkMPIController> controller_;
  MpiRanks ranks_;
  bool isFinished_ = false;
};

} // namespace pointhaptics::app
