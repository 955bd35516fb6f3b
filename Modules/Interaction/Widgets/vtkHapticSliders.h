/**
 * @class   vtkHapticSliders
 * @brief   sliders over the picture for what the touch depends on
 *
 * Stiffness (N/m), friction (mu_d), beta (proxy radius over bandwidth) and voxel size (mm), one below the
 * other at the right. They only hold numbers: ValueChangedEvent (call data: int*, the Slider
 * that moved) tells the program, which sets them where they belong. Stiffness, beta and voxel size move in
 * proportion (logarithmic), friction evenly.
 *
 * @code
 * sliders->SetInteractor(interactor);   // after it has its window
 * sliders->SetValue(vtkHapticSliders::Stiffness, 800.0);
 * style->SetSliders(sliders);           // its key shows and hides them
 * @endcode
 * A drag on a slider does not reach the interactor style. Not thread safe: GUI thread only.
 * @sa vtkInteractorStyleHaptic
 */
#ifndef vtkHapticSliders_h
#define vtkHapticSliders_h

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkCommand.h"                    // For UserEvent
#include "vtkObject.h"

#include <memory> // For Internals

class vtkRenderWindowInteractor;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticSliders : public vtkObject
{
public:
  static vtkHapticSliders* New();
  vtkTypeMacro(vtkHapticSliders, vtkObject);

  enum Slider
  {
    Stiffness,   ///< N/m, default 50 to 5000.
    Friction,    ///< mu_d, default 0 to 1.
    RadiusScale, ///< beta, default 1 to 16.
    VoxelSize,   ///< mm, default 0.1 to 10.
    NumberOfSliders
  };

  enum SliderEvents
  {
    ValueChangedEvent = vtkCommand::UserEvent + 7401
  };

  /**
   * Where the sliders live: in a renderer of their own, in layer 1 over the whole window of @p interactor,
   * which must have its window and outlive this or be set to null. Null takes them away.
   */
  void SetInteractor(vtkRenderWindowInteractor* interactor);

  ///@{
  /**
   * The number of a slider. SetValue() sends no event; a value outside the slider's range widens the range;
   * what is not finite, or not above 0 where the slider is logarithmic, is ignored.
   */
  void SetValue(int slider, double value);
  double GetValue(int slider) const;
  ///@}

  /**
   * Acts as a drag: takes @p part of the slider's way, 0 to 1, and sends ValueChangedEvent.
   */
  void MoveTo(int slider, double part);

  ///@{
  /**
   * Show the sliders. Default: off. Covered they are not seen, and no drag reaches them, as long as something
   * else lies over the picture.
   */
  void SetVisibility(bool visible);
  bool GetVisibility() const;
  void SetCovered(bool covered);
  ///@}

  /**
   * Put the texts on opaque plates. Default: off.
   */
  void SetOpaque(bool opaque);

  ///@{
  /**
   * For pointhaptics::ScreenLayout: the pixels that the sliders need with a font of @p font points, and their
   * box in pixels of the window. Without one they stand at the right: PreferredPlace() says where, for the
   * size that Measure() gave.
   */
  void Measure(int font, double size[2]);
  void PreferredPlace(const double size[2], double box[4]) const;
  void Place(double left, double bottom, double right, double top);
  ///@}

protected:
  vtkHapticSliders();
  ~vtkHapticSliders() override;

private:
  void ShowOrHide();
  double WayLength() const;

  vtkHapticSliders(const vtkHapticSliders&) = delete;
  void operator=(const vtkHapticSliders&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Parts;
};

#endif
