/**
 * @class   vtkOverlayActor
 * @brief   a mark in the scene, drawn over the finished picture of the cloud
 *
 * Drawn with the overlays, by the depths of the picture in the frame buffer: a shading by depth
 * (vtkDepthShadingPass) neither darkens it nor takes it for a step of the surface, and where it moves the
 * cloud need not be drawn again. What hides it leaves as much of it as HiddenOpacity says.
 *
 * Colour, light, line width and opacity where it is seen are those of its property. Its bounds widen neither
 * the view nor the clipping range, and the clipping range cuts nothing off it.
 *
 * @warning Needs the OpenGL back end. GUI thread only.
 * @sa vtkDepthShadingPass vtkWorkspaceBrackets
 */
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkNew.h"
#include "vtkOpenGLActor.h"
#include "vtkPolyDataMapper.h" // For members

class vtkAlgorithmOutput;
class vtkPolyData;
class vtkRenderer;

class POINTHAPTICSRENDERING_EXPORT vtkOverlayActor : public vtkOpenGLActor
{
public:
  static vtkOverlayActor* New();
  vtkTypeMacro(vtkOverlayActor, vtkOpenGLActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Kept. Lines and polygons; colours of its points are not shown.
   */
  void SetShape(vtkPolyData* shape);
  void SetShape(vtkAlgorithmOutput* shape);
  ///@}

  ///@{
  /**
   * Opacity where something hides it; 0 (default): not drawn there.
   */
  vtkSetClampMacro(HiddenOpacity, double, 0.0, 1.0);
  vtkGetMacro(HiddenOpacity, double);
  ///@}

  int RenderOpaqueGeometry(vtkViewport*) override { return 0; }
  int RenderTranslucentPolygonalGeometry(vtkViewport*) override { return 0; }
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  int RenderOverlay(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkOverlayActor();
  ~vtkOverlayActor() override;

private:
  vtkOverlayActor(const vtkOverlayActor&) = delete;
  void operator=(const vtkOverlayActor&) = delete;

  double HiddenOpacity = 0.0;
  vtkNew<vtkPolyDataMapper> Shape;
  vtkNew<vtkActor> Hidden; // its looks where something hides it
};
