/// @file
/// Options of `pointhaptics view`, on the command line or in a configuration file.
#pragma once

#include "Options/BandwidthOptions.h"
#include "Options/FalconOptions.h"
#include "Options/LatticeOptions.h"
#include "Options/TouchOptions.h"

#include "HapticViewerOptions.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

class Files;

struct ViewOptions
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
  std::string writeConfig; ///< JSON file to write with the options in force instead of showing anything.
  bool skipsUnreadable = false;
  bool recent = false;          ///< Begin with what the last window ended with.
  nlohmann::ordered_json given; ///< Options with a value, filled in by complete(): see givenSettings().
  bool noCovariance = false;

  void addTo(CLI::App& command);
  /// Takes the values of the JSON file config for the options the command line does not give, and fills in
  /// what the viewer needs. @throws Failure
  void complete(CLI::App& command);
  /// Takes the files that no option names: recorded clouds, and the pictures of a turntable.
  void declareMore(Files& taken) const;
  /// A window is what these options ask for: files that a path fills are written at once; without one a
  /// session is what fills them.
  bool needsWindow() const;
  /// Something is drawn: a window or a picture.
  bool draws() const;

private:
  void readConfig(CLI::App& command);
  void warnOfIdle(const CLI::App& command, const std::vector<std::string>& named) const;
  void checkFiles() const;
  void checkStandardInput() const;
  void takeRecording();
  void completeViewer(CLI::App& command);
};

} // namespace pointhaptics::app
