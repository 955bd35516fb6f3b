/// @file
/// A few points far from all others: stray returns, fill values, faults of a scanner.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{

class Ranks;

/// The points of a cloud that are far from all others, and the boxes with and without them.
struct FarPoints
{
  std::int64_t count = 0; ///< 0: there are none.
  std::int64_t of = 0;    ///< Finite points of the cloud.
  Bounds all;             ///< About all finite points.
  Bounds others;          ///< About the points that are not far; about all where none is.

  /// "1 of 3,001 points is far from all others".
  std::string text() const;
  /// "1 of 3,001 points is far from all others; lattice and picture leave it out, a workspace of 0,1,0,1,0,1
  /// takes it in".
  std::string note() const;
};

/// The points outside the core of a cloud: up to one in 20, anywhere, and any number at exactly (0, 0, 0) or
/// with a coordinate that stands for no data, such as -9999: many have it exactly, and it is far from others.
/// The core is at most a tenth as long as the whole. It is found on lattices of 32 cells, each about the core
/// that the coarser one showed: the fullest cell, and all that are connected with it, where a cell that has
/// less than 1 % of the points of one beside it is no connection. So thin surroundings that go on from the
/// core, as the outskirts of a scan, are part of it.
/// @param bounds of the transformed, finite points, all of them. Cost: a look at 1,000 points; where the
/// cloud may have far ones, at all of them for each lattice.
FarPoints findFarPoints(const PointView& points, const Bounds& bounds, const AffineTransform& transform = {});
/// Collective: the same of a cloud of which each rank has parts, in its order. What is counted are points of
/// all ranks, so that it does not matter how they are split. @param bounds of the own parts.
FarPoints findFarPoints(const std::vector<PointView>& parts, const Bounds& bounds, Ranks& ranks,
  const AffineTransform& transform = {});

/// Collective: the box for an automatic lattice of transformed points: about those that are not far, or about
/// all where voxels of a given size reach them all, as far ones make no other voxel coarser then.
/// @param bounds as above. @param note what FarPoints::note() says where some are left out, else empty.
Bounds boundsForLattice(const LatticeSettings& settings, const std::vector<PointView>& parts,
  const Bounds& bounds, Ranks& ranks, const AffineTransform& transform, std::string& note);

} // namespace pointhaptics
