/**
 * @class   vtkPointCloudInfo
 * @brief   what is in a point cloud: bounds, spacing, duplicates, arrays, and what to make of it
 *
 * Passes its input on and says of it what `pointhaptics info` prints. Put it behind a vtkPointCloudReader, or
 * any source of a vtkPolyData; its format is asked of a reader in front of it.
 *
 * All lengths are in the unit of the points. Points that are NaN or infinite are counted and otherwise left
 * out. Spacing is the distance to the nearest other place, of a sample of at most 10,000 points.
 *
 * Cost: O(n log n), 72 bytes a point up to 4 million points. One object is used by one thread at a time.
 *
 * @sa vtkPointCloudReader
 */
#ifndef vtkPointCloudInfo_h
#define vtkPointCloudInfo_h

#include "PointHapticsIOModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <algorithm> // For std::copy_n
#include <string>    // For std::string
#include <vector>    // For std::vector

class POINTHAPTICSIO_EXPORT vtkPointCloudInfo : public vtkPolyDataAlgorithm
{
public:
  static vtkPointCloudInfo* New();
  vtkTypeMacro(vtkPointCloudInfo, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Numbers of points in the last update: all, those that are NaN or infinite, finite ones at the very place
   * of an earlier one.
   */
  vtkGetMacro(NumberOfPoints, vtkIdType);
  vtkGetMacro(NumberOfInvalidPoints, vtkIdType);
  vtkGetMacro(NumberOfDuplicatePoints, vtkIdType);
  ///@}

  /**
   * Format of the file, where a vtkPointCloudReader stands in front; else empty.
   */
  std::string GetFormat() const { return this->Format; }

  ///@{
  /**
   * xmin, xmax, ymin, ymax, zmin, zmax of the finite points. HasBounds() is false where there is none; then
   * bounds and what follows from them say nothing.
   */
  bool HasBounds() const { return this->Bounds[0] <= this->Bounds[1]; }
  void GetBounds(double bounds[6]) const { std::copy_n(this->Bounds, 6, bounds); }
  ///@}

  /**
   * The spacing that 5, 25, 50, 75 and 95 percent of the points do not exceed; zeroes where there are no two
   * places.
   */
  void GetSpacingPercentiles(double spacing[5]) const { std::copy_n(this->Spacing, 5, spacing); }

  /**
   * The last of these over the first; 1 on a grid.
   */
  vtkGetMacro(DensityVariation, double);

  /**
   * Edge of a voxel that holds a few points of a surface at the median spacing.
   */
  vtkGetMacro(SuggestedVoxelSize, double);

  ///@{
  /**
   * Where the size is not about that of the 10 cm workspace: a hint in words, and the scale that fills most
   * of it; else empty, and 1 or near it.
   */
  std::string GetHint() const { return this->Hint; }
  vtkGetMacro(SuggestedScale, double);
  ///@}

  ///@{
  /**
   * Unit of the coordinates ("m", "mm", "deg" ...; one that is unknown as the file says it), whether it is a
   * guess by the size, and the coordinate system as the file says it.
   */
  std::string GetUnit() const { return this->Unit; }
  vtkGetMacro(UnitIsGuess, bool);
  std::string GetCoordinateSystem() const { return this->CoordinateSystem; }
  ///@}

  ///@{
  /**
   * The point arrays: name, type, components, and the range of the finite values of a component; false where
   * it has none, or where the numbers count no array and component.
   */
  int GetNumberOfArrays() const { return static_cast<int>(this->Arrays.size()); }
  std::string GetArrayName(int array) const { return this->ArrayAt(array).Name; }
  std::string GetArrayType(int array) const { return this->ArrayAt(array).Type; }
  int GetNumberOfComponents(int array) const { return this->ArrayAt(array).Components; }
  bool GetArrayRange(int array, int component, double range[2]) const;
  ///@}

protected:
  vtkPointCloudInfo() = default;
  ~vtkPointCloudInfo() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  struct ArrayInfo
  {
    std::string Name;
    std::string Type;
    int Components = 0;
    std::vector<double> Minima;
    std::vector<double> Maxima;
  };
  const ArrayInfo& ArrayAt(int array) const;

  vtkPointCloudInfo(const vtkPointCloudInfo&) = delete;
  void operator=(const vtkPointCloudInfo&) = delete;

  vtkIdType NumberOfPoints = 0;
  vtkIdType NumberOfInvalidPoints = 0;
  vtkIdType NumberOfDuplicatePoints = 0;
  double Bounds[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  double Spacing[5] = {};
  double DensityVariation = 0.0;
  double SuggestedVoxelSize = 0.0;
  double SuggestedScale = 1.0;
  bool UnitIsGuess = true;
  std::string Format;
  std::string Hint;
  std::string Unit;
  std::string CoordinateSystem;
  std::vector<ArrayInfo> Arrays;
};

#endif
