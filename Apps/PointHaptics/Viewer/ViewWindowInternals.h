/// @file
/// What the window of `view` holds while it is open: ViewWindow.cxx sets it up, runs it and closes it,
/// ViewWindowActions.cxx does what the user asks of it.
#pragma once

#include "Clouds/CloudLoader.h"
#include "Clouds/FileWatch.h"
#include "Feel/HandDevice.h"
#include "Options/ViewOptions.h"
#include "Viewer/ViewScene.h"
#include "Viewer/ViewTouch.h"

#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProgress.h"
#include "vtkHapticSliders.h"
#include "vtkInteractorStyleHaptic.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/PathReplay.h"
#include "Devices/SimulatedDevice.h"
#include "Devices/SpaceMouse/SpaceMouse.h"
#include "Haptics/ServoLoop.h"

#include <nlohmann/json.hpp>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace app
{

/// Everything the window needs while it is open. The servo loop stops before what it works on goes away.
class ViewWindow
{
public:
  ViewWindow(ViewScene& scene, const ViewOptions& options)
    : scene_(scene)
    , options_(options)
    , parameters_(options.hapticParameters())
    , files_(options.files)
  {
  }

  bool awaitCloud(const CloudLoader& loader, const std::string& title);
  bool run(std::size_t cloud, const std::string& news, std::string& message);

private:
  /// Files that are being read to be shown.
  struct Loading
  {
    std::vector<std::string> files;
    bool keepsModel = false;
    std::function<void(bool isShown)> then; ///< Also after a cancel.
    FileWatch watch;                        ///< From before the first byte was read.
  };
  void openWindow();
  bool isCancelKey();
  void showBar(const std::string& words, double part);
  void setUpRendering();
  bool openDevice(std::string& message);
  void followDevices();
  void openSimulated();
  void openFalcon();
  void onTimer();
  bool startServo(std::string& message);
  void connectStyle();
  void observe(unsigned long event, void (ViewWindow::*handler)(void*));
  void onSamples(void* callData);
  void onFilesDropped(void* callData);
  void onScreenshot(void*);
  void onNextFile(void*);
  void onPreviousFile(void*);
  void onWriteSettings(void*);
  void onAxes(void*);
  void onFigure(void*);
  void onColors(void*);
  void onAmbient(void*);
  void endAwaitingColors();
  void showFigure(bool figure);
  void onSlider(int slider);
  void connectSliders();
  void setContact(const ContactParameters& contact);
  void showSliderValues();
  void load(const std::vector<std::string>& files, bool keepsModel, std::function<void(bool)> then);
  void followLoading();
  void endLoading(bool isShown);
  void cancelLoading();
  void forgiveEscape();
  void onKey();
  void show(LoadedCloud cloud);
  void showFile(std::size_t index);
  void findIdeal();
  nlohmann::ordered_json settings();
  void onModelChanged(void*);
  void onSceneChanged(void*);
  void showNote();
  void tell(const std::string& message);
  void say(const std::string& news);
  bool finish(std::string& message);

  ViewScene& scene_;
  ViewOptions options_;
  HapticParameters parameters_; ///< As the servo loop has them.
  double voxelSize_ = 0.0;      ///< As the slider set it, metres; 0: as the options say.
  std::vector<std::string> files_;
  std::size_t fileIndex_ = 0;      ///< Of the last one that was asked for.
  std::vector<std::string> shown_; ///< What the window shows: one of files_, or all together.
  FileWatch watch_;
  int sinceLook_ = 0;
  Loading loading_; ///< While loader_ is busy.
  /// Until then Escape is taken as meant for the bar that has just gone.
  std::chrono::steady_clock::time_point escapeIsLate_;
  bool isOpen_ = false;
  int writtenSettings_ = 0;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleHaptic> style_;
  vtkNew<vtkHapticChart> chart_;
  vtkNew<vtkHapticChart> wholeChart_; // for --force-chart
  vtkNew<vtkHapticOverlay> overlay_;
  vtkNew<vtkHapticSliders> sliders_;
  vtkNew<vtkHapticProgress> progress_;
  vtkNew<vtkRenderer> waiting_; // before the first cloud
  vtkNew<vtkCallbackCommand> cancelKey_;
  std::shared_ptr<IdealForce> wholeIdeal_; // for the same
  TraceFile trace_;
  int screenshots_ = 0;
  bool chartBesideFigure_ = true; ///< Comes back when the figure goes.
  std::string news_;              // last line of the status
  std::string awaitedColors_;     ///< The news while colours are computed; empty: none are.
  std::unique_ptr<SimulatedDevice> hand_;
  std::unique_ptr<PathReplayDevice> replay_;
  std::unique_ptr<FalconDevice> falcon_;
  FalconNews falconNews_;
  std::string spaceMouseMessage_; ///< As the user was told.
  SpaceMouse spaceMouse_;
  HapticDevice* device_ = nullptr;
  CloudLoader loader_;
  ServoLoop servo_; // last: destroyed, and so stopped, first
};

} // namespace app
} // namespace pointhaptics
