/**
 * @class   vtkInteractorStyleHaptic
 * @brief   camera, model and hand under the mouse and keys, and the touch shown live
 *
 * A trackball camera style that turns events into commands. They also move the model in the haptic workspace,
 * drive a simulated hand, and show what the servo loop feels. Every part is optional; set those the program
 * has, in any order. With a resampler, whose points lie in the box of the hand, vtkHapticTouch brings the
 * others:
 *
 * @code
 * vtkNew< vtkInteractorStyleHaptic > style;
 * style->SetResampler(resampler);       // its Transform is set by the style: see SetModelMatrix()
 * style->SetCloudActor(actor);          // moves at once while the pipeline catches up
 * interactor->SetInteractorStyle(style);
 * vtkNew< vtkHapticTouch > touch;
 * touch->Run(style);                    // until the window is closed
 * @endcode
 * A program with parts of its own gives them by SetServoLoop(), SetDevice(), SetProps() and the other
 * functions below, adds the props to its renderer (vtkHapticProps::AddTo), starts the device and the servo
 * loop, and calls UpdateModel(), then StartUpdates() after the interactor's Initialize().
 *
 * What it can do is the list of its commands, each with name, keys and line in the help: GetCommands(). A
 * program in C++ adds its own there by one call, takes others away, and binds them to other keys. The help
 * shows those whose parts are there. The parts themselves are for programs in C++, too: GetModel(),
 * GetScenes(), GetHand(), GetClutch(), GetStatus(), GetDisplay(), GetPicker().
 *
 * The default commands: drags turn, pan and dolly the camera; with Shift they move the model, with Ctrl the
 * simulated hand. In hand mode that follows the mouse without a button. While a button of the haptic device
 * is held the hand holds the model instead of feeling it (pointhaptics::DeviceClutch). A 3D mouse moves the
 * model (SetSpaceMouse()).
 *
 * The 33 ms timer makes scenes, reads the servo loop and moves the props; a frame is drawn only when
 * something has changed, and drawing leaves at least half of the time to events.
 *
 * Errors of the filters that make the scenes, which run in another thread, are errors of the style
 * (ErrorEvent).
 *
 * Events: ModelChangedEvent after the transform changed; SceneChangedEvent after a new scene was published
 * (also when it is empty); SamplesEvent with the new ticks (call data:
 * std::vector< pointhaptics::ServoSample >*); FilesDroppedEvent (call data: vtkStringArray*).
 *
 * Frames: the model transform maps the cloud's frame into the workspace's (x_T = T x + t); metres.
 * Thread safety: GUI thread only. Ownership: VTK objects are reference counted. Servo loop, device and
 * SpaceMouse are not owned; each may be destroyed before or after the style, by the GUI thread, and counts as
 * taken away then.
 * @sa vtkHapticProps vtkHapticChart vtkVoxelMeanResampler
 */
#ifndef vtkInteractorStyleHaptic_h
#define vtkInteractorStyleHaptic_h

#include "CameraSteps.h"          // For dolly and pan
#include "CommandInput.h"         // For the drag under way
#include "CommandRegistry.h"      // For the commands
#include "DeviceClutch.h"         // For the device's buttons
#include "HandDistance.h"         // For a hand in free space
#include "ModelTransform.h"       // For the model
#include "MouseHand.h"            // For the simulated hand
#include "PointPicker.h"          // For the picked point
#include "ScenePipeline.h"        // For the scenes
#include "ScreenView.h"           // For the picture
#include "SpaceMouseController.h" // For the 3D mouse
#include "StatusText.h"           // For the texts
#include "TouchDisplay.h"         // For props and chart

#include "Devices/PathUnits.h"             // For names of units
#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkCommand.h"                    // For UserEvent
#include "vtkHapticSliders.h"              // For the sliders
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkSmartPointer.h" // For the sliders

#include <memory> // For scenes
#include <string> // For gestures
#include <vector> // For samples

class POINTHAPTICSINTERACTION_EXPORT vtkInteractorStyleHaptic : public vtkInteractorStyleTrackballCamera
{
public:
  static vtkInteractorStyleHaptic* New();
  vtkTypeMacro(vtkInteractorStyleHaptic, vtkInteractorStyleTrackballCamera);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum HapticEvents
  {
    ModelChangedEvent = vtkCommand::UserEvent + 7301,
    SceneChangedEvent,
    SamplesEvent,
    FilesDroppedEvent
  };

  ///@{
  /**
   * The parts the style works on; null takes one away. The device is whatever the servo loop drives: its
   * buttons hold the model. A pointhaptics::SimulatedDevice without a path is driven by mouse and keys too.
   */
  void SetServoLoop(pointhaptics::ServoLoop* servo);
  pointhaptics::ServoLoop* GetServoLoop() const { return this->Servo.get(); }
  void SetDevice(pointhaptics::HapticPort* device);
  void SetSpaceMouse(pointhaptics::SpaceMouse* mouse) { this->Cap.setMouse(mouse); }
  void SetResampler(vtkVoxelMeanResampler* resampler) { this->Scenes.setResampler(resampler); }
  void SetBandwidthFilter(vtkKernelBandwidthFilter* filter) { this->Scenes.setBandwidthFilter(filter); }
  void SetCloudActor(vtkActor* actor) { this->Scenes.setCloudActor(actor); }
  void SetProps(vtkHapticProps* props) { this->Display.setProps(props); }
  void SetChart(vtkHapticChart* chart) { this->Display.setChart(chart); }
  void SetOverlay(vtkHapticOverlay* overlay) { this->Status.setOverlay(overlay); }
  void SetSliders(vtkHapticSliders* sliders) { this->Sliders = sliders; }
  vtkHapticSliders* GetSliders() const { return this->Sliders; }
  ///@}

  ///@{
  /**
   * Parts of the style. They live as long as the style.
   */
  pointhaptics::CommandRegistry& GetCommands() { return this->Commands; }
  pointhaptics::ModelTransform& GetModel() { return this->Model; }
  pointhaptics::ScenePipeline& GetScenes() { return this->Scenes; }
  pointhaptics::MouseHand& GetHand() { return this->Hand; }
  const pointhaptics::HandDistance& GetDistance() const { return this->Distance; }
  pointhaptics::DeviceClutch& GetClutch() { return this->Clutch; }
  pointhaptics::StatusText& GetStatus() { return this->Status; }
  pointhaptics::TouchDisplay& GetDisplay() { return this->Display; }
  pointhaptics::PointPicker& GetPicker() { return this->Picker; }
  const pointhaptics::ScreenView& GetScreen() const { return this->Screen; }
  ///@}

  /**
   * Puts the simulated hand above the surface under the pointer, as soon as the felt scene is that of the
   * picture.
   */
  void HoverHand();

  /**
   * Box of the hand, xmin, xmax, ymin, ymax, zmin, zmax: see pointhaptics::ModelTransform. Default: the 10 cm
   * cube about the origin.
   */
  void SetWorkspaceBounds(const double bounds[6]) { this->Model.setWorkspaceBounds(bounds); }

  ///@{
  /**
   * The model transform, for reading; and set together with what the key for the start goes back to.
   */
  vtkTransform* GetModelTransform() const { return this->Model.transform(); }
  void SetModelMatrix(vtkMatrix4x4* matrix) { this->Model.setMatrix(matrix); }
  ///@}

  /**
   * As SetModelMatrix(), for a model whose scene was made elsewhere: see ScenePipeline::adopt().
   */
  void AdoptModel(vtkMatrix4x4* matrix, std::shared_ptr<const pointhaptics::HapticScene> scene);

  /**
   * As SetModelMatrix(), for a model whose scene is to be made: see ScenePipeline::startCloud().
   */
  void StartModel(vtkMatrix4x4* matrix, bool findsLattice);

  /**
   * Marks the model as changed by something else that the scene is made from, such as the voxel size or the
   * filters' settings: the next UpdateModel() or timer event makes a new one.
   */
  void InvalidateModel();

  /**
   * Wait until the scene of the model as it is now is made, published and shown, if it is not yet. The timer
   * does it otherwise, without waiting. False: there is no point in the workspace (an empty scene was
   * published).
   */
  bool UpdateModel() { return this->Scenes.update(); }
  bool IsModelChanged() const { return this->Scenes.isChanged(); }

  ///@{
  /**
   * Hand mode: the simulated hand follows the mouse pointer in the view plane at its depth. Default: off.
   */
  void SetHandMode(bool on) { this->Hand.setFollowsMouse(on); }
  bool GetHandMode() const { return this->Hand.followsMouse(); }
  ///@}

  /**
   * What the sizes of the model and of the path of a pointhaptics::SimulatedDevice say of their units: see
   * pointhaptics::unlikelyUnits(). Where nobody asks, StartUpdates() makes a warning of it.
   */
  std::string JudgeUnits(const pointhaptics::UnitNames& names = {});

  ///@{
  /**
   * Start and stop the repeating timer, after vtkRenderWindowInteractor::Initialize(). Milliseconds, at
   * least 1.
   */
  void StartUpdates(unsigned long milliseconds = 33);
  void StopUpdates();
  ///@}

  /**
   * Runs the timer's work: brings model, props, chart and status up to date, and renders if something
   * changed.
   */
  void Refresh();

  /**
   * Takes the servo loop's new ticks now: SamplesEvent; props, chart and buttons get them at the next
   * Refresh().
   */
  void CollectSamples();

  void OnMouseMove() override;
  void OnLeftButtonDown() override { this->Press("left"); }
  void OnLeftButtonUp() override { this->Input.releaseButton(); }
  void OnMiddleButtonDown() override { this->Press("middle"); }
  void OnMiddleButtonUp() override { this->Input.releaseButton(); }
  void OnRightButtonDown() override { this->Press("right"); }
  void OnRightButtonUp() override { this->Input.releaseButton(); }
  void OnMouseWheelForward() override { this->Input.turnWheel(this->GestureOf("wheel"), +1); }
  void OnMouseWheelBackward() override { this->Input.turnWheel(this->GestureOf("wheel"), -1); }
  void OnKeyPress() override;
  void OnKeyRelease() override;
  void OnChar() override {} // the base class would read some keys as wire frame, stereo or exit
  void OnLeave() override;
  void OnTimer() override { this->Refresh(); }
  void OnDropFiles(vtkStringArray* filePaths) override;
  void StartPan() override;
  void Pan() override;
  using Superclass::Dolly;

protected:
  vtkInteractorStyleHaptic();
  ~vtkInteractorStyleHaptic() override;
  void Dolly(double factor) override;

private:
  vtkInteractorStyleHaptic(const vtkInteractorStyleHaptic&) = delete;
  void operator=(const vtkInteractorStyleHaptic&) = delete;

  void Press(const char* button);
  std::string GestureOf(const char* name) const;
  void ModelMoved();
  void HoverIfDue();
  void MeasureDistance(const pointhaptics::ServoSample& latest);
  void SceneShown(const pointhaptics::BuiltScene& built);

  pointhaptics::ScreenView Screen;
  pointhaptics::CameraSteps Steps;
  pointhaptics::CommandRegistry Commands;
  pointhaptics::CommandInput Input;
  pointhaptics::ModelTransform Model;
  pointhaptics::WatchedPointer<pointhaptics::ServoLoop> Servo;
  std::vector<pointhaptics::ServoSample> Samples; // collected, not shown yet
  pointhaptics::ScenePipeline Scenes;
  pointhaptics::MouseHand Hand;
  pointhaptics::DeviceClutch Clutch;
  pointhaptics::HandDistance Distance;
  pointhaptics::SpaceMouseController Cap;
  pointhaptics::StatusText Status;
  pointhaptics::TouchDisplay Display;
  pointhaptics::PointPicker Picker;
  vtkSmartPointer<vtkHapticSliders> Sliders;
  pointhaptics::WatchedPointer<pointhaptics::HapticPort> Device;
  bool UnitsAreJudged = false;
  int PressedAt[2] = { 0, 0 }; // pixels: VTK counts clicks at different places as one double click
  int Timer = -1;
};

#endif
