/**
 * @class   vtkHapticTouch
 * @brief   the touch of a program that has none yet: device, servo loop and props for an interactor style
 *
 * Use, where a vtkInteractorStyleHaptic has a resampler and is that of an interactor with a window; the same
 * calls in C++ and Python:
 *
 * @code{.py}
 * touch = ph.vtkHapticTouch()
 * touch.Run(style)         # until the window is closed
 * @endcode
 *
 * GUI thread only. Lengths are metres in the frame of the workspace, forces newtons.
 *
 * @warning What fails is an error of the style (vtkErrorMacro) in Run(), and GetMessage() after Start(). The
 * style may end before or after this.
 * @sa vtkInteractorStyleHaptic
 */
#ifndef vtkHapticTouch_h
#define vtkHapticTouch_h

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkObject.h"

#include <memory> // For Impl
#include <string> // For names

class vtkInteractorStyleHaptic;

namespace pointhaptics
{
class HapticDevice;
class ServoLoop;
}

class POINTHAPTICSINTERACTION_EXPORT vtkHapticTouch : public vtkObject
{
public:
  static vtkHapticTouch* New();
  vtkTypeMacro(vtkHapticTouch, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * "simulated" (default): a hand that the mouse and MoveHand() move; "falcon": a Novint Falcon. A touch that
   * is on stops.
   */
  void SetDeviceName(const std::string& name);
  const std::string& GetDeviceName() const { return this->DeviceName; }
  ///@}

  /**
   * A device in the place of the named one; not owned, closed, it must outlive this. Null: the named one.
   */
  void SetDevice(pointhaptics::HapticDevice* device);

  ///@{
  /**
   * Start() gives the style device, servo loop and props, shows the window, makes the scene, opens the
   * device, and starts the servo loop and the style's timer. False: GetMessage() says what failed, and the
   * touch is stopped; or it was on already and stays so. A model without a mean in the hand's box is a
   * failure, as nothing could be touched. In a window that shows nothing yet, the means are drawn. Run()
   * returns when the window was closed.
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
  pointhaptics::ServoLoop& Servo();

protected:
  vtkHapticTouch();
  ~vtkHapticTouch() override;

private:
  bool Adopt(vtkInteractorStyleHaptic* style);
  bool Fail(const std::string& message);
  std::string ProblemOfReach() const;
  void ShowMeans();

  struct Internals;
  std::unique_ptr<Internals> Impl;
  std::string DeviceName = "simulated";
  std::string Message;

  vtkHapticTouch(const vtkHapticTouch&) = delete;
  void operator=(const vtkHapticTouch&) = delete;
};

#endif
