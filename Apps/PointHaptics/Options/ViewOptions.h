/// @file
/// What a user can say to `pointhaptics view`, on the command line or in a configuration file.
#pragma once

#include "Clouds/LoadedCloud.h"
#include "Feel/HandDevice.h"
#include "Options/BandwidthOptions.h"
#include "Options/LatticeOptions.h"

#include "Haptics/HapticParameters.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace CLI
{
class App;
}
class vtkRenderer;

namespace pointhaptics
{
namespace app
{

struct ViewOptions
{
  std::vector<std::string> files;
  LatticeOptions lattice;
  BandwidthOptions bandwidth;
  std::string screenshot; ///< PNG to write instead of opening a window.
  int width = 1280;
  int height = 800;
  std::string path;            ///< HIP.csv.
  std::string device = "auto"; ///< auto: a Falcon where one is plugged in.
  FalconOptions falcon;
  std::string config;
  std::string writeConfig; ///< JSON file to write with the options in force instead of showing anything.
  bool recent = false;     ///< Begin with what the last window ended with.
  bool together = false;   ///< All files as one cloud; else one at a time.
  bool watch = false;      ///< Read files again when they change.
  bool verbose = false;
  nlohmann::ordered_json given; ///< Options with a value, filled in by complete(): see givenSettings().
  std::string forceChart;       ///< PNG.
  std::string trace;            ///< CSV.
  std::string up = "auto";
  std::string colorBy;
  double pointSize = 0.0;            ///< Pixels; 0: from the spacing of the points.
  std::vector<std::string> bindings; ///< ACTION=GESTURES, as SetBinding() takes them; checked.
  std::vector<double> camera;        ///< Position, focal point, view up, of the workspace; empty: in front.
  bool pushPointer = false;
  bool axes = false;
  bool figure = false;
  bool ambient = false;
  std::string ideal = "auto"; ///< Name of the shape whose exact force the chart shows, auto or none.
  bool noCovariance = false;
  std::string method = "surface-fit";
  std::string preset = "tuned";
  ContactParameters contact;
  double staticFriction = -1.0; ///< Below 0: not given.
  bool fitsWorkspace = true;    ///< No option says how large the cloud is: it is fitted to the 10 cm cube.

  void addTo(CLI::App& command);
  /// Takes the values of the JSON file config for the options the command line does not give, and finds out
  /// fitsWorkspace. False: @p message says what is wrong with the file.
  bool complete(CLI::App& command, std::string& message);
  HapticParameters hapticParameters() const;
  /// How many clouds the files are: one where they are shown together.
  std::size_t numberOfClouds() const;
  /// What is shown at once: all files where they are shown together, else that at @p index.
  /// @pre index < numberOfClouds().
  std::vector<std::string> filesOfCloud(std::size_t index) const;
  /// To read @p wanted as these options say.
  CloudRequest cloudRequest(const std::vector<std::string>& wanted) const;
};

/// Looks as --camera says, where it was given.
void applyCamera(const ViewOptions& options, vtkRenderer* renderer);

} // namespace app
} // namespace pointhaptics
