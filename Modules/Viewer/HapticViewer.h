/// @file
/// The viewer as a library: point clouds that are seen and felt, in a window or a picture.
#pragma once

#include "HapticViewerOptions.h"

#include "PointHapticsViewerModule.h" // For export macro

#include "vtkType.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkInteractorStyleHaptic;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderWindowInteractor;
class vtkRenderer;

namespace pointhaptics
{

class CommandRegistry;

/// Opens clouds, shows them and lets a hand feel them.
/// @code
/// HapticViewerOptions options;
/// options.axes = true;
/// HapticViewer viewer(options);
/// if (!viewer.open({ "statue.ply" }) || !viewer.run())
/// {
///   std::cerr << viewer.message() << '\n';
/// }
/// @endcode
/// All functions belong to the GUI thread. Those that return a bool answer false where they fail; message()
/// then says what, where and the cure. It prints nothing: HapticViewerObserver gets what there is to say.
/// Errors of VTK classes go where the host has VTK's errors go. The clouds are read in a thread of its own,
/// and so are scenes made while the window is open.
class POINTHAPTICSVIEWER_EXPORT HapticViewer
{
public:
  explicit HapticViewer(HapticViewerOptions options = {}, HapticViewerObserver observer = {});
  /// Stops the viewer, where stop() was not called.
  ~HapticViewer();
  HapticViewer(const HapticViewer&) = delete;
  HapticViewer& operator=(const HapticViewer&) = delete;

  ///@{
  /// Reads a cloud, fits and resamples it, and returns when it can be drawn. Of several files the first that
  /// can be read is shown, with a warning for each before it, and keys step through them; or all as one, see
  /// HapticViewerOptions::together. To be called before start(). @p cloud is any vtkPolyData with points,
  /// which are shared and must not be changed; @p title names it in window and messages.
  bool open(const std::vector<std::string>& files);
  bool open(vtkPolyData* cloud, const std::string& title = "cloud");
  ///@}

  /// Feels the cloud along HapticViewerOptions::path, or what HapticViewerOptions::replay says, in virtual
  /// time, and writes trace and forceChart. The next picture shows the tick of the largest force. Needs a
  /// cloud, and a display for a forceChart.
  bool feelPath();
  /// Writes a PNG: of the window while it is there, else of what it would show first, off the screen. Needs a
  /// cloud and a display.
  bool renderToFile(const std::string& fileName);
  /// Shows the window until the user closes it: start(), events, stop().
  bool run();

  ///@{
  /// For hosts with an event loop of their own: start() shows the window, opens the device and starts the
  /// servo loop; the interactor's timer does the rest, until stop(), which also writes trace and forceChart.
  /// start() is for once.
  bool start();
  bool stop();
  ///@}

  /// Why the last call failed.
  const std::string& message() const;
  /// The last open() failed because the user closed the window meanwhile, or the observer said stop.
  bool isCancelled() const;

  ///@{
  /// The viewer's own, for hosts that add to it. They live as long as the viewer.
  vtkRenderWindow* renderWindow();
  vtkRenderWindowInteractor* interactor();
  vtkInteractorStyleHaptic* style();
  vtkRenderer* renderer();
  ///@}

  /// The commands of every viewer with their usual keys, to be described, not run: for help texts. Those of a
  /// viewer, to which a host may add its own: style()->GetCommands().
  static CommandRegistry commands();

  /// Name of picture @p number, from 1, of a turntable of @p last pictures: OUT-001.png for OUT.png, with as
  /// many digits as the last one needs, and at least three.
  static std::string pictureName(const std::string& fileName, int number, int last);

  /// The drawn voxel means with their arrays. Null before open().
  vtkPolyData* means();
  /// Number of the cloud's points.
  vtkIdType numberOfPoints() const;
  /// Number of points that are NaN or infinite: neither drawn nor felt.
  vtkIdType numberOfInvalidPoints() const;
  /// How large the model is in the hand, in words.
  std::string scaleNote() const;
  ///@{
  /// Times of the last open().
  double readSeconds() const;
  double resampleSeconds() const;
  ///@}
  /// How often clouds were resampled since this viewer was made, in whatever thread: once for each that was
  /// shown, and once for each place the model was moved to (not for each motion). Scenes of what is near the
  /// hand do not count; further tries do, where 300 voxels on an axis tell too little of a cloud.
  std::uint64_t numberOfResamplings() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pointhaptics
