#include "BlocksOfInput.h"

#include "MpiRanks.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"

namespace pointhaptics
{

void takeBlocksAtOnce(vtkInformation* port, vtkMultiProcessController* controller)
{
  if (MpiRanks(controller).size() > 1)
  {
    port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  }
}

std::string problemOfBlocks(vtkDataObject* input)
{
  return vtkCompositeDataSet::SafeDownCast(input)
    ? "The input has blocks, and each process has others; merge them to one cloud first (Merge Blocks)."
    : std::string();
}

} // namespace pointhaptics
