/// @file
/// The viewer's window with the live touch: ViewWindow.cxx sets it up, runs it and closes it, ViewDevices.cxx
/// has devices and servo loop, ViewLoading.cxx shows another cloud, ViewCommands.cxx lists what its keys do,
/// ViewActions.cxx, ViewParts.cxx and ViewRecording.cxx do it.
#pragma once

#include "ClipBoxTool.h"
#include "ColorBarDrag.h"
#include "DistanceMeasuring.h"
#include "EventLink.h"
#include "HapticViewerOptions.h"
#include "HeightProfile.h"
#include "PictureControls.h"
#include "RecordingWriter.h"
#include "ReplayPlayer.h"
#include "ScreenLayout.h"
#include "ShownFiles.h"
#include "ViewEvents.h"
#include "ViewScene.h"
#include "ViewTouch.h"

#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProgress.h"
#include "vtkHapticSliders.h"
#include "vtkInteractorStyleHaptic.h"

#include "Core/Base/Lifetime.h"
#include "Devices/Falcon/FalconDevice.h"
#include "Devices/Falcon/FalconUpdates.h"
#include "Devices/SimulatedDevice.h"
#include "Devices/Sound/SoundPlayer.h"
#include "Devices/SpaceMouse/SpaceMouse.h"
#include "Haptics/ServoLoop.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics
{

constexpr auto kNote = HapticViewerObserver::Kind::Note;
constexpr auto kWarning = HapticViewerObserver::Kind::Warning;
constexpr auto kError = HapticViewerObserver::Kind::Error;

/// All that the window needs while it is open, which may be before there is a cloud. The servo loop stops
/// before its devices and scenes go.
class ViewWindow
{
public:
  /// Opens nothing yet. @p scene must outlive this. The user steps through @p files, unless they are shown
  /// together.
  ViewWindow(ViewScene& scene, const HapticViewerOptions& options, const HapticViewerObserver& observer,
    std::vector<std::string> files);
  ~ViewWindow();
  ViewWindow(const ViewWindow&) = delete;
  ViewWindow& operator=(const ViewWindow&) = delete;

  /// Shows a bar in a window, which it opens, until @p loader has a result; @p title names what it reads.
  /// Call it again for the next cloud if one could not be read. False: the user closed the window or pressed
  /// Escape, or the observer asks to stop.
  bool awaitCloud(const CloudLoader& loader, const std::string& title);
  /// Shows the scene, which must be built of file @p cloud, or of all of them, and @p news in its status
  /// until there is other news; opens the device and starts the servo loop. False: @p message says what
  /// failed.
  bool start(std::size_t cloud, const std::string& news, std::string& message);
  /// Handles events until the user closes the window.
  void handleEvents();
  /// Stops the loop after start(), closes the device and writes the requested files. False: @p message says
  /// what could not be written.
  bool finish(std::string& message);
  bool isStarted() const { return isStarted_; }
  /// Writes the picture of the window. False: @p message says why not.
  bool writeImage(const std::string& fileName, std::string& message);

  vtkRenderWindow* window() { return window_; }
  vtkRenderWindowInteractor* interactor() { return interactor_; }
  vtkInteractorStyleHaptic* style() { return style_; }
  const Lifetime& lifetime() const { return lifetime_; }

  /// Adds the commands of @p window to its style's. Null: they are described, not run.
  static void addCommands(CommandRegistry& commands, ViewWindow* window);

private:
  void openWindow();
  /// Names the program and @p words.
  void setTitle(const std::string& words);
  bool isCancelKey();
  void showBar(const std::string& words, double part);
  void setUpRendering();
  bool openDevice(std::string& message);
  void followDevices();
  void openSimulated();
  void openFalcon();
  void onTimer();
  void onAbortCheck();
  bool startServo(std::string& message);
  void connectStyle();
  void onSamples(void* callData);
  void onFilesDropped(void* callData);
  std::string freeFileName(const std::string& extension) const;
  void writeScreenshot();
  // ViewRecording.cxx
  bool startRecording(const std::string& fileName, std::string& message);
  bool closeRecording(std::string& message, const std::string& cause = {});
  void endRecording(const std::string& cause = {});
  void toggleRecording();
  void setMarker();
  void followRecording();
  void toggleSound();
  void followSound();
  bool openReplay(std::string& message);
  void followReplay();
  void writeSettings();
  void toggleAxes();
  void toggleFigure();
  void setPivot();
  void clipFelt();
  std::string hiddenWords() const;
  void savePart();
  void followSaving();
  void showNextColors();
  void toggleFelt();
  void toggleAmbient();
  void setSceneOptions();
  void awaitColors(const std::string& news, bool waits);
  void endAwaitingColors();
  void showFigure(bool figure);
  void onSlider(int slider);
  void setContact(const ContactParameters& contact);
  void showSliderValues();
  void showProgress(const std::string& words, double part);
  void forgiveEscape();
  void leave();
  void show(LoadedCloud cloud, const FileLoad& load);
  void warn(const std::vector<std::string>& notes);
  void releaseHand();
  void followOptions(const HapticViewerOptions& then);
  void adoptModel(const AffineTransform& model, bool keepsModel, const HapticViewerOptions& then);
  void giveModel(vtkMatrix4x4* matrix);
  void findIdeal();
  /// Parameters with the limit of the force that holds.
  ContactParameters contactOf(const ServoSample& sample) const;
  HapticViewerState state();
  void onModelChanged();
  void onSceneChanged();
  void showNote();
  std::string scaleText();
  void toggleUnit();
  /// Sends @p news to the host, and shows them in the window.
  void say(const std::string& news, HapticViewerObserver::Kind kind = kNote);

  ViewScene& scene_;
  HapticViewerOptions options_;     ///< As keys and sliders have changed them.
  const HapticViewerOptions asked_; ///< As they were at the start: some are for each new cloud.
  const HapticViewerObserver& observer_;
  EventLink timer_{ [this] { this->onTimer(); } };
  EventLink abortCheck_{ [this] { this->onAbortCheck(); } };
  /// After any other key or button Escape warns again.
  EventLink acted_{ [this](unsigned long event, void*)
    {
      const bool isSame = event == vtkCommand::KeyPressEvent && this->isCancelKey();
      escapeQuits_ = isSame ? escapeQuits_ : decltype(escapeQuits_)();
    } };
  EventLink modelChanged_{ [this] { this->onModelChanged(); } };
  EventLink sceneChanged_{ [this] { this->onSceneChanged(); } };
  EventLink samples_{ [this](unsigned long, void* data) { this->onSamples(data); } };
  EventLink dropped_{ [this](unsigned long, void* data) { this->onFilesDropped(data); } };
  EventLink sliderMoved_{ [this](unsigned long, void* slider)
    { this->onSlider(*static_cast<int*>(slider)); } };
  bool isGivenUp_ = false; ///< A frame was given up and must be drawn again.
  /// Until then Escape is taken for the bar that has just gone.
  std::chrono::steady_clock::time_point escapeIsLate_;
  /// Until then Escape quits, although the touch is recorded.
  std::chrono::steady_clock::time_point escapeQuits_;
  bool isOpen_ = false;
  bool isStarted_ = false;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleHaptic> style_;
  vtkNew<vtkHapticChart> chart_;
  vtkNew<vtkHapticOverlay> overlay_;
  vtkNew<vtkHapticSliders> sliders_;
  vtkNew<vtkHapticProgress> progress_;
  ScreenLayout layout_;
  vtkNew<vtkRenderer> waiting_; // before the first cloud
  WaitingKeys waitingKeys_;     // of the same time
  const ToolContext tools_;
  PictureControls controls_;
  ColorBarDrag colorBar_;
  HeightProfile profile_;
  DistanceMeasuring measuring_;
  ClipBoxTool clipping_;
  ShownFiles files_;
  std::shared_ptr<IdealForce> wholeIdeal_; // for the force chart
  TouchFiles touchFiles_;
  RecordingWriter recording_;
  bool recordingWaits_ = false;                      ///< The user was told that the recording waits.
  std::future<std::pair<bool, std::string>> saving_; ///< Success, and what it will say.
  std::string savedName_;                            ///< The file that it makes.
  bool clipBoxBesideFigure_ = false;
  LengthUnit firstUnit_;      ///< Unit of the file before the user took another; no name: none was taken.
  std::string news_;          // last line of the status
  std::string awaitedColors_; ///< The message while colours are computed; empty: none are.
  std::unique_ptr<SimulatedDevice> hand_;
  std::unique_ptr<SimulatedDevice> replay_;
  std::unique_ptr<FalconDevice> falcon_;
  FalconUpdates falconUpdates_;
  std::string spaceMouseMessage_; ///< The message that was shown last.
  SpaceMouse spaceMouse_;
  HapticDevice* device_ = nullptr;
  ServoLoop servo_;                      // destroyed, and so stopped, before the device
  MarkerSocket markers_;                 // asks the loop
  SoundPlayer sound_;                    // before the servo loop, which it plays
  std::unique_ptr<ReplayPlayer> player_; // feeds the loop
  Lifetime lifetime_;                    // last: it ends first
};

} // namespace pointhaptics
