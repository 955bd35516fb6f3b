/// @file
/// The command `feel`.
#pragma once

#include "Clouds/Pipeline.h"
#include "Options/SharedOptions.h"
#include "Terminal/CommandLine.h"

#include "FeelScenes.h"
#include "HapticViewerOptions.h"
#include "RecordingWriter.h"

#include <functional>
#include <string>
#include <vector>

namespace pointhaptics::app
{

struct FeelCommand : Command
{
  std::string file;
  ReadOptions reading;
  HapticViewerOptions viewer; ///< What view would feel: filled in by the parser and complete().
  std::string output;
  std::string soundFile; ///< Sound file of the touch; empty: none.
  std::string config;
  std::string settings;       ///< All given options, as a configuration in one line; filled in by complete().
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

  FeelCommand() { this->viewer.fitsWorkspace = false; }
  void addTo(CLI::App& command) override;
  /// Takes the values of --config, recorded clouds and the copy of a cloud that comes as a stream, and
  /// completes what depends on several options.
  void complete(CLI::App& command, Files& files) override;
  int run(Files& files) override;

  /// Resamples @p cloud, or the part that --clip leaves, or takes its points as they are (--raw), and makes
  /// the @p scenes. @throws Failure that says why there is nothing to feel.
  void makeScenes(vtkPolyData* cloud, FeelScenes& scenes) const;
  /// Runs the servo loop on the Falcon, whose hand is in real time; @p onSample gets every tick that had a
  /// position, @p recording all. Local scenes are made in a thread of their own; until one is there, the
  /// whole cloud's is felt. @throws Failure
  ServoStatistics feelLive(FeelScenes& scenes, RecordingWriter& recording,
    const std::function<void(const ServoSample&)>& onSample) const;

private:
  void declare(Files& files) const;
};

} // namespace pointhaptics::app
