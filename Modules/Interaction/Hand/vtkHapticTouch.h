/**
 * @class   vtkHapticTouch
 * @brief   pointhaptics::HapticTouch as a VTK object, for programs in Python
 *
 * Use, where a vtkInteractorStyleHaptic has a resampler and is that of an interactor with a window:
 *
 * @code{.py}
 * touch = ph.vtkHapticTouch()
 * touch.Run(style)         # until the window is closed
 * @endcode
 *
 * GUI thread only. Lengths are metres in the frame of the workspace, forces newtons.
 *
 * @warning What fails is an error of the style (vtkErrorMacro) in Run(), and GetMessage() after Start().
 * @sa vtkInteractorStyleHaptic
 */
#ifndef vtkHapticTouch_h
#define vtkHapticTouch_h

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkObject.h"

#include <memory> // For Impl
#include <string> // For names

class vtkInteractorStyleHaptic;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticTouch : public vtkObject
{
public:
  static vtkHapticTouch* New();
  vtkTypeMacro(vtkHapticTouch, vtkObject);

  ///@{
  /**
   * "simulated" (default): a hand that the mouse and MoveHand() move; "falcon": a Novint Falcon. A touch that
   * is on stops.
   */
  void SetDeviceName(const std::string& name);
  const std::string& GetDeviceName() const { return this->DeviceName; }
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
   * As of pointhaptics::HapticTouch: shows the window of the style and touches its model; false: GetMessage()
   * says why. Run() returns when the window was closed.
   */
  bool Start(vtkInteractorStyleHaptic* style);
  void Stop();
  bool Run(vtkInteractorStyleHaptic* style);
  bool IsOn() const;
  const std::string& GetMessage() const { return this->Message; }
  ///@}

  /**
   * Sets the target of the simulated hand. The servo loop moves the hand there; no effect while the touch is
   * off.
   */
  void MoveHand(double x, double y, double z);

  ///@{
  /**
   * Position of the hand and force on it in the newest tick; 0, 0, 0 while the touch is off.
   */
  void GetHand(double position[3]) const;
  void GetForce(double force[3]) const;
  ///@}

protected:
  vtkHapticTouch();
  ~vtkHapticTouch() override;

private:
  bool Make(vtkInteractorStyleHaptic* style);

  struct Internals;
  std::unique_ptr<Internals> Impl;
  std::string DeviceName = "simulated";
  double StartPosition[3] = { 0.0, 0.0, 0.0 };
  std::string Message;

  vtkHapticTouch(const vtkHapticTouch&) = delete;
  void operator=(const vtkHapticTouch&) = delete;
};

#endif
