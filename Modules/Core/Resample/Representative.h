/// @file
/// Which point stands for the points of a voxel.
#pragma once

namespace pointhaptics
{

/// Nearest points are chosen by the exact squared distances of the transformed points, which are rounded to
/// double and then to 2^-40 voxel (2^-56 times their number where a voxel has more than 2^16 points):
/// distances that are equal by symmetry, as those of two points from their mean, are equal here. Of several
/// at the same distance the one with the smallest x is chosen, then y, then z, then the smallest values of
/// VoxelRequest::tieBreakers, then the first.
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
