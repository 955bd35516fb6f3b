/// @file
/// The options of `pointhaptics feel`.
#pragma once

#include "Options/BandwidthOptions.h"
#include "Options/FalconOptions.h"
#include "Options/LatticeOptions.h"

#include "Haptics/HapticParameters.h"

#include <string>

namespace CLI
{
class App;
}

namespace pointhaptics
{
namespace app
{

struct FeelOptions
{
  std::string file;
  std::string path;
  std::string output;
  LatticeOptions lattice;
  BandwidthOptions bandwidth;
  HapticParameters parameters;
  std::string device =
    "none"; ///< none: the hand is where the path says; simulated: it is pulled there; falcon.
  FalconOptions falcon;
  double seconds = 0.0; ///< Falcon: of touch; 0: until a stop signal.
  double rateHz = 1000.0;
  bool noCovariance = false;
  bool raw = false;
  bool json = false;

  /// Adds the options to @p command; bad values end the parse with a usage error.
  void addTo(CLI::App& command);
  /// What can only be said once all options are known: the preset's gains, mu_s where only mu_d is given.
  /// Ends in a usage error where they contradict each other; warns of one that has no effect.
  void complete();
  /// Whether scenes near the hand are as fine as the points there: nobody asked for other voxels, or none.
  bool refinesNearHand() const { return !this->lattice.hasVoxels() && !this->raw && !this->noCovariance; }

private:
  int method = 0;
  int preset = 0; ///< 0: not given.
  double staticFriction = -1.0;
  double dynamicFriction = -1.0;
};

} // namespace app
} // namespace pointhaptics
