#include "BlocksOfInput.h"

#include "vtkCompositeDataSet.h"

namespace pointhaptics
{

std::string problemOfBlocks(vtkDataObject* input)
{
  return vtkCompositeDataSet::SafeDownCast(input)
    ? "The input has blocks, and each process has others; merge them to one cloud first (Merge Blocks)."
    : std::string();
}

} // namespace pointhaptics
