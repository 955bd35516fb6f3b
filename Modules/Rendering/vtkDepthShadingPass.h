/**
 * @class   vtkDepthShadingPass
 * @brief   Eye-dome lighting for point clouds: darkens what lies behind its surroundings.
 *
 * Renders its delegate (a vtkCameraPass), fills pixels that lie behind nearly all around them, the holes
 * between splats, and darkens each by how far it lies behind what is on both sides of it, at three distances
 * in the picture: points without normals show their shape. It differs from vtkEDLShading in four ways:
 * - opposite sides are taken together: a slope is as light as a plane that faces the viewer, and a splat in
 *   front of a surface draws no outline on it;
 * - the background is never darkened, and darkens nothing;
 * - what lies deeper by no more than the noise of the cloud stays as light as the rest;
 * - its steps have full resolution, and cost a software renderer a sixth as much or less.
 *
 * The camera's clipping range is widened to powers of the fourth root of 2: where it is reset, or another
 * prop comes into the scene, the picture of an equal view stays the same to the bit.
 *
 * In a window with a picture for each eye (vtkRenderWindow::StereoRender) each has kept pictures of its own.
 *
 * Sizes in pixels are those of a window of 800 lines and grow with it.
 *
 * A picture in which only text changed (vtkActor2D) is not drawn anew: the delegate's last one is taken.
 *
 * A picture is first drawn with one sample a pixel. Each that AddSamples() asks for is drawn elsewhere within
 * the pixels and averaged with those before: edges get smooth where there is time, in frames of equal length.
 *
 * Where the processor draws, a picture in motion has kMostMovingPixels at most, spread over the window.
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

#include <array>  // For members
#include <memory> // For std::unique_ptr
#include <string> // For shaders
#include <vector> // For members

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;

class POINTHAPTICSRENDERING_EXPORT vtkDepthShadingPass : public vtkDepthImageProcessingPass
{
public:
  static vtkDepthShadingPass* New();
  vtkTypeMacro(vtkDepthShadingPass, vtkDepthImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What lies less than this behind its neighbours, in the units of the scene, stays as light as they are:
   * the splats of a noisy wall do not cast shadows on each other. 0 and above; default 0.
   */
  vtkSetClampMacro(NoiseLength, double, 0.0, 1e12);
  vtkGetMacro(NoiseLength, double);
  ///@}

  ///@{
  /**
   * The same over the distance from the camera, for depth cameras. Added to NoiseLength. Default 0.
   */
  vtkSetClampMacro(NoisePerDistance, double, 0.0, 1.0);
  vtkGetMacro(NoisePerDistance, double);
  ///@}

  ///@{
  /**
   * A point as deep as far on all sides keeps exp(-Strength) of its lightness. 0: none is darkened. Default
   * 1.6.
   */
  vtkSetClampMacro(Strength, double, 0.0, 100.0);
  vtkGetMacro(Strength, double);
  ///@}

  ///@{
  /**
   * Whether holes of a pixel or two are filled. Default: on.
   */
  vtkSetMacro(FillsPinholes, bool);
  vtkGetMacro(FillsPinholes, bool);
  ///@}

  ///@{
  /**
   * Lightness that is left to the darkest points, 0 to 1; default 0.25.
   */
  vtkSetClampMacro(MinimumLightness, double, 0.0, 1.0);
  vtkGetMacro(MinimumLightness, double);
  ///@}

  /// Of a picture in motion that the processor draws: 30 a second of a window of 1280 x 800 on two cores.
  static constexpr int kMostMovingPixels = 400000;
  ///@{
  /**
   * Whether the coming picture is one of a motion, seen for a moment. Default: off.
   */
  vtkSetMacro(IsMoving, bool);
  vtkGetMacro(IsMoving, bool);
  ///@}
  /**
   * Lines of the picture that @p renderer draws over those it has in the window: 1, or less in motion.
   */
  static double ResolutionOf(vtkRenderer* renderer);

  /// That of @p renderer, made by applyDepthShading(); null: it has none.
  static vtkDepthShadingPass* GetPassOf(vtkRenderer* renderer);

  /// Samples of a pixel that tell: the first in its middle, the others about it.
  static constexpr int kMostSamples = 5;
  /**
   * The next frame draws up to @p count samples more of its picture, until it has kMostSamples. A picture
   * that is not the kept one begins anew, with one sample more.
   */
  void AddSamples(int count) { this->SamplesToAdd = this->SamplesToAddRight = count; }
  /**
   * Those of the picture that was shown last; 0: none was.
   */
  vtkGetMacro(NumberOfSamples, int);

  /**
   * How often the delegate has drawn another picture.
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

  void RenderEye(const vtkRenderState* state);
  void RenderRightEye(const vtkRenderState* state);
  void ChooseResolution(const vtkRenderState* state, vtkOpenGLRenderWindow* window);
  void PrepareTargets(vtkOpenGLRenderWindow* window);
  bool PrepareQuad(std::unique_ptr<vtkOpenGLQuadHelper>& quad, const std::string& fragment,
    vtkOpenGLRenderWindow* window, bool isBehindAll = false);
  void SetUniforms(
    vtkShaderProgram* program, vtkTextureObject* colors, vtkTextureObject* depths, vtkRenderer* renderer);
  void DrawSample(const vtkRenderState* state, vtkOpenGLRenderWindow* window);
  void ForgetPicture();
  void DrawSamples(const vtkRenderState* state, vtkOpenGLRenderWindow* window, int count);
  void ShadeKept(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void AddToSum(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void FillPinholes(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void DrawPicture(vtkTextureObject* colors, vtkTextureObject* depths, int samples, vtkRenderer* renderer,
    vtkOpenGLRenderWindow* window);
  void Show(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void SetShade(vtkOpenGLQuadHelper& quad);
  void Draw(
    vtkOpenGLQuadHelper& quad, vtkTextureObject* colors, vtkTextureObject* depths, vtkRenderer* renderer);
  vtkTextureObject* ShownColors();
  vtkTextureObject* ShownDepths();

  double NoiseLength = 0.0;
  double NoisePerDistance = 0.0;
  double Strength = 1.6;
  double MinimumLightness = 0.25;
  bool FillsPinholes = true;
  bool IsMoving = false;
  double Resolution = 1.0;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Frame;
  vtkSmartPointer<vtkTextureObject> Colors;
  vtkSmartPointer<vtkTextureObject> Depths;
  vtkSmartPointer<vtkOpenGLFramebufferObject> FilledFrame;
  vtkSmartPointer<vtkTextureObject> FilledColors;
  vtkSmartPointer<vtkTextureObject> FilledDepths;
  // Of pictures with several samples: the sum of the shaded ones, and the depths of the first.
  vtkSmartPointer<vtkOpenGLFramebufferObject> SumFrame;
  vtkSmartPointer<vtkTextureObject> Sum;
  vtkSmartPointer<vtkTextureObject> FirstDepths;
  std::unique_ptr<vtkOpenGLQuadHelper> FillQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> CopyQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> ShadeQuad;
  std::vector<double> Kept; // what the textures show, see pictureState()
  bool KeptIsShaded = false;
  std::array<double, 6> KeptNumbers{}; // all settings they were made with
  int SamplesToAdd = 0;
  int SamplesToAddRight = 0; // for the right eye
  vtkSmartPointer<vtkDepthShadingPass> RightEye;
  bool IsRightEye = false;
  int NumberOfSamples = 0;
  vtkTypeUInt64 NumberOfPictures = 0;
};
