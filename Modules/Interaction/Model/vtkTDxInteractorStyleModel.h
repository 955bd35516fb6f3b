/**
 * @class   vtkTDxInteractorStyleModel
 * @brief   the model under a 3D mouse that VTK itself reads
 *
 * VTK's windows invoke vtkCommand::TDxMotionEvent and TDxButtonPressEvent where VTK is built with
 * VTK_USE_TDX and the program calls vtkRenderWindowInteractor::UseTDxOn() or QVTK's equivalent. This moves
 * the model as pointhaptics::SpaceMouseController does, where vtkTDxInteractorStyleCamera moves the camera.
 * vtkInteractorStyleHaptic has one: see GetTDxStyle(). The Settings of the base class choose axes and speed.
 * A puck pushed to its end is taken to say 350, the number of the devices' own reports; AngleSensitivity and
 * TranslationX/Y/ZSensitivity adapt drivers that scale it.
 *
 * Button 1 held: pushing and pulling scales. Button 2: reset. GUI thread only.
 * @sa vtkInteractorStyleHaptic vtkTDxInteractorStyleCamera
 */
#ifndef vtkTDxInteractorStyleModel_h
#define vtkTDxInteractorStyleModel_h

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkTDxInteractorStyle.h"

#include <memory> // For the motion

namespace pointhaptics
{
class CapMotion;
class ModelTransform;
class ScreenView;
}

class POINTHAPTICSINTERACTION_EXPORT vtkTDxInteractorStyleModel : public vtkTDxInteractorStyle
{
public:
  static vtkTDxInteractorStyleModel* New();
  vtkTypeMacro(vtkTDxInteractorStyleModel, vtkTDxInteractorStyle);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Sets the model to move, seen on @p screen. Both are not owned; null takes them away.
   */
  void SetModel(pointhaptics::ModelTransform* model, const pointhaptics::ScreenView* screen);

  ///@{
  /**
   * VTK's events; the unit of the numbers is that of the driver.
   */
  void OnMotionEvent(vtkTDxMotionEventInfo* motionInfo) override;
  void OnButtonPressedEvent(int button) override;
  void OnButtonReleasedEvent(int button) override;
  ///@}

  /**
   * To be called from a timer: drivers do not say that the puck rests. A pause of 0.2 s means so, and ends
   * what one undo takes back.
   */
  void CheckForRest();

protected:
  vtkTDxInteractorStyleModel();
  ~vtkTDxInteractorStyleModel() override;

private:
  vtkTDxInteractorStyleModel(const vtkTDxInteractorStyleModel&) = delete;
  void operator=(const vtkTDxInteractorStyleModel&) = delete;

  std::unique_ptr<pointhaptics::CapMotion> Cap;
  bool Scales = false;
  double LastTime = -1e9;
};

#endif
