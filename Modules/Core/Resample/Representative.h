/// @file
/// Which point stands for the points of a voxel.
#pragma once

namespace pointhaptics
{

/// Nearest points are chosen by their places in the lattice, which are quantized as VoxelResampler says
/// (2^-31 voxel at most), and distances computed from these in double: always in the same way, so that the
/// choice depends on the points alone, exactly where squared distances fit a double. Two points are equally
/// far from their mean, whatever rounding makes of it. Of several at the same distance the one with the
/// smallest x is chosen, then y, then z, then the smallest values of VoxelRequest::tieBreakers, then the
/// first.
enum class Representative
{
  Mean,
  NearestToMean,   ///< The point nearest to the mean of the voxel's points.
  NearestToCenter, ///< The point nearest to the centre of the voxel.
  Median,          ///< Coordinate by coordinate; of an even number the lower middle one.
};

/// A point of the input stands for each voxel.
inline bool keepsPoints(Representative representative)
{
  return representative == Representative::NearestToMean || representative == Representative::NearestToCenter;
}

} // namespace pointhaptics
