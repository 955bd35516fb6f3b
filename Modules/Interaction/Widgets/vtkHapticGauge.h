/**
 * @class   vtkHapticGauge
 * @brief   a bar with the force in newtons, beside a point of the picture
 *
 * Stands a few pixels beside the display position of its anchor, whatever the camera does. The bar is full at
 * MaximumForce, the number says how much it is.
 *
 * Frame: workspace, metres and newtons. GUI thread only.
 * @sa vtkHapticProps
 */
#ifndef vtkHapticGauge_h
#define vtkHapticGauge_h

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkObject.h"

#include <memory> // For Internals

class vtkRenderer;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticGauge : public vtkObject
{
public:
  static vtkHapticGauge* New();
  vtkTypeMacro(vtkHapticGauge, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Newtons of the full bar; above 0. Default: 8, what a Falcon can do.
   */
  vtkSetClampMacro(MaximumForce, double, 1e-3, 1e6);
  vtkGetMacro(MaximumForce, double);
  ///@}

  /**
   * Show @p newtons beside @p anchor, of the workspace. What is not finite is ignored.
   */
  void Show(const double anchor[3], double newtons);

  ///@{
  /**
   * Stand to the left of the anchor instead of to the right. Default: off.
   */
  void SetLeft(bool left);
  bool GetLeft() const;
  ///@}

  ///@{
  /**
   * Show or hide. Default: off until the first Show().
   */
  void SetVisibility(bool visible);
  bool GetVisibility() const;
  ///@}

  ///@{
  /**
   * Add it to @p renderer, or take it out.
   */
  void AddTo(vtkRenderer* renderer);
  void RemoveFrom(vtkRenderer* renderer);
  ///@}

protected:
  vtkHapticGauge();
  ~vtkHapticGauge() override;

  double MaximumForce = 8.0;

private:
  vtkHapticGauge(const vtkHapticGauge&) = delete;
  void operator=(const vtkHapticGauge&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Parts;
};

#endif
