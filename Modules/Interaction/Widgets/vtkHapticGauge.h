/**
 * @class   vtkHapticGauge
 * @brief   a bar with the force in newtons, beside a point of the picture
 *
 * Stands a few pixels beside the display position of its anchor, whatever the camera does, on the other side
 * or higher or lower where that is out of the picture or taken. The bar is full at MaximumForce, the number
 * says how much it is. Both are as large as the window's dots per inch say.
 *
 * Frame: workspace, metres and newtons. GUI thread only.
 * @sa vtkHapticProps
 */
#ifndef vtkHapticGauge_h
#define vtkHapticGauge_h

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkObject.h"

#include <array>      // For places
#include <functional> // For SetTaken
#include <memory>     // For Internals
#include <vector>     // For places

class vtkRenderer;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticGauge : public vtkObject
{
public:
  static vtkHapticGauge* New();
  vtkTypeMacro(vtkHapticGauge, vtkObject);

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

  /**
   * Put number and bar on an opaque plate. Default: off.
   */
  void SetOpaque(bool opaque);

  /**
   * Asked before each render: what is taken, pixels of the renderer: left, bottom, right, top of each. It may
   * be empty.
   */
  void SetTaken(std::function<std::vector<std::array<double, 4>>()> taken);

  /**
   * Keep off the line from @p begin to @p end, of the workspace: an end of it beside the number reads like a
   * sign. Equal ends, the default: there is none.
   */
  void KeepOffLine(const double begin[3], const double end[3]);

  /**
   * Where it stood in the last render, as SetTaken() has it.
   */
  std::array<double, 4> GetPlace() const;

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

  void Arrange();

  double MaximumForce = 8.0;

private:
  vtkHapticGauge(const vtkHapticGauge&) = delete;
  void operator=(const vtkHapticGauge&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Parts;
};

#endif
