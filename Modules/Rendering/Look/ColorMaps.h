/// @file
/// The colours that stand for numbers.
#pragma once

#include "Core/Base/Vector3.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <string>
#include <vector>

class vtkLookupTable;

namespace pointhaptics
{

/// 256 colours from dark violet-blue through green to a yellow that still reads on a light background: even
/// steps of lightness, and also right for people who do not see red or green. The caller owns the result
/// (Delete()).
POINTHAPTICSRENDERING_EXPORT vtkLookupTable* newCloudColorMap();

/// Color map for a dark ground, of eight steps from blue to a pale red. The caller owns the result
/// (Delete()).
POINTHAPTICSRENDERING_EXPORT vtkLookupTable* newGroundColorMap();
/// Red, green and blue, 0 to 1, at @p position 0 to 1 of newGroundColorMap().
POINTHAPTICSRENDERING_EXPORT Vec3 groundColor(double position);

/// The names of newColorMap(), in the order that a key goes through them. auto: newGroundColorMap(); viridis
/// and cividis: even steps of lightness, the latter seen alike by those who do not tell red from green;
/// greys; cool-warm: blue and red on both sides of a pale middle (K. Moreland, Diverging Color Maps for
/// Scientific Visualization, 2009); rainbow.
POINTHAPTICSRENDERING_EXPORT const std::vector<std::string>& colorMapNames();

/// 256 colours over 0 to 1, grey where a number is NaN. @p name: one of colorMapNames(); auto where it is
/// not. The caller owns the result (Delete()).
POINTHAPTICSRENDERING_EXPORT vtkLookupTable* newColorMap(const std::string& name);

} // namespace pointhaptics
