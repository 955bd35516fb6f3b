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

#include <memory> // For Internals
#include <string> // For std::string

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
  vtkIdType GetNumberOfPoints() const;
  vtkIdType GetNumberOfInvalidPoints() const;
  vtkIdType GetNumberOfDuplicatePoints() const;
  ///@}

  /**
   * Format of the file, where a vtkPointCloudReader stands in front; else empty.
   */
  std::string GetFormat() const;

  /**
   * True if there is a finite point; else bounds and what follows from them say nothing.
   */
  bool HasBounds() const;

  /**
   * xmin, xmax, ymin, ymax, zmin, zmax of the finite points.
   */
  void GetBounds(double bounds[6]) const;

  /**
   * The spacing that 5, 25, 50, 75 and 95 percent of the points do not exceed; zeroes where there are no two
   * places.
   */
  void GetSpacingPercentiles(double spacing[5]) const;

  /**
   * The last of these over the first; 1 on a grid.
   */
  double GetDensityVariation() const;

  /**
   * Edge of a voxel that holds a few points of a surface at the median spacing.
   */
  double GetSuggestedVoxelSize() const;

  ///@{
  /**
   * Where the size is not about that of the 10 cm workspace: a hint in words, and the scale that fills most
   * of it; else empty, and 1 or near it.
   */
  std::string GetHint() const;
  double GetSuggestedScale() const;
  ///@}

  ///@{
  /**
   * Unit of the coordinates ("m", "mm" ...), whether it is a guess by the size, and the coordinate system as
   * the file says it.
   */
  std::string GetUnit() const;
  bool GetUnitIsGuess() const;
  std::string GetCoordinateSystem() const;
  ///@}

  ///@{
  /**
   * The point arrays: name, type, components, and the range of the finite values of a component; false where
   * it has none, or where the numbers count no array and component.
   */
  int GetNumberOfArrays() const;
  std::string GetArrayName(int array) const;
  std::string GetArrayType(int array) const;
  int GetNumberOfComponents(int array) const;
  bool GetArrayRange(int array, int component, double range[2]) const;
  ///@}

protected:
  vtkPointCloudInfo();
  ~vtkPointCloudInfo() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;

  vtkPointCloudInfo(const vtkPointCloudInfo&) = delete;
  void operator=(const vtkPointCloudInfo&) = delete;
};

#endif
