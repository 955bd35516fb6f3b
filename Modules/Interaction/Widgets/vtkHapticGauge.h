/**
 * @class   vtkHapticGauge
 * @brief   a bar with the force in newtons, beside a point of the picture
 *
 * Stands a few pixels beside the display position of its anchor, whatever the camera does, on the other side
 * or higher or lower where that is out of the picture or taken. The bar is full at 8 N, what a Falcon can do;
 * the number says how much it is. Both are as large as the window's dots per inch say.
 *
 * Frame: workspace, metres and newtons. GUI thread only.
 * @sa vtkHapticProps
 */
#ifndef vtkHapticGauge_h
#define vtkHapticGauge_h

#include "EventLink.h" // For the begin of a render
#include "PixelBox.h"  // For the bar

#include "Core/Base/Vector3.h" // For places

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkCoordinate.h"                 // For the anchor
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkTextActor.h"   // For the number
#include "vtkWeakPointer.h" // For the renderer

#include <array>      // For places
#include <functional> // For SetTaken
#include <utility>
#include <vector> // For places

class vtkRenderer;

namespace pointhaptics
{
struct Pixel;
} // namespace pointhaptics

class POINTHAPTICSINTERACTION_EXPORT vtkHapticGauge : public vtkObject
{
public:
  static vtkHapticGauge* New();
  vtkTypeMacro(vtkHapticGauge, vtkObject);

  /**
   * Show @p newtons beside @p anchor, of the workspace.
   */
  void Show(const double anchor[3], double newtons);

  ///@{
  /**
   * Stand to the left of the anchor instead of to the right. Default: off.
   */
  void SetLeft(bool left);
  bool GetLeft() const { return this->WantedSide < 0.0; }
  ///@}

  /**
   * Put number and bar on an opaque plate. Default: off.
   */
  void SetOpaque(bool opaque);

  /**
   * Asked before each render: what is taken, pixels of the renderer: left, bottom, right, top of each. It may
   * be empty.
   */
  void SetTaken(std::function<std::vector<std::array<double, 4>>()> taken) { this->Taken = std::move(taken); }

  /**
   * Keep off the line from @p begin to @p end, of the workspace: an end of it beside the number reads like a
   * sign. Equal ends, the default: there is none.
   */
  void KeepOffLine(const double begin[3], const double end[3]);

  /**
   * Where it stood in the last render, as SetTaken() has it.
   */
  const std::array<double, 4>& GetPlace() const { return this->Box; }

  ///@{
  /**
   * Show or hide. Default: off until the first Show().
   */
  void SetVisibility(bool visible);
  bool GetVisibility() const { return this->Number->GetVisibility() != 0; }
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

private:
  vtkHapticGauge(const vtkHapticGauge&) = delete;
  void operator=(const vtkHapticGauge&) = delete;

  std::array<vtkActor2D*, 4> All() { return { Ground.actor(), Fill.actor(), Frame.actor(), Number }; }
  void Arrange();
  void Place();
  void Try(double side, double higher, const pointhaptics::Pixel& at);

  pointhaptics::PixelBox Ground;
  pointhaptics::PixelBox Fill{ true, 0.95, 0.42, 0.02 };
  pointhaptics::PixelBox Frame{ false, 0.15, 0.15, 0.18 };
  /// The text's own position is pixels from a corner that follows the anchor.
  vtkNew<vtkTextActor> Number;
  vtkNew<vtkCoordinate> Anchor;
  double Part = 0.0;       // of the full bar
  double WantedSide = 1.0; // -1: left
  double Side = 1.0;
  double Higher = 0.0; // pixels
  double Pixels = 1.0; // of a point
  std::function<std::vector<std::array<double, 4>>()> Taken;
  pointhaptics::Vec3 LineBegin; // kept off; equal: there is none
  pointhaptics::Vec3 LineEnd;
  pointhaptics::EventLink OnStart{ [this] { this->Arrange(); } };
  vtkWeakPointer<vtkRenderer> Renderer;
  std::array<double, 4> Box{};
};

#endif
