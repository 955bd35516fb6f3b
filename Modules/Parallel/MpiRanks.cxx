#include "MpiRanks.h"

#include "vtkCompositeDataSet.h"
#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace pointhaptics
{
namespace
{

constexpr int kSizeTag = 7301;
constexpr int kMessageTag = 7302;
/// MPI counts bytes in an int.
constexpr std::size_t kMostAtOnce = std::size_t(1) << 30;

/// Calls send(offset, bytes) for pieces that MPI can count.
template <typename Function>
void inPieces(std::size_t bytes, Function&& send)
{
  for (std::size_t offset = 0; offset < bytes; offset += kMostAtOnce)
  {
    send(offset, int(std::min(kMostAtOnce, bytes - offset)));
  }
}

}

MpiRanks::MpiRanks(vtkMultiProcessController* controller)
  : controller_(vtkMPIController::SafeDownCast(controller))
{
}

int MpiRanks::rank() const
{
  return controller_ ? controller_->GetLocalProcessId() : 0;
}

int MpiRanks::size() const
{
  return controller_ ? controller_->GetNumberOfProcesses() : 1;
}

/// In rounds: in the n-th each rank sends to the n-th after it and receives from the n-th before, so that no
/// two send to the same one and no more than one message waits.
std::vector<std::string> MpiRanks::exchange(std::vector<std::string> messages)
{
  const int size = this->size();
  if (size == 1)
  {
    return messages;
  }
  std::vector<std::string> received(messages.size());
  received[std::size_t(this->rank())] = std::move(messages[std::size_t(this->rank())]);
  for (int step = 1; step < size; ++step)
  {
    const int to = (this->rank() + step) % size;
    const int from = (this->rank() + size - step) % size;
    const std::string& message = messages[std::size_t(to)];
    const auto bytes = vtkIdType(message.size());
    std::vector<vtkMPICommunicator::Request> requests(2 + message.size() / kMostAtOnce);
    std::size_t sends = 0;
    controller_->NoBlockSend(&bytes, 1, to, kSizeTag, requests[sends++]);
    inPieces(message.size(),
      [&](std::size_t offset, int count)
      { controller_->NoBlockSend(message.data() + offset, count, to, kMessageTag, requests[sends++]); });
    vtkIdType incoming = 0;
    controller_->Receive(&incoming, 1, from, kSizeTag);
    std::string& into = received[std::size_t(from)];
    into.resize(std::size_t(incoming));
    inPieces(into.size(),
      [&](std::size_t offset, int count)
      { controller_->Receive(into.data() + offset, vtkIdType(count), from, kMessageTag); });
    for (std::size_t r = 0; r < sends; ++r)
    {
      requests[r].Wait();
    }
    sent_ += bytes;
  }
  return received;
}

std::string firstMessage(Ranks& ranks, const std::string& own)
{
  const std::vector<std::string> messages = ranks.gather(own);
  const auto first =
    std::find_if(messages.begin(), messages.end(), [](const std::string& text) { return !text.empty(); });
  if (first == messages.end())
  {
    return {};
  }
  const bool isEverywhere =
    std::all_of(messages.begin(), messages.end(), [&](const std::string& text) { return text == *first; });
  return isEverywhere ? *first
                      : "rank " + std::to_string(first - messages.begin()) + " of " +
      std::to_string(ranks.size()) + ": " + *first;
}

std::string problemOnRanks(vtkMultiProcessController* controller, vtkDataObject* input)
{
  return MpiRanks(controller).size() > 1 && vtkCompositeDataSet::SafeDownCast(input)
    ? "The input has blocks, and each process has others; merge them to one cloud first (Merge Blocks)."
    : std::string();
}

void abortJob(int exitCode)
{
  int isInitialized = 0;
  MPI_Initialized(&isInitialized);
  if (isInitialized)
  {
    MPI_Abort(MPI_COMM_WORLD, exitCode);
  }
  std::_Exit(exitCode);
}

} // namespace pointhaptics
