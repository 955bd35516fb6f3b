/**
 * @class   vtkSplatMapper
 * @brief   points as round splats, each as large as an array says
 *
 * Draws the vertices of its input as discs that face the camera. The diameter of one is SizeScale times its
 * value of SizeArrayName, a length in the units of the points: with the bandwidths of
 * vtkKernelBandwidthFilter sparse regions close and dense ones stay crisp. Nearer splats are larger. Without
 * the array, or with FixedPixels above 0, all have the same size on the screen.
 *
 * @code
 * mapper->SetInputConnection(bandwidth->GetOutputPort());
 * mapper->SetSizeArrayName("Bandwidth");
 * @endcode
 *
 * Changing a number is free; changing the array uploads the points again. Colours, lookup tables and lighting
 * are those of vtkPolyDataMapper; other cells than vertices have no place in the input.
 *
 * @warning Needs the OpenGL back end. GUI thread only.
 * @sa vtkPointGaussianMapper vtkKernelBandwidthFilter
 */
#ifndef vtkSplatMapper_h
#define vtkSplatMapper_h

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkOpenGLPolyDataMapper.h"

#include <string> // For the array's name

class POINTHAPTICSINTERACTION_EXPORT vtkSplatMapper : public vtkOpenGLPolyDataMapper
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
   * No splat is smaller or larger than this, pixels. Default: 2 and 64.
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
   * Takes over all numbers and the array's name, SizeScale times @p factor.
   */
  void CopySizes(const vtkSplatMapper* other, double factor);

protected:
  vtkSplatMapper();
  ~vtkSplatMapper() override;

  void RenderPieceStart(vtkRenderer* renderer, vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor) override;

private:
  vtkSplatMapper(const vtkSplatMapper&) = delete;
  void operator=(const vtkSplatMapper&) = delete;

  std::string SizeArrayName = "Bandwidth";
  double SizeScale = 3.6;
  double LargestRatio = 2.5;
  double SmallestPixels = 2.0;
  double LargestPixels = 64.0;
  double FixedPixels = 0.0;
  bool HasSizes = false; // the shader in use reads the array
  double MedianLength = 0.0;
  vtkMTimeType MedianTime = 0; // of the array it is from
};

#endif
