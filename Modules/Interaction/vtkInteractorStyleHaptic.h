/**
 * @class   vtkInteractorStyleHaptic
 * @brief   camera, model and hand under the mouse and keys, and the touch shown live
 *
 * A trackball camera style that can also turn, shift and zoom the model in the haptic workspace, drive a
 * simulated hand, and show what the servo loop feels. Every part is optional; set those the program has:
 * @code
 * vtkNew<vtkInteractorStyleHaptic> style;
 * style->SetResampler(resampler);              // its Transform becomes the style's
 * style->SetBandwidthFilter(bandwidth);        // fed by the resampler
 * style->SetServoLoop(&servo);                 // gets a new HapticScene after every change of the model
 * style->SetDevice(&simulatedDevice);
 * style->SetSpaceMouse(&spaceMouse);
 * style->SetProps(props);
 * style->SetCloudActor(actor);                 // moves at once while the pipeline catches up
 * interactor->SetInteractorStyle(style);
 * style->SetDefaultRenderer(renderer);
 * style->UpdateModel();
 * interactor->Initialize();
 * style->StartUpdates();
 * interactor->Start();
 * @endcode
 *
 * Drags: left turns the camera, middle pans, right or the wheel dollies. With Shift they move the model: left
 * turns it, middle (or Ctrl+Shift+left) shifts it, the wheel zooms it about the workspace's centre. Ctrl+left
 * drags the hand in the view plane, Ctrl+wheel moves it in depth; in hand mode it follows the mouse without a
 * button. These are the defaults: SetBinding() gives any key or gesture to any action; for all of them see
 * GetHelpText(). A SpaceMouse turns and shifts the model as the cap is turned and
 * shifted on the screen; with its first button held, pushing and pulling zooms; its second one resets the
 * model.
 *
 * The haptic device has a clutch: while one of its buttons is held the hand holds the model instead of
 * feeling it. The first button shifts the model with the hand; the second turns it about the workspace's
 * centre, as if a ball of a quarter of the workspace were rolled under the hand; the third moves the
 * workspace over the model, which stays where it is on the screen, and so reaches every part of a model
 * larger than the workspace; the fourth zooms by pulling and pushing. The model follows each tick in which
 * the button was down, and no other. From the moment the style sees the button the force goes to zero
 * (ServoLoop::setClutched()); once the scene of the new place is felt, it comes back slowly. Other actions
 * that are bound to a button of the device happen when it is pressed. Keys press the buttons of the simulated
 * hand.
 *
 * A change of the model makes a NEW HapticScene, in a thread of its own (pointhaptics::SceneWorker) with
 * filters of its own, which have the settings of those given here; it goes to the servo loop as soon as it is
 * finished: the servo thread never waits and never sees a half-made scene. Changes that come while one is
 * made are made up for by the next one. Until the next timer event the cloud's actor shows the old voxel
 * means where the model is now; then the output of the given filters becomes what the thread has made,
 * without their running, and the actor's mapper, where it is connected to them, is given that data instead.
 * The 33 ms timer also reads ServoLoop::latest() and moves the props; a render happens only when something
 * changed, and rendering leaves at least half of the time to events.
 *
 * Events: ModelChangedEvent after the transform changed; SceneChangedEvent after a new scene was published
 * (also when it is empty); SamplesEvent with the new ticks (call data:
 * std::vector<pointhaptics::ServoSample>*); FilesDroppedEvent (call data: vtkStringArray*); ScreenshotEvent,
 * NextFileEvent, PreviousFileEvent, WriteSettingsEvent, AxesEvent, FigureEvent, ColorsEvent and AmbientEvent
 * when the user asks for it.
 *
 * Frames: the model transform maps the cloud's frame into the workspace's (x_T = T x + t); metres.
 * Thread safety: GUI thread only. Ownership: servo loop, device and SpaceMouse are not owned and must outlive
 * the style or be set to null; VTK objects are reference counted.
 * @sa vtkHapticProps vtkHapticChart vtkVoxelMeanResampler
 */
#ifndef vtkInteractorStyleHaptic_h
#define vtkInteractorStyleHaptic_h

#include "Core/Base/Vector3.h" // For Vec3
#include "HapticBindings.h"    // For HapticAction

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkCommand.h"                    // For UserEvent
#include "vtkInteractorStyleTrackballCamera.h"

#include <cstdint>    // For the number of builds
#include <functional> // For the ideal force
#include <memory>     // For Internals
#include <string>     // For the status note

class vtkActor;
class vtkHapticChart;
class vtkHapticOverlay;
class vtkHapticProps;
class vtkHapticSliders;
class vtkKernelBandwidthFilter;
class vtkMatrix4x4;
class vtkPolyData;
class vtkTransform;
class vtkVoxelMeanResampler;

namespace pointhaptics
{
class HapticScene;
class ServoLoop;
struct BuiltScene;
struct SceneRequest;
struct ServoSample;
class SimulatedDevice;
class SpaceMouse;
}

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
    FilesDroppedEvent,
    ScreenshotEvent,
    NextFileEvent,
    PreviousFileEvent,
    WriteSettingsEvent,
    AxesEvent,
    FigureEvent,
    ColorsEvent,
    AmbientEvent
  };

  ///@{
  /**
   * The parts the style works on; null takes one away.
   */
  void SetServoLoop(pointhaptics::ServoLoop* servo);
  void SetDevice(pointhaptics::SimulatedDevice* device);
  void SetSpaceMouse(pointhaptics::SpaceMouse* mouse);
  void SetResampler(vtkVoxelMeanResampler* resampler);
  void SetBandwidthFilter(vtkKernelBandwidthFilter* filter);
  void SetCloudActor(vtkActor* actor);
  void SetProps(vtkHapticProps* props);
  void SetChart(vtkHapticChart* chart);
  void SetOverlay(vtkHapticOverlay* overlay);
  void SetSliders(vtkHapticSliders* sliders);
  ///@}

  /**
   * What an exact surface would answer the hand of a tick, in newtons, for the chart; NaN: not known. Called
   * for every tick in the order of time (pointhaptics::IdealForce is made for it). Empty (default): none.
   */
  void SetIdealForce(std::function<double(const pointhaptics::Vec3& hip)> ideal);

  ///@{
  /**
   * The gestures of an action, separated by spaces (see HapticBindings); SetBinding() takes them from the
   * actions that had them, and brings the overlay's help up to date.
   */
  void SetBinding(pointhaptics::HapticAction action, const std::string& gestures);
  std::string GetBinding(pointhaptics::HapticAction action) const;
  ///@}

  /**
   * Box of the hand, xmin, xmax, ymin, ymax, zmin, zmax: the model turns and zooms about its centre, steps of
   * shift and depth are parts of its longest edge. Default: the 10 cm cube about the origin.
   */
  void SetWorkspaceBounds(const double bounds[6]);

  ///@{
  /**
   * Use VoxelCovariance in the scenes if the resampler makes it. Default: on.
   */
  vtkSetMacro(UseCovariance, bool);
  vtkGetMacro(UseCovariance, bool);
  ///@}

  ///@{
  /**
   * While the model rests, feel scenes near the hand that are as fine as the points there, where that tells
   * more than the resampler's voxels. They are made in the background from the cloud itself, in some
   * milliseconds; until they are there the whole cloud's is felt. Of no effect without UseCovariance. Belongs
   * to the next scene that is made. Default: off.
   */
  vtkSetMacro(RefinesNearHand, bool);
  vtkGetMacro(RefinesNearHand, bool);
  ///@}

  ///@{
  /**
   * Add the arrays of pointhaptics::addSurfaceArrays() to the means that are shown: the distance of each from
   * the surface that is felt, and its normals. They come some time after the scene is felt, and while the
   * model moves the picture keeps those it has. A change marks the model as changed. Default: off.
   */
  void SetComputeResiduals(bool on);
  bool GetComputeResiduals() const { return this->ComputeResiduals; }
  void SetComputeNormals(bool on);
  bool GetComputeNormals() const { return this->ComputeNormals; }
  ///@}

  ///@{
  /**
   * The model transform. SetModelMatrix() sets it together with what ResetModel() goes back to, and marks the
   * model as changed; the transform itself is for reading.
   */
  void SetModelMatrix(vtkMatrix4x4* matrix);
  vtkTransform* GetModelTransform();
  ///@}

  /**
   * The same for a model whose scene was made elsewhere, with the settings of the given filters, and whose
   * means are the output of the last of these: it is felt and shown without being resampled. Null: there is
   * no point in the workspace.
   */
  void AdoptModel(vtkMatrix4x4* matrix, std::shared_ptr<const pointhaptics::HapticScene> scene);

  ///@{
  /**
   * Change the model: turn about an axis of the workspace through its centre (degrees, right-handed), shift
   * (metres), zoom about the centre (factor above 0), back to SetModelMatrix(). Values that are not finite
   * are ignored.
   */
  void TurnModel(double degrees, const pointhaptics::Vec3& axis);
  void ShiftModel(const pointhaptics::Vec3& offset);
  void ZoomModel(double factor);
  void ResetModel();
  ///@}

  /**
   * Take back the last change of the model: a whole drag, a key, a turn of the wheel's notch, a push of the
   * SpaceMouse's cap. The last 100 are kept; SetModelMatrix() forgets them. False: there is none.
   */
  bool UndoModel();

  /**
   * Something else changed that the scene is made from, such as the voxel size or the filters' settings: the
   * next UpdateModel() or timer event makes a new one.
   */
  void InvalidateModel();

  /**
   * Wait until the scene of the model as it is now is made, published and shown, if it is not yet. The timer
   * does it otherwise, without waiting. False: there is no point in the workspace (an empty scene was
   * published).
   */
  bool UpdateModel();
  bool IsModelChanged() const;

  /**
   * How often the cloud was resampled by this style's worker.
   */
  std::uint64_t GetNumberOfBuilds() const;

  ///@{
  /**
   * Start and stop the repeating timer, after vtkRenderWindowInteractor::Initialize(). Milliseconds, at
   * least 1.
   */
  void StartUpdates(unsigned long milliseconds = 33);
  void StopUpdates();
  ///@}

  /**
   * What the timer does: model, props, chart and status up to date, and a render if something changed.
   */
  void Refresh();

  ///@{
  /**
   * Hand mode: the simulated hand follows the mouse pointer in the view plane at its depth. Default: off.
   */
  void SetHandMode(bool on);
  bool GetHandMode() const;
  ///@}

  ///@{
  /**
   * In hand mode, push the mouse pointer out of what the hand touches: the pointer goes to where the surface
   * has pushed the simulated hand, and the person has to push against it. Default: off.
   */
  void SetPushPointer(bool on);
  bool GetPushPointer() const;
  ///@}

  /**
   * What the hand does to the model at this moment: ShiftModelByHand, TurnModelByHand, IndexByHand,
   * ZoomModelByHand, or None.
   */
  pointhaptics::HapticAction GetHold() const;

  ///@{
  /**
   * Move the simulated hand, metres in the workspace frame; clamped to the workspace.
   */
  void MoveHand(const pointhaptics::Vec3& offset);
  /// Away from the person (positive) or back, along the view direction.
  void MoveHandInDepth(double metres);
  ///@}

  /**
   * Text at the end of the status line, such as the scale of the model.
   */
  void SetStatusNote(const std::string& note);

  /**
   * The device's own line in the panel of the servo loop: what it is and how it is.
   */
  void SetDeviceNote(const std::string& note);

  /**
   * Show position, voxel, bandwidth and arrays of the voxel mean at a display position in the overlay, and
   * mark it in the picture (vtkPickMarker), until the model moves. False: no mean is drawn within 8 pixels of
   * it; none is shown then.
   */
  bool PickAt(int x, int y);

  /**
   * Show or hide the chart; the picture takes the room it leaves.
   */
  void SetChartVisibility(bool visible);

  ///@{
  /**
   * Show rate, latencies, missed ticks, faults and the device in the overlay. Default: off.
   */
  void SetServoPanelVisibility(bool visible);
  bool GetServoPanelVisibility() const;
  ///@}

  /**
   * What the default keys and gestures do, one thing a line.
   */
  static const char* GetHelpText();

  void OnMouseMove() override;
  void OnLeftButtonDown() override;
  void OnLeftButtonUp() override;
  void OnMiddleButtonDown() override;
  void OnMiddleButtonUp() override;
  void OnRightButtonDown() override;
  void OnRightButtonUp() override;
  void OnMouseWheelForward() override;
  void OnMouseWheelBackward() override;
  void OnKeyPress() override;
  void OnKeyRelease() override;
  void OnLeave() override;
  void OnChar() override;
  void OnTimer() override;
  void OnDropFiles(vtkStringArray* filePaths) override;

protected:
  vtkInteractorStyleHaptic();
  ~vtkInteractorStyleHaptic() override;

  bool UseCovariance = true;
  bool RefinesNearHand = false;
  bool ComputeResiduals = false;
  bool ComputeNormals = false;

private:
  vtkInteractorStyleHaptic(const vtkInteractorStyleHaptic&) = delete;
  void operator=(const vtkInteractorStyleHaptic&) = delete;

  void ModelChanged();
  void MoveScene();
  bool IsCloudSent() const;
  void PreviewModel();
  void StopBuilding();
  void SendCloud();
  pointhaptics::SceneRequest MakeRequest();
  void RequestScene();
  bool ShowScene();
  void ShowBuilt(const pointhaptics::BuiltScene& built);
  void DragModel();
  void DragHand();
  void Wheel(int direction);
  void MoveBySpaceMouse();
  void MoveByHand();
  void TakeHandSample(const pointhaptics::ServoSample& sample);
  void BeginHold(pointhaptics::HapticAction action, const pointhaptics::Vec3& hand);
  void EndHold();
  void MoveModelByHand();
  void LetGoOfModel();
  bool PressHandButton(pointhaptics::HapticAction action);
  bool ReleaseHandButton(pointhaptics::HapticAction action);
  void ReleaseHandKeys();
  void PushPointer();
  void PlacePointer(const pointhaptics::Vec3& point);
  bool Do(pointhaptics::HapticAction action);
  void Press(const char* button);
  void Release();
  void RememberModel();
  bool ModelKey(pointhaptics::HapticAction action);
  bool HandKey(pointhaptics::HapticAction action);
  bool ShowKey(pointhaptics::HapticAction action);
  bool ProgramKey(pointhaptics::HapticAction action);
  void ToggleChart();
  std::string ServoPanelText();
  bool ReadServo();
  bool UpdateStatus();
  void ForgetPicked();
  void RenderNow();
  vtkRenderer* MainRenderer();

  struct Internals;
  std::unique_ptr<Internals> Parts;
};

#endif
