/// @file
/// Composite datasets at the filters' inputs. Private to Parallel.
#pragma once

#include <string>

class vtkDataObject;
class vtkInformation;
class vtkMultiProcessController;

namespace pointhaptics
{

/// For FillInputPortInformation(): where several processes share a cloud, a composite dataset comes as one
/// input. The pipeline would else update the filter once for each block that this process has; others have
/// other blocks, and would wait for it for ever.
void takeBlocksAtOnce(vtkInformation* port, vtkMultiProcessController* controller);

/// What is wrong with such an input, with the cure; empty for any other one.
std::string problemOfBlocks(vtkDataObject* input);

} // namespace pointhaptics
