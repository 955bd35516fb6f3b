/// @file
/// The ranks of a job on VTK's controllers.
#pragma once

#include "PointHapticsParallelModule.h"

#include "Core/Distributed/Ranks.h"

#include <cstdint>
#include <string>

class vtkDataObject;
class vtkMPIController;
class vtkMultiProcessController;

namespace pointhaptics
{

/// Messages of a vtkMPIController; any other controller, or none, is a job of one rank. The controller must
/// outlive it.
///
/// Every exchange is collective: a rank that ends without it must end the job (abortJob()), or the others
/// wait for it.
class POINTHAPTICSPARALLEL_EXPORT MpiRanks : public Ranks
{
public:
  explicit MpiRanks(vtkMultiProcessController* controller);

  int rank() const override;
  int size() const override;
  std::vector<std::string> exchange(std::vector<std::string> messages) override;
  /// Sent to other ranks by this one so far.
  std::int64_t bytesSent() const { return sent_; }

private:
  vtkMPIController* controller_;
  std::int64_t sent_ = 0;
};

/// Collective: the message of the first rank that has one, in front of it "rank 1 of 3: " where not all have
/// the same. Empty: none has.
POINTHAPTICSPARALLEL_EXPORT std::string firstMessage(Ranks& ranks, const std::string& own);
/// Why a filter of several ranks refuses @p input; empty for one cloud, and where there is one rank.
std::string problemOnRanks(vtkMultiProcessController* controller, vtkDataObject* input);

/// Ends all processes of an MPI job at once, this one with @p exitCode; without MPI this one alone. Does not
/// return.
[[noreturn]] POINTHAPTICSPARALLEL_EXPORT void abortJob(int exitCode);

} // namespace pointhaptics
