/// @file
/// Options that are the same wherever a cloud is resampled or felt, a proxy radius computed, or a Falcon
/// used.
#pragma once

#include "Options/OptionParsing.h"

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "Devices/Falcon/FalconUpdates.h"
#include "Devices/PathUnits.h"
#include "Haptics/HapticParameters.h"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

class vtkVoxelMeanResampler;

namespace pointhaptics::app
{

/// Adds --unit, of the file's coordinates.
void addUnit(CLI::App& command, std::string& unit);
/// Adds --path-unit and --path-time-unit, of the numbers in the file of --path.
void addPathUnits(CLI::App& command, PathUnits& units);
/// These options, and --unit.
UnitNames unitOptions();

/// The transform's options as given; empty vectors mean "not given".
struct LatticeOptions
{
  VoxelMeanSettings voxels;      ///< With what was given.
  bool voxelsAreGiven = false;   ///< --dims or --voxel.
  std::vector<double> scale;     ///< 1 or 3.
  std::vector<double> rotate;    ///< 4: degrees, x, y, z.
  std::vector<double> translate; ///< 3.
  std::vector<double> matrix;    ///< 16, row by row; excludes scale, rotate and translate.
  std::string unit = "m";        ///< Unit of the file's coordinates, one of kLengthUnits.

  /// Adds the options to @p command; bad values end the parse with a usage error that names the cure.
  void addTo(CLI::App& command);
  /// translate * rotate * scale * unit, or matrix * unit.
  AffineTransform transform() const;
  /// Length of a unit of the file's coordinates, metres.
  double metresPerUnit() const;
  bool hasTransform() const;
  /// Whether lengths change by it.
  bool isScaled() const { return this->unit != "m" || !this->scale.empty() || !this->matrix.empty(); }
  /// --workspace; empty where it was not given.
  Bounds workspace() const;
  /// Sets the transform, where one was given, and the settings on @p resampler.
  void configure(vtkVoxelMeanResampler* resampler) const;
};

/// --neighbors --radius --rule --beta --r1 --r2
struct BandwidthOptions
{
  BandwidthSettings settings; ///< With what was given.

  /// Adds the options to @p command; bad values, r1 > r2 among them, end the parse with a usage error.
  void addTo(CLI::App& command);
};

/// Names of the methods on the command line.
const std::vector<std::pair<std::string, ProxyMethod>>& proxyMethods();

/// --method --preset --stiffness --damping --mu-s --mu-d
struct TouchOptions
{
  HapticParameters parameters; ///< With what was given.

  /// Adds the options to @p command; bad values end the parse with a usage error.
  void addTo(CLI::App& command);
  /// Completes values once all options of @p command are known: mu_s where only mu_d is given. Ends in a
  /// usage error where they contradict each other; warns of one that has no effect.
  void complete(const CLI::App& command);
};

/// Ends in a usage error where the force limit is beyond what a servo loop may push with. @p cure: another
/// cure than a lower limit, ", or ...".
void checkForceLimitOfDevices(const ContactParameters& contact, const std::string& cure);

/// Puts the members of @p contact in @p settings, by the names of their options.
void setContact(nlohmann::ordered_json& settings, const ContactParameters& contact);

/// For openProblem().
constexpr const char* kFirmwareOption = "--falcon-firmware FILE";

/// --falcon-firmware --max-force
struct FalconOptions
{
  std::string firmware;
  double maximumForce = 4.0;

  void addTo(CLI::App& command);
  /// The limit of the Falcon's force, where it is given, is one of what is felt without a Falcon too.
  void complete(const CLI::App& command, ContactParameters& contact) const;
  /// Its start ends at a remembered signal (StopSignals.h).
  FalconSettings settings() const;
};

} // namespace pointhaptics::app
