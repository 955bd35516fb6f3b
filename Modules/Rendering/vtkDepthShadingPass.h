/**
 * @class   vtkDepthShadingPass
 * @brief   Eye-dome lighting for point clouds: darkens what lies behind its surroundings.
 *
 * Renders its delegate (a vtkCameraPass) and darkens each pixel by how far it lies behind what is on both
 * sides of it, at three distances in the picture: points without normals show their shape. It differs from
 * vtkEDLShading in four ways:
 * - opposite sides are taken together: a slope is as light as a plane that faces the viewer, and a splat in
 *   front of a surface draws no outline on it;
 * - the background is never darkened, and darkens nothing;
 * - what lies deeper by no more than the noise of the cloud stays as light as the rest;
 * - its steps have full resolution, and cost a software renderer a sixth as much or less.
 *
 * With BlendsSplats the splats of one surface (vtkSplatMapper) are blended before they are shaded: colours
 * and depths of those within reach of the nearest are added, weighted towards their middles, and divided by
 * the weights. Large splats show no mosaic, and the rims of small ones are smooth.
 *
 * The camera's clipping range is widened to powers of the fourth root of 2: where it is reset, or another
 * prop comes into the scene, the picture of an equal view stays the same to the bit.
 *
 * In a window with a picture for each eye (vtkRenderWindow::StereoRender) each has kept pictures of its own.
 *
 * Sizes in pixels are those of a window of 800 lines and grow with it.
 *
 * A picture in which only what is drawn over it changed, text (vtkActor2D) and marks (vtkOverlayActor), is
 * not drawn anew: the last one is taken, with its depths.
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
#include "vtkMatrix4x4.h"    // For members
#include "vtkNew.h"          // For members
#include "vtkSmartPointer.h" // For members

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
   * Surfaces less than this behind their neighbours, in the units of the scene, stay as light as they are:
   * the splats of a noisy wall do not cast shadows on each other. 0 and above; default 0.
   */
  vtkSetClampMacro(NoiseLength, double, 0.0, 1e12);
  vtkGetMacro(NoiseLength, double);
  ///@}

  ///@{
  /**
   * Noise length over the distance from the camera, for depth cameras. Added to NoiseLength. Default 0.
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
   * Lightness that is left to the darkest points, 0 to 1; default 0.25.
   */
  vtkSetClampMacro(MinimumLightness, double, 0.0, 1.0);
  vtkGetMacro(MinimumLightness, double);
  ///@}

  /// Most pixels of a picture in motion that the processor draws: 30 a second of a window of 1280 x 800 on
  /// two cores.
  static constexpr int kMostMovingPixels = 400000;
  /// Most splat pixels that lie over each other in such a picture.
  static constexpr double kMostMovingFragments = 1.5e6;
  ///@{
  /**
   * Whether the coming picture is one of a motion, seen for a moment. Default: off.
   */
  vtkSetMacro(IsMoving, bool);
  vtkGetMacro(IsMoving, bool);
  ///@}
  ///@{
  /**
   * Pixels of the window that its splats cover, each on its own: of more than kMostMovingFragments a picture
   * in motion has fewer pixels. Default: 0.
   */
  vtkSetClampMacro(MovingFragments, double, 0.0, 1e12);
  vtkGetMacro(MovingFragments, double);
  ///@}
  /**
   * Lines of the picture that @p renderer draws over those it has in the window: 1, or less in motion.
   */
  static double ResolutionOf(vtkRenderer* renderer);

  /// The pass of @p renderer, made by applyDepthShading(); null: it has none.
  static vtkDepthShadingPass* GetPassOf(vtkRenderer* renderer);

  ///@{
  /**
   * Whether splats are blended, in pictures at rest. Takes about twice as long. Default: off.
   */
  vtkSetMacro(BlendsSplats, bool);
  vtkGetMacro(BlendsSplats, bool);
  ///@}

  /// Purpose for which the splats are drawn.
  enum class Stage
  {
    Picture, ///< As they are.
    Depths,  ///< Splats that are blended leave their depths alone.
    Blending ///< Weighted sums, by the depths that were left.
  };
  /// At present, of the picture that @p renderer draws.
  static Stage StageOf(vtkRenderer* renderer);
  /// Pixels of a tile, see TilesOf().
  static constexpr int kTile = 8;
  /// While splats are blended: depth of the farthest pixel of each tile, of which a splat that lies behind
  /// is hidden. Null at other stages.
  static vtkTextureObject* TilesOf(vtkRenderer* renderer);

  /**
   * Finds what the last picture of @p renderer shows within @p reach pixels of a place of its window, the
   * nearest to it: @p place in the scene. False: background is there, or the renderer has no such picture; a
   * window with a picture for each eye has none.
   */
  static bool FindShown(vtkRenderer* renderer, double x, double y, double reach, double place[3]);

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

  /// Colours and depths that are drawn into.
  struct Target
  {
    vtkSmartPointer<vtkOpenGLFramebufferObject> Frame;
    vtkSmartPointer<vtkTextureObject> Colors;
    vtkSmartPointer<vtkTextureObject> Depths; // of a sum: the weights, and the depths times them
  };
  void RenderEye(const vtkRenderState* state);
  void RenderRightEye(const vtkRenderState* state);
  void ChooseResolution(const vtkRenderState* state, vtkOpenGLRenderWindow* window);
  void PrepareTargets(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  bool PrepareQuad(std::unique_ptr<vtkOpenGLQuadHelper>& quad, const std::string& fragment,
    vtkOpenGLRenderWindow* window, bool isBehindAll = false);
  void SetUniforms(vtkShaderProgram* program, const Target& source, vtkRenderer* renderer);
  void DrawPicture(const vtkRenderState* state, vtkOpenGLRenderWindow* window);
  void FindFarthest(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void SumSplats(const vtkRenderState* state, vtkOpenGLRenderWindow* window);
  void DivideSums(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void Shade(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void Show(vtkRenderer* renderer, vtkOpenGLRenderWindow* window);
  void Draw(vtkOpenGLQuadHelper& quad, const Target& source, vtkRenderer* renderer);

  double NoiseLength = 0.0;
  double NoisePerDistance = 0.0;
  double Strength = 1.6;
  double MinimumLightness = 0.25;
  bool IsMoving = false;
  double MovingFragments = 0.0;
  bool BlendsSplats = false;
  Stage DrawnStage = Stage::Picture;
  vtkTextureObject* DrawnTiles = nullptr;
  double Resolution = 1.0;
  Target Drawn;
  Target Sums;
  Target Tiles;
  Target Shown;                   // kept
  int ShownFormat = -1;           // of its depths
  int DrawnFormat = -1;           ///< Format of the depths of Drawn.
  bool WindowTakesCopies = false; ///< Whether the bytes of Shown are those of the window.
  std::unique_ptr<vtkOpenGLQuadHelper> TileQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> DivideQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> CopyQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> ShadeQuad;
  std::vector<double> Kept;       // what is shown, see pictureState()
  vtkNew<vtkMatrix4x4> FromShown; // from its pixels and depths, each from -1 to 1, to the scene
  vtkSmartPointer<vtkDepthShadingPass> RightEye;
  bool IsRightEye = false;
  vtkTypeUInt64 NumberOfPictures = 0;
};
