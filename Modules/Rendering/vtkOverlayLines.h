/**
 * @class   vtkOverlayLines
 * @brief   lines in the scene, drawn over the shaded picture
 *
 * Drawn with the overlays, so that a shading by depth (vtkDepthShadingPass) neither darkens them nor takes
 * them for steps of the surface behind them; needs the depths of the picture in the frame buffer. What hides
 * them leaves as much of them as it is told.
 *
 * @warning Needs the OpenGL back end. GUI thread only.
 * @sa vtkDepthShadingPass vtkWorkspaceBrackets
 */
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h" // For members

class vtkPolyData;
class vtkRenderer;

class POINTHAPTICSRENDERING_EXPORT vtkOverlayLines : public vtkActor
{
public:
  static vtkOverlayLines* New();
  vtkTypeMacro(vtkOverlayLines, vtkActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Kept; to be marked as modified where it changes.
   */
  void SetLines(vtkPolyData* lines);

  /**
   * Red, green and blue, 0 to 1.
   */
  void SetColor(double red, double green, double blue);

  /**
   * Opacity where they are seen, and where something hides them; 0: not drawn there. Default: 1 and 0.
   */
  void SetOpacities(double seen, double hidden);

  /**
   * Pixels; default 1.
   */
  void SetLineWidth(float width);

  int RenderOpaqueGeometry(vtkViewport*) override { return 0; }
  int RenderTranslucentPolygonalGeometry(vtkViewport*) override { return 0; }
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  int RenderOverlay(vtkViewport* viewport) override;

protected:
  vtkOverlayLines();
  ~vtkOverlayLines() override;

private:
  vtkOverlayLines(const vtkOverlayLines&) = delete;
  void operator=(const vtkOverlayLines&) = delete;

  // Beside this actor, so that drawing changes nothing of it: what is unchanged is not drawn anew.
  struct Look
  {
    vtkNew<vtkPolyDataMapper> Mapper;
    vtkNew<vtkActor> Actor;
    double Opacity = 0.0;
  };
  static void Draw(Look& look, vtkRenderer* renderer);

  Look Seen;
  Look Hidden;
};
