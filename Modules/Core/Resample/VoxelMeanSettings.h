/// @file
/// Settings of a resampling, as a plain struct: the properties of vtkVoxelMeanResampler, input and transform
/// aside.
#pragma once

#include "Core/Base/Lattice.h"
#include "Core/Base/SettingsMembers.h"
#include "Core/Resample/Representative.h"
#include "Core/Simd/InstructionSet.h"

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
  bool computeCovariance = false;                                 ///< Six second moments a voxel.
  bool passAttributes = true;                                     ///< Average the arrays of the points.
  std::set<std::string> categoricalArrays = { "Classification" }; ///< Most frequent value instead of a mean.
  Representative representative = Representative::Mean;           ///< What stands for the points of a voxel.
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
      settingsMember("representative", &S::representative),
      settingsMember("minimumPointsPerVoxel", &S::minimumPointsPerVoxel),
      settingsMember("computeVoxelIndex", &S::computeVoxelIndex),
      settingsMember("keepOriginalPointIds", &S::keepOriginalPointIds),
      settingsMember("usePointIndex", &S::usePointIndex),
      settingsMember("instructionSet", &S::instructionSet));
  }
};
static_assert(listsEveryMember<VoxelMeanSettings>());

} // namespace pointhaptics
