/// @file
/// Composites as inputs of filters for several processes. Private to Parallel.
#pragma once

#include <string>

class vtkDataObject;

namespace pointhaptics
{

/// Why filters for several processes refuse @p input; empty for one cloud.
std::string problemOfBlocks(vtkDataObject* input);

} // namespace pointhaptics
