/// @file
/// The grid of 32-bit integers on which LAS stores coordinates.
#pragma once

#include "Bytes/StridedCopy.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics::io
{

/// The grid of the file that a cloud came from.
struct WantedGrid
{
  double scale = 0.0; ///< 0: there is none.
  double offset = 0.0;
  double extent = 0.0;   ///< Extent of the written cloud along its longest axis.
  double forced = 0.0;   ///< The step that the user asked for; 0: none.
  double usual = 0.0001; ///< The step where nothing tells another one.
};

/// One axis: coordinate = scale * integer + offset.
struct LasGrid
{
  double scale = 1.0;
  double offset = 0.0;
  std::vector<std::int32_t> integers;
  /// Largest error of the coordinates that a reader gets: at most half a step, but for the digits of doubles.
  double largestError = 0.0;
  /// True if coordinates differ by more than their last digits; floats are read as floats.
  bool rounds = false;

  /// Puts the @p count coordinates of @p column on the first of these grids that can be had:
  /// - one of the forced steps: a FileProblem where they are too small to span the coordinates;
  /// - one that gives each coordinate back bit for bit: the wanted one, or one of whole decimals;
  /// - where none is wanted, one of whole decimals that gives them back but for the last digits of doubles,
  /// or
  ///   as the same floats;
  /// - steps of the wanted scale, about another offset where that must be. Not of a cloud that is shorter
  /// than
  ///   kFewestSteps of them: it was made smaller, and its points would fall together;
  /// - the usual steps; of a cloud shorter than kFewestSteps of them 10^5 to 10^6 for its length;
  /// - the finest power of ten, from 1e-290 on, whose steps span them.
  ///
  /// @pre all are finite.
  static LasGrid fit(ConstColumnView column, vtkIdType count, const WantedGrid& wanted);

  /// 0.1 mm in @p unit, at most, and 1 cm of longitude and latitude; metres where it is not known.
  static double usualStep(const std::string& unit, int axis);

  static constexpr double kFewestSteps = 1000.0;
};

} // namespace pointhaptics::io
