/// @file
/// Proxy radii at the nodes of a scene's fields.
#pragma once

#include "Core/Surface/FitRadius.h"
#include "Haptics/HapticScene.h"

#include <vector>

namespace pointhaptics
{

/// Finds one radius per cell of @p nodes: that of the point of @p input nearest to the cell's mean (ties: the
/// smaller index). It is taken from input.proxyRadii, or, where those are empty, computed by input.bandwidth
/// with input.counts for these points alone; the result is the same bit for bit. @p nodes is a level of a
/// pyramid built on the finite points of
/// @p input. Errors: those of input.bandwidth. Independent of @p executor.
/// @param uses where given, one per node: others than NodeUse::All get 0.
/// @pre proxyRadii or bandwidth is there.
Status nodeRadii(const CellPyramid::Level& nodes, const HapticSceneInput& input, std::vector<double>& radii,
  const Executor& executor, const std::vector<NodeUse>* uses = nullptr);

} // namespace pointhaptics
