/// @file
/// The options of `pointhaptics feel`.
#pragma once

#include "Clouds/Pipeline.h"
#include "Options/BandwidthOptions.h"
#include "Options/FalconOptions.h"
#include "Options/LatticeOptions.h"
#include "Options/TouchOptions.h"

#include "Devices/PathUnits.h"

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

class Files;

struct FeelOptions
{
  std::string file;
  ReadOptions reading;
  bool vertices = false; ///< Of a mesh its vertices are felt.
  std::string path;
  PathUnits pathUnits;
  std::string output;
  std::string replay;    ///< A recording to feel again, instead of a path.
  std::string record;    ///< A recording to write, beside the output.
  std::string soundFile; ///< Sound file of the touch; empty: none.
  std::string config;
  std::string settings;       ///< All given options, as a configuration in one line; filled in by complete().
  bool fit = false;           ///< Fit the cloud to the workspace, as view does.
  std::vector<double> clip;   ///< See HapticViewerOptions::clip.
  bool methodIsGiven = false; ///< --method, which a replay takes instead of its own.
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
  /// Takes the values of --config, and completes those that depend on several options of @p command. Ends in
  /// a usage error where they contradict each other; warns of one that has no effect. @throws Failure where
  /// the configuration file cannot be read.
  void complete(CLI::App& command);
  /// Takes the files that no option names: recorded clouds, and the copy of one that comes as a stream.
  void declareMore(Files& files) const;
  /// True if scenes near the hand are as fine as the points there: the user asked neither for other voxels
  /// nor for none.
  bool refinesNearHand() const { return !this->lattice.voxelsAreGiven && !this->raw && !this->noCovariance; }

private:
  void warnOfIdle(const CLI::App& command, const std::vector<std::string>& given) const;
};

} // namespace pointhaptics::app
