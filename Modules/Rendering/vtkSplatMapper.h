/**
 * @class   vtkSplatMapper
 * @brief   points as round splats, each as large as an array says
 *
 * Draws the vertices of its input, or all points of an input without cells, as discs that face the camera.
 * The diameter of one is a multiple of its value in an array, a length in the units of the points:
 * with the bandwidths of vtkKernelBandwidthFilter sparse regions close and dense ones stay crisp. Voxel means
 * take MeanBandwidth: they are farther apart than the points that Bandwidth tells of. Nearer splats are
 * larger. Without the array, or with a fixed size, all have the same size on the screen.
 *
 * @code
 * bandwidth->ComputeMeanBandwidthOn();
 * mapper->SetInputConnection(bandwidth->GetOutputPort());
 * mapper->SetSizeArrayName("MeanBandwidth");
 * @endcode
 *
 * With light and an array of normals each splat is as light as the sky makes it, more above than
 * below, and as a soft light from beside the viewer does: a cloud without colours shows its shape. The
 * normals need no side: the one towards the viewer counts.
 *
 * With surfaces the normals also say how flat the neighbourhood of each point is, by their length, 0 to 1.
 * Flat neighbourhoods close to a surface: their splats are discs that tilt with it and have depth, and are as
 * large as their lengths say, from however near. The others stay points: they face the camera, and are
 * small.
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
#include "SplatSettings.h"               // For the settings

#include "vtkOpenGLPolyDataMapper.h"

#include <algorithm> // For copies
#include <array>     // For ranges
#include <limits>    // For ranges
#include <string>    // For the names of arrays
#include <vector>    // For ranges

class vtkDataArray;

class POINTHAPTICSRENDERING_EXPORT vtkSplatMapper : public vtkOpenGLPolyDataMapper
{
public:
  static vtkSplatMapper* New();
  vtkTypeMacro(vtkSplatMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * How the splats are drawn; free to change before a render. Values are not checked.
   */
  pointhaptics::SplatSettings& Settings() { return this->Now; }
  const pointhaptics::SplatSettings& Settings() const { return this->Now; }
  // The settings one by one; see SplatSettings. A setter ignores a value out of its range.

  /** Point array of one component with a length for each point. Default: "Bandwidth". */
  void SetSizeArrayName(const std::string& name) { this->Change(this->Now.sizeArray, name); }
  const std::string& GetSizeArrayName() const { return this->Now.sizeArray; }
  /** Diameter of a splat over its length in the array, above 0. Default: 3.6. */
  void SetSizeScale(double scale) { this->SetPositive(this->Now.sizeScale, scale); }
  double GetSizeScale() const { return this->Now.sizeScale; }
  /** A length counts for no more than so many times the median of all, above 0. Default: 2.5. */
  void SetLargestRatio(double ratio) { this->SetPositive(this->Now.largestRatio, ratio, INFINITY); }
  double GetLargestRatio() const { return this->Now.largestRatio; }
  /** Bounds of a diameter, pixels, above 0; flat surfaces may be larger. Default: 2 and 64. */
  void SetPixelRange(double smallest, double largest);
  double GetSmallestPixels() const { return this->Now.smallestPixels; }
  double GetLargestPixels() const { return this->Now.largestPixels; }
  /** Diameter of all splats, pixels; 0, the default: the array rules, and 3 where there is none. */
  void SetFixedPixels(double pixels);
  double GetFixedPixels() const { return this->Now.fixedPixels; }
  /** Shades the splats by their normals, where the input has them. Default: off. */
  void SetAmbientLight(bool on) { this->Change(this->Now.ambientLight, on); }
  bool GetAmbientLight() const { return this->Now.ambientLight; }
  /** Point array of three components with a unit normal on either side. Default: "SurfaceNormal". */
  void SetNormalArrayName(const std::string& name) { this->Change(this->Now.normalArray, name); }
  const std::string& GetNormalArrayName() const { return this->Now.normalArray; }
  /** Where the sky is, in the frame of the scene; any length above 0. Default: 0, 0, 1. */
  void SetSkyDirection(const double direction[3]);
  void GetSkyDirection(double direction[3]) const;
  /** Draws what is flat as surfaces, by the length of the normals; needs the light. Default: off. */
  void SetSurfaces(bool on) { this->Change(this->Now.surfaces, on); }
  bool GetSurfaces() const { return this->Now.surfaces; }
  /** Discs that tilt away get narrow. Default: on. */
  void SetForeshortens(bool on) { this->Now.foreshortens = on; }
  bool GetForeshortens() const { return this->Now.foreshortens; }
  /** Largest diameter, pixels, of a splat whose neighbourhood is not flat. Default: 4. */
  void SetPointPixels(double pixels) { this->SetPositive(this->Now.pointPixels, pixels); }
  double GetPointPixels() const { return this->Now.pointPixels; }
  /** Largest diameter, pixels, of a splat whose neighbourhood is flat. Default: infinity. */
  void SetSurfacePixels(double pixels) { this->SetPositive(this->Now.surfacePixels, pixels, INFINITY); }
  double GetSurfacePixels() const { return this->Now.surfacePixels; }
  /** Splats that are not flat close like a surface, too. Default: off. */
  void SetClosesAll(bool on) { this->Now.closesAll = on; }
  bool GetClosesAll() const { return this->Now.closesAll; }
  /** How much of the light is seen, 0 (the colours themselves) to 1, the default. */
  void SetLightStrength(double strength);
  double GetLightStrength() const { return this->Now.lightStrength; }
  /** Length of a normal of 1 in the array: 32767 for short integers. Default: 1. */
  void SetNormalUnit(double unit) { this->SetPositive(this->Now.normalUnit, unit); }
  double GetNormalUnit() const { return this->Now.normalUnit; }
  /** Leaves out what looks away from the viewer. Default: off. */
  void SetHidesBackFaces(bool on) { this->Now.hidesBackFaces = on; }
  bool GetHidesBackFaces() const { return this->Now.hidesBackFaces; }
  /** Draws only what lies in xmin, xmax, ymin ... zmax, frame of the input. Default: everything. */
  void SetClipBox(const double box[6]) { std::copy(box, box + 6, this->Now.clipBox.begin()); }
  const std::array<double, 6>& GetClipBox() const { return this->Now.clipBox; }

  /**
   * Parts of the input's vertices that are drawn, in the order of its cells: the first and the one after the
   * last of each. Empty (default): all. Free to change; for input without cells, where the parts are of the
   * points, or whose cells are vertices of one point each.
   */
  void SetRanges(std::vector<std::array<vtkIdType, 2>> ranges);
  const std::vector<std::array<vtkIdType, 2>>& GetRanges() const { return this->Ranges; }

  /**
   * Diameter of a splat of median length where the camera looks at, pixels of the window: at most @p largest,
   * and the gap that it closes. Without the array the gap's alone.
   */
  double GetMedianPixels(vtkRenderer* renderer, vtkActor* actor, double largest);

  /**
   * Takes over settings and clipping planes, for some of the points of @p other: @p gap between them is
   * closed.
   */
  void CopySizes(const vtkSplatMapper* other, double gap);

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
  double NearestIsNearer(vtkRenderer* renderer, vtkActor* actor);
  bool WantsQuads(vtkRenderer* renderer, vtkActor* actor);
  double PixelsPerLength(vtkRenderer* renderer, vtkActor* actor);
  double GapPixels(vtkRenderer* renderer, vtkActor* actor);
  void DrawRange(vtkRenderer* renderer, vtkIdType begin, vtkIdType end, bool isIndexed);
  void MapArray(vtkDataArray* array, const std::string& name, const char* attribute, bool& isMapped);
  void SetSurfaceParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor);
  void SetClipParameters(vtkOpenGLHelper& cells);
  void SetLightParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor);

  vtkSplatMapper(const vtkSplatMapper&) = delete;
  void operator=(const vtkSplatMapper&) = delete;

  /// Sets what uploads the points again.
  template <typename T>
  void Change(T& setting, const T& value)
  {
    if (setting != value)
    {
      setting = value;
      this->Modified();
    }
  }
  static void SetPositive(double& setting, double value, double most = std::numeric_limits<double>::max())
  {
    setting = value > 0.0 && value <= most ? value : setting;
  }

  pointhaptics::SplatSettings Now;
  pointhaptics::SplatSettings Drawn; // with the points that are uploaded
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
