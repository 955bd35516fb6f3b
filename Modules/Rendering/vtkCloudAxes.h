/**
 * @class   vtkCloudAxes
 * @brief   a box about the cloud with labels in coordinates of the cloud, and where its axes point
 *
 * The box turns with the model; three of its edges, those at the outline of the picture, carry ticks, and
 * beside each stand the bounds along it. An orientation marker in the lower right corner shows the directions
 * of x (red), y (green) and z (blue). Ticks, texts and marker are pixels, placed at the start of each render
 * of the renderer: nothing is done while nothing is rendered or while it is hidden.
 *
 * Use:
 *
 * @code
 * vtkNew< vtkCloudAxes > axes;
 * axes->SetBounds(cloud->GetBounds());
 * axes->SetModelMatrix(style->GetModelTransform()->GetMatrix());
 * axes->AddTo(renderer);
 * axes->SetVisibility(true);
 * @endcode
 *
 * Not thread safe: GUI thread only.
 */
#ifndef vtkCloudAxes_h
#define vtkCloudAxes_h

#include "PointHapticsRenderingModule.h" // For export macro
#include "vtkObject.h"

#include <array>      // For places
#include <functional> // For SetTaken
#include <memory>     // For Internals
#include <string>     // For the unit
#include <vector>     // For places

class vtkMatrix4x4;
class vtkRenderer;

class POINTHAPTICSRENDERING_EXPORT vtkCloudAxes : public vtkObject
{
public:
  static vtkCloudAxes* New();
  vtkTypeMacro(vtkCloudAxes, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The box: xmin, xmax, ymin, ymax, zmin, zmax in coordinates of the cloud. Default: the unit cube.
   */
  void SetBounds(const double bounds[6]);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Unit of the cloud's coordinates, as it stands behind the bounds. Default: "m".
   */
  void SetUnitName(const std::string& name);
  const std::string& GetUnitName() const { return this->UnitName; }
  ///@}

  /**
   * From coordinates of the cloud to those of the picture; copied. Default: the identity.
   */
  void SetModelMatrix(vtkMatrix4x4* matrix);

  /**
   * Asked before each render: where no texts may stand, pixels of the renderer: left, bottom, right, top of
   * each. It may be empty.
   */
  void SetTaken(std::function<std::vector<std::array<double, 4>>()> taken);

  ///@{
  /**
   * Show or hide. Default: off.
   */
  void SetVisibility(bool visible);
  vtkGetMacro(Visibility, bool);
  ///@}

  ///@{
  /**
   * Add it to @p renderer, or take it out. What is added to the renderer later is drawn over the texts.
   */
  void AddTo(vtkRenderer* renderer);
  void RemoveFrom(vtkRenderer* renderer);
  ///@}

protected:
  vtkCloudAxes();
  ~vtkCloudAxes() override;

  void PlaceBox();
  void PlaceLabels();

  double Bounds[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  std::string UnitName = "m";
  bool Visibility = false;

private:
  vtkCloudAxes(const vtkCloudAxes&) = delete;
  void operator=(const vtkCloudAxes&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Parts;
};

#endif
