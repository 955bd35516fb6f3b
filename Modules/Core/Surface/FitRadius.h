/// @file
/// The radius of a surface fit: long enough to average the noise, short enough that curvature adds no bias.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Surface/CellPyramid.h"
#include "Core/Surface/FitCells.h"
#include "Core/Surface/RadiusField.h"

#include <vector>

namespace pointhaptics
{

/// The minimum that a fit needs.
struct FitNeeds
{
  double points = 30.0;          ///< Sum of weights, 1 in the middle of the fit.
  double cells = 14.0;           ///< Sum of weights of cells, whatever they hold.
  double radiusInCells = 3.6;    ///< Least radius over the edge of a finest cell.
  double growth = 1.15;          ///< Factor from one radius tried against noise to the next.
  bool weighsCubic = true;       ///< True if fits with cubic terms are tried where the cloud is noisy.
  bool finerWhereShaped = false; ///< Use ofFineCells() where the residuals are shape and not noise; in
                                 ///< fitScales() use ofBarePoints() where those of the whole cloud are.

  /// Needs for cells about as fine as the points' spacing, the finest useful ones. Where noise calls for
  /// cubic terms, coarser cells serve better.
  static FitNeeds ofFineCells() { return { 16.0, 12.0, 2.4, 1.3, false, false }; }

  /// Needs for single points without noise: a few more than determine a fit. A cloud has no noise if a fit of
  /// 12 cells leaves less than 0.7 of a wide fit's residual, in the median over its nodes: noise leaves 0.85,
  /// shapes of scans 0.45 to 0.63.
  static FitNeeds ofBarePoints() { return { 10.0, 10.0, 2.0, 1.3, false, false }; }
};

/// The scale of fits at one position; metres.
struct FitScale
{
  double countRadius = 0.0; ///< Smallest radius that meets the needs.
  double radius = 0.0;      ///< Chosen radius: countRadius where the cloud is clean, more where it is noisy.
  double noise = 0.0;       ///< Standard deviation of the points about the surface.
  bool cubic = false;       ///< True if the radius is one for a fit with cubic terms.
  double left = 0.0;        ///< Fraction of the noise that a smaller fit leaves; 0 where none was tried.
};

/// Lepski's scale search at the cell mean @p seed: a longer radius is accepted while it agrees with every
/// shorter one within two of the shorter one's standard errors, in position and in both slopes. Where the
/// result is longer than the count radius by a third, the search is repeated with cubic terms, up to a tenth
/// longer than @p largest; they are used where that fit is better.
/// @p largestCount bounds the radius that is grown for points, @p largest the one grown against noise;
/// metres.
FitScale chooseFitRadius(const CellPyramid& pyramid, const Vec3& seed, double largestCount, double largest,
  FitCells& memory, const FitNeeds& needs = {});

/// Runs chooseFitRadius at each cell of the field's node level, and takes medians of the neighbours against
/// outliers, as the radius and gate of the surface fit. @param wanted the instructions to use, as far as this
/// machine has them; the result is the same.
std::vector<LocalScale> fitScales(const CellPyramid& pyramid, double largestCount, double largest,
  const Executor& executor = {}, const FitNeeds& needs = {},
  InstructionSet wanted = InstructionSet::Automatic);

} // namespace pointhaptics
