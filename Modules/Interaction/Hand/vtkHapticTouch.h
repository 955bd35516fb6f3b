/**
 * @class   vtkHapticTouch
 * @brief   the touch of a program that has none yet: device, servo loop and props for an interactor style
 *
 * Use, where a vtkInteractorStyleHaptic has a resampler and is that of an interactor with a window:
 *
 * @code{.py}
 * touch = ph.vtkHapticTouch()
 * touch.Run(style)         # until the window is closed
 * @endcode
 *
 * GUI thread only. Lengths are metres in the frame of the workspace, forces newtons. The style is kept; it
 * loses device and servo loop when this ends.
 *
 * @warning What fails is an error of the style (vtkErrorMacro) in Run(), and GetMessage() after Start().
 * @sa vtkInteractorStyleHaptic
 */
#ifndef vtkHapticTouch_h
#define vtkHapticTouch_h

#include "vtkHapticProps.h"           // For what is seen
#include "vtkInteractorStyleHaptic.h" // For the style

#include "Devices/HapticDevice.h"    // For the device
#include "Devices/SimulatedDevice.h" // For the usual device
#include "Haptics/ServoLoop.h"       // For the loop

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkNew.h" // For the props
#include "vtkObject.h"

#include <memory> // For the devices
#include <string> // For names

class POINTHAPTICSINTERACTION_EXPORT vtkHapticTouch : public vtkObject
{
public:
  static vtkHapticTouch* New();
  vtkTypeMacro(vtkHapticTouch, vtkObject);

  ///@{
  /**
   * "simulated" (default): a hand that the mouse and MoveHand() move; "falcon": a Novint Falcon. SetDevice(),
   * in C++: any other device, which is not owned and must outlive this; null: the named one. A touch that is
   * on stops.
   */
  void SetDeviceName(const std::string& name);
  const std::string& GetDeviceName() const { return this->DeviceName; }
  void SetDevice(pointhaptics::HapticDevice* device);
  ///@}

  ///@{
  /**
   * Where the simulated hand begins, metres, such as in front of a cloud about the origin: a hand that begins
   * inside feels nothing. A touch that is on stops. Default: 0, 0, 0.
   */
  void SetStartPosition(double x, double y, double z);
  vtkGetVector3Macro(StartPosition, double);
  ///@}

  ///@{
  /**
   * Gives @p style the parts, shows its window, makes the scene, opens the device, and starts the servo loop
   * and the style's timer. False: GetMessage() says what failed, and the touch is off; or it was on already
   * and stays so. A model without a mean in the hand's box is a failure, as nothing could be touched. In a
   * window that shows nothing yet, the means are drawn. Run() returns when the window was closed.
   */
  bool Start(vtkInteractorStyleHaptic* style);
  void Stop();
  bool Run(vtkInteractorStyleHaptic* style);
  bool IsOn() const { return this->Servo.running(); }
  const std::string& GetMessage() const { return this->Message; }
  ///@}

  /**
   * Sets the target of the simulated hand. The servo loop moves the hand there; no effect while the touch is
   * off.
   */
  void MoveHand(double x, double y, double z) { this->Hand->setTarget({ x, y, z }); }

  ///@{
  /**
   * Position of the hand and force on it in the newest tick; 0, 0, 0 while the touch is off.
   */
  void GetHand(double position[3]) const;
  void GetForce(double force[3]) const;
  ///@}

  /**
   * The loop, in C++: all that is felt, and the parameters of the touch.
   */
  pointhaptics::ServoLoop& GetServoLoop() { return this->Servo; }

protected:
  vtkHapticTouch();
  ~vtkHapticTouch() override;

private:
  vtkHapticTouch(const vtkHapticTouch&) = delete;
  void operator=(const vtkHapticTouch&) = delete;

  bool Take(vtkInteractorStyleHaptic* style);
  bool Fail(const std::string& message);
  std::string ProblemOfReach() const;
  void ShowMeans();
  pointhaptics::ProxyState Latest() const;

  vtkSmartPointer<vtkInteractorStyleHaptic> Style;
  std::string DeviceName = "simulated";
  double StartPosition[3] = { 0.0, 0.0, 0.0 };
  std::unique_ptr<pointhaptics::SimulatedDevice> Hand;
  std::unique_ptr<pointhaptics::HapticDevice> Falcon;
  pointhaptics::HapticDevice* Given = nullptr;
  pointhaptics::HapticDevice* Device = nullptr;
  vtkNew<vtkHapticProps> Props;
  std::string Message;
  pointhaptics::ServoLoop Servo; // last member: destroyed, and so stopped, first
};

#endif
