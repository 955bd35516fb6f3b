/// @file
/// The command `view`: its options, on the command line or in a configuration file, and what it does.
#pragma once

#include "Options/SharedOptions.h"
#include "Terminal/CommandLine.h"

#include "HapticViewerOptions.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pointhaptics::app
{

struct ViewCommand : Command
{
  HapticViewerOptions viewer; ///< The parser fills in most of it, complete() the rest.
  std::vector<std::string> files;
  LatticeOptions lattice;
  BandwidthOptions bandwidth;
  TouchOptions touch;
  std::string screenshot;      ///< PNG to write instead of opening a window.
  std::string device = "auto"; ///< auto: a Falcon where one is plugged in.
  FalconOptions falcon;
  std::string config;
  std::vector<std::string> set; ///< Each NAME=VALUE, as a configuration has them.
  std::string writeConfig;      ///< JSON file to write with the options in force instead of showing anything.
  bool skipsUnreadable = false;
  bool recent = false;          ///< Begin with what the last window ended with.
  nlohmann::ordered_json given; ///< Options with a value, filled in by complete(): see givenSettings().
  bool noCovariance = false;

  void addTo(CLI::App& command) override;
  /// Takes the values of --set, then those of the JSON file config, for the options the command line does not
  /// give, and fills in what the viewer needs. Takes recorded clouds, and the pictures of a turntable.
  /// @throws Failure
  void complete(CLI::App& command, Files& taken) override;
  int run(Files& files) override;
  /// A window is what these options ask for: files that a path fills are written at once; without one a
  /// session is what fills them.
  bool needsWindow() const;
  /// Something is drawn: a window or a picture.
  bool draws() const;

private:
  void readConfig(CLI::App& command, Files& taken);
  void declare(Files& taken) const;
  void checkFiles() const;
  void completeViewer(CLI::App& command);
};

/// Names the keys in the help of the options of @p view that keys do too, as @p bindings change the usual
/// ones: each ACTION=GESTURES, checked. Once.
void describeKeys(CLI::App& view, const std::vector<std::string>& bindings);

} // namespace pointhaptics::app
