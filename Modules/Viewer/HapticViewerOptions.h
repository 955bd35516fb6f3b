/// @file
/// Options of a HapticViewer: plain values, each with the default of the program.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/AffineTransform.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "Devices/Falcon/FalconDevice.h"
#include "Devices/PathUnits.h"
#include "Haptics/HapticParameters.h"
#include "PictureSettings.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pointhaptics
{

/// The device that moves the hand.
enum class HapticViewerDevice
{
  Auto,      ///< A Falcon where one can be used, else the simulated hand.
  Falcon,    ///< An error where none can be used.
  Simulated, ///< Driven by mouse and keys.
  None,      ///< The cloud is looked at and not felt.
};

/// Names of settings in messages, as the person at the screen knows them.
struct HapticViewerNames
{
  std::string colorBy = "colorBy";
  std::string clip = "clip";
  std::string felt = "felt";
  std::string firmware = "falcon.firmwareFile";
  std::string placement = "workspace and transform"; ///< Whatever may leave the cloud out of the workspace.
  UnitNames units;
  std::string hidden = "picture.hidden";
};

/// Lengths are metres of the workspace unless said otherwise.
struct HapticViewerOptions
{
  // The file.
  std::vector<std::string> columns; ///< Names for the columns of texts; empty: as the files say.
  bool salvage = false;             ///< Files that are cut are read as far as they go.
  bool vertices = false;            ///< Meshes are their vertices; else samples of their faces.
  double resolution = 0.0;          ///< Resolution of cloud optimised files, in their units; 0: all points.

  // The picture.
  int width = 1280; ///< Pixels of window or picture, at least 16.
  int height = 800;
  std::string colorBy;     ///< An array of the cloud or the pipeline, ARRAY:COMPONENT, rgb; empty: a choice.
  std::string up = "auto"; ///< Axis of the cloud that points up: x, -x, ... -z; auto: a guess.
  /// xmin, xmax, ymin, ymax, zmin, zmax in the file: only points in this box are shown and felt; empty: all.
  std::vector<double> clip;
  std::string kind = "auto";  ///< object, terrain, sweep, indoors, frame: see CloudLook.h; auto: a guess.
  bool felt = false;          ///< Show the means that are felt, not the points of the file.
  double pointSize = 0.0;     ///< Pixels; 0: from the spacing of the points, so that surfaces close.
  bool axes = false;          ///< Box and axes of the cloud's own frame.
  bool figure = false;        ///< Nothing but the cloud in one color on white, workspace, proxy and normal.
  bool ambient = false;       ///< Light by the normals of the felt surface.
  PictureSettings picture;    ///< Projection, background and the like.
  int turntable = 0;          ///< Number of pictures, once about the cloud, in place of one; 0: one picture.
  std::vector<double> camera; ///< Position, focal point, view up: 9 numbers; empty: from in front.

  // Where the cloud lies, and the lattice it is resampled on.
  AffineTransform transform;  ///< From the file's coordinates to metres.
  std::string unit = "m";     ///< Name of the unit of the file's coordinates, for texts.
  double metresPerUnit = 1.0; ///< Length of that unit in metres; @c transform includes it already.
  bool unitIsChosen = false;  ///< If false, texts take the unit that a file itself names.
  bool fitsWorkspace = true;  ///< Fit the transformed cloud to the 10 cm cube about the origin.
  /// Settings of the resampling. Lattice dimensions of 0 are chosen by the viewer, 300 to 1200. Where
  /// fitsWorkspace is on the workspace is that cube, else an automatic one is a cube about the cloud. With
  /// computeCovariance, the default here, the second moments of the points in a voxel shape the felt surface.
  VoxelMeanSettings voxels = defaultVoxels();
  /// Rule from the spacing of the points to the radius of the proxy. The picture decides which of its arrays
  /// are made.
  BandwidthSettings bandwidth;

  // The touch.
  HapticParameters haptics; ///< Method, contact, gains.
  std::string ideal =
    "auto"; ///< Shape whose exact force the chart shows; auto: where the cloud is one; none.
  HapticViewerDevice device = HapticViewerDevice::Auto;
  FalconSettings falcon;  ///< The default of @c cancelled is HapticViewerObserver::shouldStop.
  std::string path;       ///< File of a hand path, t,x,y,z, that moves the hand instead of a device.
  PathUnits pathUnits;    ///< Units of the path's numbers.
  std::string replay;     ///< A recording that is felt again instead of a path.
  std::string record;     ///< A recording to write, from the first tick to the last; empty: a key begins one.
  std::string markerText; ///< Text in the recording for markers that the key sets.
  int markerPort = -1;    ///< TCP port of this machine at which other programs set markers (MarkerSocket.h);
                          ///< -1: none.
  std::string passingFile; ///< A file that the host deletes when the viewer ends: recordings keep a copy of
                           ///< it.
  std::string trace;       ///< CSV to write, one row a tick; empty: none.
  std::string forceChart;  ///< PNG to write, force and proxy radius over time; empty: none.

  // The window.
  std::vector<std::string> bindings; ///< NAME=GESTURES, as CommandRegistry::bind() takes them.
  bool pushPointer = false;          ///< The mouse pointer is pushed out of what the hand touches.
  bool together = false;             ///< All files as one cloud; else one at a time.
  bool watch = false;                ///< Read files again when they change.
  /// Points of a cloud optimised file that the window shows at once, while all are read; 0: it waits for all.
  std::int64_t coarsePoints = 60000;
  bool fullScreen = false; ///< The window covers the screen, without a border.
  bool sound = false;      ///< The touch is heard (SoundPlayer.h), where the machine has a loudspeaker.
  /// Show the window while the first file is read, if that takes longer than 0.2 s and there is a display;
  /// for programs that call HapticViewer::run() next.
  bool showsReading = false;
  /// Means are made although neither picture nor path needs them: HapticViewer::means() has them after
  /// open(). With showsReading they come after the first picture.
  bool makesMeans = true;

  HapticViewerNames names;

  /// True if the hand goes where a file says.
  bool followsFile() const { return !this->path.empty() || !this->replay.empty(); }
  /// True if the lattice's voxels were chosen.
  bool hasVoxels() const
  {
    return this->voxels.lattice.dimensions[0] > 0 || this->voxels.lattice.voxelSize > 0.0;
  }
  /// Default of voxels: the viewer chooses their size.
  static VoxelMeanSettings defaultVoxels()
  {
    VoxelMeanSettings settings;
    settings.lattice.dimensions = { 0, 0, 0 };
    settings.computeCovariance = true;
    return settings;
  }
};

/// State of a window: the options with what its user changed, as if they had been given so. The unit is
/// chosen where the user took it. In a parallel projection the camera's distance tells the scale: see
/// fitCamera().
struct HapticViewerState : HapticViewerOptions
{
  std::array<double, 16> modelToWorkspace{}; ///< From the file's coordinates to metres, row by row.
  std::array<double, 6> workspace{};         ///< xmin, xmax, ymin, ymax, zmin, zmax.
};

/// Messages and questions of a viewer to its host. Every member may be empty. All are called in the GUI
/// thread.
struct HapticViewerObserver
{
  enum class Kind
  {
    Note,    ///< A finished action, such as "screenshot: FILE".
    Warning, ///< The viewer goes on, with less.
    Error,   ///< A request of the user failed; the window goes on.
  };

  /// Shows a message for people, in one or more lines, without a line break at its end.
  std::function<void(Kind, const std::string&)> message;
  /// Shows the progress of long work: @p part 0 to 1; 1 ends it.
  std::function<void(const std::string& what, double part)> progress;
  /// True ends long work and closes the window. Asked about 30 times a second.
  std::function<bool()> shouldStop;
  /// Returns the place where the content of a picture of that name is written, if the host renames it later.
  std::function<std::string(const std::string& fileName)> placeOf;
  /// Returns the complaints of VTK classes since the last call, where the host collects them.
  std::function<std::vector<std::string>()> takeVtkErrors;
  /// Keeps @p state in @p fileName (JSON) at the user's request. False: @p message says why not. Empty: the
  /// key has no effect.
  std::function<bool(const HapticViewerState& state, const std::string& fileName, std::string& message)>
    writeState;
  /// Describes @p state as a configuration in one line; and the program's name and version: both for the
  /// header of a recording, and either may be missing.
  std::function<std::string(const HapticViewerState& state)> describeState;
  std::string program;
  /// Keeps that a person turned @p axis of @p file upwards; and the axis that was kept, or "".
  std::function<void(const std::string& file, const std::string& axis)> keepUp;
  std::function<std::string(const std::string& file)> upOf;
  /// Called when the window closes.
  std::function<void(const HapticViewerState& state)> rememberState;

  ///@{
  /// Ask the functions of these names, where they are there.
  void say(Kind kind, const std::string& text) const
  {
    if (this->message)
    {
      this->message(kind, text);
    }
  }
  bool stops() const { return this->shouldStop && this->shouldStop(); }
  ///@}
};

} // namespace pointhaptics
