/**
 * @class   vtkWorkspaceBrackets
 * @brief   the corners of a box, drawn over the shaded picture
 *
 * Shows where the hand can reach without a cage in front of the cloud: the outer 6 % of each edge of the box,
 * faintly, and fainter still where the cloud hides them.
 *
 * @warning Needs the OpenGL back end. GUI thread only.
 * @sa vtkOverlayActor vtkDepthShadingPass
 */
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkNew.h" // For members
#include "vtkOverlayActor.h"

class vtkPolyData;

class POINTHAPTICSRENDERING_EXPORT vtkWorkspaceBrackets : public vtkOverlayActor
{
public:
  static vtkWorkspaceBrackets* New();
  vtkTypeMacro(vtkWorkspaceBrackets, vtkOverlayActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The box: xmin, xmax, ymin, ymax, zmin, zmax.
   */
  void SetBox(const double box[6]);

protected:
  vtkWorkspaceBrackets();
  ~vtkWorkspaceBrackets() override;

private:
  vtkWorkspaceBrackets(const vtkWorkspaceBrackets&) = delete;
  void operator=(const vtkWorkspaceBrackets&) = delete;

  vtkNew<vtkPolyData> Lines;
  double Box[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
};
