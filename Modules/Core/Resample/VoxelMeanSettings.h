/// @file
/// Settings of a resampling, as a plain struct: the properties of vtkVoxelMeanResampler, input and transform
/// aside.
#pragma once

#include "Core/Base/FieldNames.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/SettingsMembers.h"
#include "Core/Resample/Representative.h"
#include "Core/Simd/InstructionSet.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <tuple>

namespace pointhaptics
{

/// Type of the coordinates of means.
enum class PointsPrecision
{
  Single,
  Double,
  OfInput,
};

/// Ranges and meanings of the members are those of the properties of vtkVoxelMeanResampler.
struct VoxelMeanSettings
{
  LatticeSettings lattice = { LatticeSettings().dimensions, 0.0, true, defaultWorkspace() };
  PointsPrecision outputPointsPrecision = PointsPrecision::OfInput;
  bool computeCovariance = false; ///< Six second moments a voxel.
  bool passAttributes = true;     ///< Average the arrays of the points.
  /// Most frequent value instead of a mean: isCategorical().
  std::set<std::string> categoricalArrays{ std::begin(kLabelFields), std::end(kLabelFields) };
  bool exactCategoricalNames = false; ///< The names above mean themselves alone, letter by letter.
  Representative representative = Representative::Mean;      ///< What stands for the points of a voxel.
  int minimumPointsPerVoxel = 1;                             ///< Voxels with fewer are left out; at least 1.
  bool computeVoxelIndex = false;                            ///< One more output: the voxel of each point.
  bool keepOriginalPointIds = false;                         ///< Which point stands for each voxel.
  bool usePointIndex = true;                                 ///< Changes the cost only.
  InstructionSet instructionSet = InstructionSet::Automatic; ///< Changes the cost only.

  static constexpr auto members()
  {
    using S = VoxelMeanSettings;
    return std::make_tuple(settingsMember("lattice", &S::lattice),
      settingsMember("outputPointsPrecision", &S::outputPointsPrecision),
      settingsMember("computeCovariance", &S::computeCovariance),
      settingsMember("passAttributes", &S::passAttributes),
      settingsMember("categoricalArrays", &S::categoricalArrays),
      settingsMember("exactCategoricalNames", &S::exactCategoricalNames),
      settingsMember("representative", &S::representative),
      settingsMember("minimumPointsPerVoxel", &S::minimumPointsPerVoxel),
      settingsMember("computeVoxelIndex", &S::computeVoxelIndex),
      settingsMember("keepOriginalPointIds", &S::keepOriginalPointIds),
      settingsMember("usePointIndex", &S::usePointIndex),
      settingsMember("instructionSet", &S::instructionSet));
  }
};
static_assert(listsEveryMember<VoxelMeanSettings>());

/// Whether the array @p name holds labels.
inline bool isCategorical(const VoxelMeanSettings& settings, const std::string& name)
{
  return std::any_of(settings.categoricalArrays.begin(), settings.categoricalArrays.end(),
    [&](const std::string& each)
    { return settings.exactCategoricalNames ? each == name : isLabelField(name, each); });
}

} // namespace pointhaptics
