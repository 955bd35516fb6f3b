/// @file
/// A few points far from all others: stray returns, fill values, faults of a scanner.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsIOModule.h" // For export macro

#include <cstdint>
#include <string>

class vtkPolyData;

namespace pointhaptics
{

class Ranks;

struct FarPoints
{
  std::int64_t count = 0; ///< 0: there are none.
  std::int64_t of = 0;    ///< Finite points of the cloud.
  Bounds others;          ///< Of the points that are not far; of all where none is.

  /// "1 of 3,001 points is far from all others".
  POINTHAPTICSIO_EXPORT std::string text() const;
  /// "-1,1,-1,1,-1,1": a box that holds the others, for --clip.
  POINTHAPTICSIO_EXPORT std::string clip() const;
};

/// One in @p mostPart points of @p cloud at most, and any number with a coordinate such as -9999 that stands
/// for no data or at exactly (0, 0, 0), without which its longest side is a tenth at most. Finite points lie
/// within @p bounds. Cost: a look at 10,000 points, and at all where they may have far ones.
/// One in a thousand may be left out unasked; more are worth a word.
POINTHAPTICSIO_EXPORT FarPoints findFarPoints(
  vtkPolyData* cloud, const Bounds& bounds, std::int64_t mostPart = 1000);

/// Collective: the same of a cloud of which each rank has a part, in its order. @param bounds of the own
/// part.
POINTHAPTICSIO_EXPORT FarPoints findFarPoints(
  vtkPolyData* part, const Bounds& bounds, Ranks& ranks, std::int64_t mostPart = 1000);

} // namespace pointhaptics
