/**
 * @class   vtkWorkspaceBrackets
 * @brief   the corners of a box, drawn over the shaded picture
 *
 * Shows where the hand can reach without a cage in front of the cloud: the outer 6 % of each edge of the box,
 * faintly, and fainter still where the cloud hides them. Drawn with the overlays, so that a shading by depth
 * (vtkDepthShadingPass) neither darkens them nor is changed by them; needs the depths of the picture in the
 * frame buffer.
 *
 * @warning Needs the OpenGL back end. GUI thread only.
 * @sa vtkDepthShadingPass
 */
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h" // For members

class vtkPolyData;
class vtkRenderer;

class POINTHAPTICSRENDERING_EXPORT vtkWorkspaceBrackets : public vtkActor
{
public:
  static vtkWorkspaceBrackets* New();
  vtkTypeMacro(vtkWorkspaceBrackets, vtkActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The box: xmin, xmax, ymin, ymax, zmin, zmax.
   */
  void SetBox(const double box[6]);

  /**
   * Red, green and blue, 0 to 1. Default: a light grey, for a dark ground.
   */
  void SetColor(double red, double green, double blue);

  int RenderOpaqueGeometry(vtkViewport*) override { return 0; }
  int RenderTranslucentPolygonalGeometry(vtkViewport*) override { return 0; }
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  int RenderOverlay(vtkViewport* viewport) override;

protected:
  vtkWorkspaceBrackets();
  ~vtkWorkspaceBrackets() override;

private:
  vtkWorkspaceBrackets(const vtkWorkspaceBrackets&) = delete;
  void operator=(const vtkWorkspaceBrackets&) = delete;

  vtkNew<vtkPolyData> Lines;
  // Beside this actor, so that drawing changes nothing of it: what is unchanged is not drawn anew.
  struct Look
  {
    vtkNew<vtkPolyDataMapper> Mapper;
    vtkNew<vtkActor> Actor;
  };
  void Draw(Look& look, vtkRenderer* renderer);

  Look Seen;
  Look Hidden;
  double Box[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
};
