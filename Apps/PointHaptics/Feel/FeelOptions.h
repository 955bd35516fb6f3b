/// @file
/// The options of `pointhaptics feel`.
#pragma once

#include "Options/BandwidthOptions.h"
#include "Options/FalconOptions.h"
#include "Options/LatticeOptions.h"
#include "Options/TouchOptions.h"

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
  TouchOptions touch;
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
  /// What can only be said once all options of @p command are known. Ends in a usage error where they
  /// contradict each other; warns of one that has no effect.
  void complete(const CLI::App& command);
  /// Whether scenes near the hand are as fine as the points there: nobody asked for other voxels, or none.
  bool refinesNearHand() const { return !this->lattice.voxelsAreGiven && !this->raw && !this->noCovariance; }
};

} // namespace app
} // namespace pointhaptics
