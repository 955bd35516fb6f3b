/// @file
/// The bytes of an E57 file of doubles: no library that could write one is at hand.
#pragma once

#include <string>

class vtkPolyData;

namespace pointhaptics
{
namespace bench
{
namespace io
{

/// One scan: x y z as doubles, "intensity" as single floats and "RGB" as bytes, in packets of 64 kB. Costs
/// the size of the file three times in memory.
std::string asE57(vtkPolyData* cloud);

} // namespace io
} // namespace bench
} // namespace pointhaptics
