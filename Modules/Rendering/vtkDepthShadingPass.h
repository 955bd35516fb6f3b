/**
 * @class   vtkDepthShadingPass
 * @brief   Eye-dome lighting for point clouds: darkens what lies behind its surroundings.
 *
 * Renders its delegate (a vtkCameraPass) and darkens each point by how far it lies behind eight of its
 * neighbours in the picture, so that points without normals show their shape. It differs from vtkEDLShading
 * in three ways:
 * - the background is never darkened, neither around the cloud nor where it shines through gaps between
 *   points;
 * - its strength is a number (DepthScale), not that of the bounds of what is visible;
 * - it is one step at full resolution, which costs a software renderer less than half as much.
 *
 * A picture in which only text changed (vtkActor2D) is not drawn anew: the delegate's last one is taken.
 *
 * The depth of the delegate's picture becomes that of the frame buffer: what is picked by depth still is.
 *
 * @warning Needs the OpenGL back end. GUI thread only.
 * @sa vtkEDLShading vtkCameraPass
 */
#pragma once

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkDepthImageProcessingPass.h"
#include "vtkSmartPointer.h" // For members

#include <memory> // For std::unique_ptr
#include <vector> // For members

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;

class POINTHAPTICSRENDERING_EXPORT vtkDepthShadingPass : public vtkDepthImageProcessingPass
{
public:
  static vtkDepthShadingPass* New();
  vtkTypeMacro(vtkDepthShadingPass, vtkDepthImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A point that lies this much behind all its neighbours, in the units of the scene, keeps 1/e of its
   * lightness; one and a half times as much, and more, leave 22 %, though never less than MinimumLightness.
   * Above 0; default 0.01, a tenth of the haptic workspace.
   */
  vtkSetClampMacro(DepthScale, double, 1e-12, 1e12);
  vtkGetMacro(DepthScale, double);
  ///@}

  ///@{
  /**
   * What lies less than this behind its neighbours, in the units of the scene, stays as light as they are:
   * the splats of a noisy wall do not cast shadows on each other. 0 and above; default 0.
   */
  vtkSetClampMacro(DepthTolerance, double, 0.0, 1e12);
  vtkGetMacro(DepthTolerance, double);
  ///@}

  ///@{
  /**
   * Lightness that is left to the darkest points, 0 to 1; default 0.35.
   */
  vtkSetClampMacro(MinimumLightness, double, 0.0, 1.0);
  vtkGetMacro(MinimumLightness, double);
  ///@}

  /**
   * How often the delegate has drawn.
   */
  vtkGetMacro(NumberOfPictures, vtkTypeUInt64);

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkDepthShadingPass();
  ~vtkDepthShadingPass() override;

private:
  vtkDepthShadingPass(const vtkDepthShadingPass&) = delete;
  void operator=(const vtkDepthShadingPass&) = delete;

  void PrepareTargets(vtkOpenGLRenderWindow* window);
  void Shade(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);

  double DepthScale = 0.01;
  double DepthTolerance = 0.0;
  double MinimumLightness = 0.35;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Frame;
  vtkSmartPointer<vtkTextureObject> Colors;
  vtkSmartPointer<vtkTextureObject> Depths;
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  std::vector<double> Kept; // what Colors and Depths show, see pictureState()
  bool KeptIsShaded = false;
  double KeptDepthScale = 0.0;
  double KeptDepthTolerance = 0.0;
  double KeptMinimumLightness = 0.0;
  vtkTypeUInt64 NumberOfPictures = 0;
};
