/// @file
/// The colours that stand for numbers.
#pragma once

#include "PointHapticsRenderingModule.h"

#include <string>
#include <vector>

class vtkLookupTable;

namespace pointhaptics
{

/// The names of newColorMap(), in the order that a key goes through them. auto: newGroundColorMap(); viridis
/// and cividis: even steps of lightness, the latter seen alike by those who do not tell red from green;
/// greys; cool-warm: blue and red on both sides of a pale middle (K. Moreland, Diverging Color Maps for
/// Scientific Visualization, 2009); rainbow.
POINTHAPTICSRENDERING_EXPORT const std::vector<std::string>& colorMapNames();

/// 256 colours over 0 to 1, grey where a number is NaN. @p name: one of colorMapNames(); auto where it is
/// not. The caller owns the result (Delete()).
POINTHAPTICSRENDERING_EXPORT vtkLookupTable* newColorMap(const std::string& name);

} // namespace pointhaptics
