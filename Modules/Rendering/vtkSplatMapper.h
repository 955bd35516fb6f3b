/**
 * @class   vtkSplatMapper
 * @brief   points as round splats, each as large as an array says
 *
 * Draws the vertices of its input, or all points of an input without cells, as discs that face the camera.
 * The diameter of one is SizeScale times its value of SizeArrayName, a length in the units of the points:
 * with the bandwidths of vtkKernelBandwidthFilter sparse regions close and dense ones stay crisp. Voxel means
 * take MeanBandwidth: they are farther apart than the points that Bandwidth tells of. Nearer splats are
 * larger. Without the array, or with FixedPixels above 0, all have the same size on the screen.
 *
 * @code
 * bandwidth->ComputeMeanBandwidthOn();
 * mapper->SetInputConnection(bandwidth->GetOutputPort());
 * mapper->SetSizeArrayName("MeanBandwidth");
 * @endcode
 *
 * With AmbientLight and an array of normals each splat is as light as the sky makes it, more above than
 * below, and as a soft light from beside the viewer does: a cloud without colours shows its shape. The
 * normals need no side: the one towards the viewer counts.
 *
 * With Surfaces the normals also say how flat the neighbourhood of each point is, by their length, 0 to 1.
 * Flat neighbourhoods close to a surface: their splats are discs that tilt with it and have depth, and are as
 * large as their lengths say, from however near. The others stay points: they face the camera, and have from
 * PointPixels to LargestPixels at most.
 *
 * Picks, selections (vtkHardwareSelector, vtkMapper::SetSelection), translucency and several windows work as
 * with vtkPolyDataMapper. A splat is selected by the pixels it is seen in, under the id that its point or
 * cell has in the input. Without cells a selection of cells finds the actor, as cell 0.
 *
 * Changing a number is free; changing the array uploads the points again. Colours, lookup tables and lighting
 * are those of vtkPolyDataMapper; other cells than vertices have no place in the input.
 *
 * @warning Needs the OpenGL back end. GUI thread only.
 * @sa vtkPointGaussianMapper vtkKernelBandwidthFilter
 */
#ifndef vtkSplatMapper_h
#define vtkSplatMapper_h

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkOpenGLPolyDataMapper.h"

#include <array>  // For ranges
#include <string> // For the array's name
#include <vector> // For ranges

class vtkDataArray;

class POINTHAPTICSRENDERING_EXPORT vtkSplatMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkSplatMapper* New();
  vtkTypeMacro(vtkSplatMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Point array of one component with a length for each point. Default: "Bandwidth".
   */
  void SetSizeArrayName(const std::string& name);
  const std::string& GetSizeArrayName() const { return this->SizeArrayName; }
  ///@}

  ///@{
  /**
   * Diameter of a splat over its length in the array, above 0. Default: 3.6, at which voxel means close to a
   * surface: 2.5 times their spacing for the bandwidths of 16 neighbours.
   */
  void SetSizeScale(double scale);
  double GetSizeScale() const { return this->SizeScale; }
  ///@}

  ///@{
  /**
   * A length counts for no more than so many times the median of all, above 0: single points far from all
   * others would be drawn as balls. Default: 2.5.
   */
  void SetLargestRatio(double ratio);
  double GetLargestRatio() const { return this->LargestRatio; }
  ///@}

  ///@{
  /**
   * No splat is smaller or larger than this, pixels; with Surfaces those of what is flat may be larger.
   * Default: 2 and 64.
   */
  void SetPixelRange(double smallest, double largest);
  double GetSmallestPixels() const { return this->SmallestPixels; }
  double GetLargestPixels() const { return this->LargestPixels; }
  ///@}

  ///@{
  /**
   * Diameter of all splats in pixels, whatever the array says; 0 (default): the array rules, and 3 pixels
   * where there is none.
   */
  void SetFixedPixels(double pixels);
  double GetFixedPixels() const { return this->FixedPixels; }
  ///@}

  /**
   * Parts of the input's vertices that are drawn, in the order of its cells: the first and the one after the
   * last of each. Empty (default): all. Free to change; for input without cells, where the parts are of the
   * points, or whose cells are vertices of one point each.
   */
  void SetRanges(std::vector<std::array<vtkIdType, 2>> ranges);
  const std::vector<std::array<vtkIdType, 2>>& GetRanges() const { return this->Ranges; }

  ///@{
  /**
   * Shade the splats by their normals, where the input has them. Default: off. A change uploads the points
   * again.
   */
  void SetAmbientLight(bool on);
  bool GetAmbientLight() const { return this->AmbientLight; }
  ///@}

  ///@{
  /**
   * Point array of three components with a unit normal of each point, on either side; zero: the splat has the
   * middle light. Default: "SurfaceNormal".
   */
  void SetNormalArrayName(const std::string& name);
  const std::string& GetNormalArrayName() const { return this->NormalArrayName; }
  ///@}

  ///@{
  /**
   * Where the sky is, in the frame of the scene; any length above 0. Default: 0, 0, 1.
   */
  void SetSkyDirection(const double direction[3]);
  void GetSkyDirection(double direction[3]) const;
  ///@}

  ///@{
  /**
   * Draw what is flat as surfaces, by the length of the normals. Needs AmbientLight and the array of normals.
   * Default: off. A change uploads the points again.
   */
  void SetSurfaces(bool on);
  bool GetSurfaces() const { return this->Surfaces; }
  ///@}

  ///@{
  /**
   * Whether discs that tilt away get narrow, as the spacing of points on a surface does. Off: they tilt but
   * stay round, for points that are evenly apart on the screen as those of a camera are. Default: on. Free to
   * change.
   */
  void SetForeshortens(bool on) { this->Foreshortens = on; }
  bool GetForeshortens() const { return this->Foreshortens; }
  ///@}

  ///@{
  /**
   * Largest diameter, pixels, of a splat whose neighbourhood is not flat at all; with Surfaces. Default: 4.
   */
  void SetPointPixels(double pixels);
  double GetPointPixels() const { return this->PointPixels; }
  ///@}

  ///@{
  /**
   * Largest diameter, pixels, of a splat whose neighbourhood is flat; with Surfaces. Default: as large as its
   * length says, from however near.
   */
  void SetSurfacePixels(double pixels);
  double GetSurfacePixels() const { return this->SurfacePixels; }
  ///@}

  ///@{
  /**
   * Whether what is not flat counts as part of a surface, too: only its discs face the camera. With Surfaces.
   * Default: off. Free to change.
   */
  void SetClosesAll(bool on) { this->ClosesAll = on; }
  bool GetClosesAll() const { return this->ClosesAll; }
  ///@}

  ///@{
  /**
   * How much of the light is seen, 0 (the colours themselves) to 1 (default).
   */
  void SetLightStrength(double strength);
  double GetLightStrength() const { return this->LightStrength; }
  ///@}

  ///@{
  /**
   * Length of a normal of 1 in the array: 32767 for short integers. Default: 1.
   */
  void SetNormalUnit(double unit);
  double GetNormalUnit() const { return this->NormalUnit; }
  ///@}

  ///@{
  /**
   * Leave out what looks away from the viewer, where the normals are on the side that was seen: a room
   * without its near walls. Splats with a normal shorter than 0.02 stay. Default: off.
   */
  void SetHidesBackFaces(bool on);
  bool GetHidesBackFaces() const { return this->HidesBackFaces; }
  ///@}

  ///@{
  /**
   * Draw only what lies in this box, xmin, xmax, ymin ... zmax, in the frame of the input. Default: from
   * -infinity to infinity. Free to change.
   */
  void SetClipBox(const double box[6]);
  const std::array<double, 6>& GetClipBox() const { return this->ClipBox; }
  ///@}

  /**
   * Diameter of a splat of median length where the camera looks at, pixels of the window; 0 without the
   * array.
   */
  double GetMedianPixels(vtkRenderer* renderer, vtkActor* actor);

  /**
   * Takes over all numbers, the names of the arrays and the light, SizeScale times @p factor.
   */
  void CopySizes(const vtkSplatMapper* other, double factor);

protected:
  vtkSplatMapper();
  ~vtkSplatMapper() override;

  void RenderPieceStart(vtkRenderer* renderer, vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;
  void ComputeBounds() override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor) override;

private:
  using RangeList = std::vector<std::array<vtkIdType, 2>>;
  void DrawSplats(vtkRenderer* renderer, vtkActor* actor);
  void DrawPoints(vtkOpenGLHelper& points, vtkRenderer* renderer, vtkActor* actor, const RangeList& ranges);
  bool WantsQuads(vtkRenderer* renderer, vtkActor* actor);
  double PixelsPerLength(vtkRenderer* renderer, vtkActor* actor);
  void DrawRange(vtkRenderer* renderer, vtkIdType begin, vtkIdType end, bool isIndexed);
  void MapArray(vtkDataArray* array, const std::string& name, const char* attribute, bool& isMapped);
  void SetSurfaceParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor);
  void SetClipParameters(vtkOpenGLHelper& cells);
  void SetLightParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor);

  vtkSplatMapper(const vtkSplatMapper&) = delete;
  void operator=(const vtkSplatMapper&) = delete;

  std::string SizeArrayName = "Bandwidth";
  double SizeScale = 3.6;
  double LargestRatio = 2.5;
  double SmallestPixels = 2.0;
  double LargestPixels = 64.0;
  double FixedPixels = 0.0;
  bool AmbientLight = false;
  bool Surfaces = false;
  bool Foreshortens = true;
  bool ClosesAll = false;
  double PointPixels = 4.0;
  double SurfacePixels = 1e9;
  double LightStrength = 1.0;
  double NormalUnit = 1.0;
  bool HidesBackFaces = false;
  std::string NormalArrayName = "SurfaceNormal";
  std::array<double, 3> SkyDirection = { 0.0, 0.0, 1.0 };
  std::array<double, 6> ClipBox;
  std::vector<std::array<vtkIdType, 2>> Ranges;
  bool HasNormals = false;        // the shader in use reads the normals
  bool HasSizes = false;          // the shader in use reads the array
  double Fit[2] = { 1.0, 1.0 };   // of the picture in the viewport that is drawn into
  double Pixel[2] = { 0.0, 0.0 }; // of that viewport, whose width and height are 2
  bool DrawsQuads = false;
  double MedianLength = 0.0;
  vtkMTimeType MedianTime = 0; // of the array it is from
};

#endif
