/// @file
/// The grid of 32-bit integers on which LAS stores coordinates.
#pragma once

#include "StridedCopy.h"

#include <cstdint>
#include <vector>

namespace pointhaptics::io
{

/// One axis: coordinate = scale * integer + offset.
struct LasGrid
{
  double scale = 1.0;
  double offset = 0.0;
  std::vector<std::int32_t> integers;
  double largestError = 0.0; ///< of what a reader gives back

  /// Puts the @p count coordinates of @p column on a grid that gives each of them back bit for bit where
  /// there is one: that of
  /// @p wantedScale and @p wantedOffset (the file the cloud came from; scale 0: none), or one of whole
  /// decimals. Otherwise on the finest one that spans them, with steps of a power of two. @pre all are
  /// finite.
  static LasGrid fit(ConstColumnView column, vtkIdType count, double wantedScale, double wantedOffset);
};

} // namespace pointhaptics::io
