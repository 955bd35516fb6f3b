/**
 * @class   vtkVoxelMeanResampler
 * @brief   replace the points in each voxel of a regular lattice by their mean
 *
 * The points of the input (any vtkPointSet) are mapped by an optional affine transform, sorted into the
 * half-open voxels of a lattice over the workspace, and each voxel that holds points gives one output point:
 * their mean, with the means of all point arrays. This is the paper's "mean filter": zooming in gives more
 * active voxels, zooming out fewer. Voxel index = floor((x - origin) / spacing). Sums are taken about the
 * voxel's centre in 64-bit fixed point (quantum 2^-32 voxel), so a mean is exact to 2^-31 voxel before
 * rounding to the output type and the points and counts do not depend on the order of the input, the number
 * of threads or the SMP back end.
 *
 * Use:
 * @code
 * vtkNew<vtkVoxelMeanResampler> resampler;
 * resampler->SetInputConnection(reader->GetOutputPort());
 * resampler->SetVoxelSize(0.001); // or SetDimensions(300, 300, 300), the default
 * resampler->Update();
 * @endcode
 *
 * Output: the means as points (order: by voxel index, x fastest), one vertex cell each, the averaged point
 * arrays, the vtkIdTypeArray "VoxelPointCount", and on request "VoxelCovariance" (6 doubles: XX YY ZZ XY YZ
 * XZ, central, divided by the count, in squared units of the output frame). Field data: "LatticeOrigin" and
 * "LatticeSpacing" (3 doubles), "LatticeDimensions" (3 integers), "ModelToWorkspace" (16 doubles, row by
 * row).
 *
 * Arrays: numeric arrays of any type and number of components are averaged in double and rounded to their own
 * type (integers to nearest); the active normals are carried by the inverse transpose and re-normalised;
 * arrays named in CategoricalArrays take the value most points of the voxel have (the smallest one on a tie);
 * string arrays and other non-numeric arrays are dropped with a warning; global ids, ghost flags and the
 * VoxelPointCount and VoxelCovariance of an earlier resampling are left out. Field data are passed.
 *
 * Points that are NaN or infinite are dropped and counted by GetNumberOfInvalidPoints(), finite points
 * outside the workspace by GetNumberOfClippedPoints().
 *
 * @warning Errors (singular or non-finite transform, empty bounds, a lattice that cannot be addressed) are
 * reported by vtkErrorMacro with the cure, and the output is a valid empty vtkPolyData.
 *
 * Cost: about 40 bytes per input point and 50 per active voxel while it runs; nothing is allocated in
 * proportion to the number of voxels of the lattice. Source: Kumari, Sreeni, Chaudhuri, "Scalable Rendering
 * of Variable Density Point Cloud Data"; the exact sums are ours (Documentation/Method.md).
 *
 * @sa vtkKernelBandwidthFilter vtkVoxelGrid
 */
#ifndef vtkVoxelMeanResampler_h
#define vtkVoxelMeanResampler_h

#include "PointHapticsFiltersModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // For Transform

#include <set>    // For CategoricalNames
#include <string> // For CategoricalNames

class vtkAbstractTransform;
class vtkPointSet;

namespace pointhaptics
{
class Executor;
class PointView;
struct AffineTransform;
struct Lattice;
struct VoxelMeans;
}

class POINTHAPTICSFILTERS_EXPORT vtkVoxelMeanResampler : public vtkPolyDataAlgorithm
{
public:
  static vtkVoxelMeanResampler* New();
  vtkTypeMacro(vtkVoxelMeanResampler, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Map from the cloud's frame into the workspace's. Must be linear (vtkLinearTransform, vtkTransform,
   * vtkMatrixToLinearTransform ...) and invertible; it may mirror or shear. Default: none, the identity.
   */
  virtual void SetTransform(vtkAbstractTransform* transform);
  vtkAbstractTransform* GetTransform();
  ///@}

  ///@{
  /**
   * Box of the lattice in the frame of the transformed cloud: xmin, xmax, ymin, ymax, zmin, zmax. Setting it
   * turns AutomaticWorkspace off. Default: the paper's 10 cm cube about the origin.
   */
  virtual void SetWorkspaceBounds(const double bounds[6]);
  virtual void SetWorkspaceBounds(double x0, double x1, double y0, double y1, double z0, double z1);
  vtkGetVector6Macro(WorkspaceBounds, double);
  ///@}

  ///@{
  /**
   * On: the workspace is a cube about the transformed cloud, half a voxel wider on each side, so that nothing
   * is clipped. Default: on.
   */
  vtkSetMacro(AutomaticWorkspace, bool);
  vtkGetMacro(AutomaticWorkspace, bool);
  vtkBooleanMacro(AutomaticWorkspace, bool);
  ///@}

  ///@{
  /**
   * Number of voxels on each axis, 1 to 2^21. Default: 300, 300, 300. Setting it sets VoxelSize to 0: of the
   * two, the one set last rules.
   */
  virtual void SetDimensions(const int dimensions[3]);
  virtual void SetDimensions(int nx, int ny, int nz);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * Edge of a cubic voxel in the units of the transformed cloud; 0 (default): Dimensions rule. The lattice
   * starts at the lower corner of the workspace and covers it with whole voxels.
   */
  virtual void SetVoxelSize(double size);
  vtkGetMacro(VoxelSize, double);
  ///@}

  ///@{
  /**
   * Type of the output points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION or DEFAULT_PRECISION (that of
   * the input). Default: DEFAULT_PRECISION.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  ///@{
  /**
   * Add the array VoxelCovariance: six second moments per voxel. Default: off.
   */
  vtkSetMacro(ComputeCovariance, bool);
  vtkGetMacro(ComputeCovariance, bool);
  vtkBooleanMacro(ComputeCovariance, bool);
  ///@}

  ///@{
  /**
   * Average the point arrays of the input. Off: only the points and VoxelPointCount (and VoxelCovariance) are
   * made. Default: on.
   */
  vtkSetMacro(PassAttributes, bool);
  vtkGetMacro(PassAttributes, bool);
  vtkBooleanMacro(PassAttributes, bool);
  ///@}

  ///@{
  /**
   * Names of the arrays that hold labels: their voxel value is the one most points have, not a mean. Default:
   * none, but "Classification" (LAS) is in the list from the start.
   */
  void AddCategoricalArray(const char* name);
  void RemoveCategoricalArray(const char* name);
  void ClearCategoricalArrays();
  bool IsCategoricalArray(const char* name) const;
  ///@}

  ///@{
  /**
   * Of the last update: finite points outside the workspace, points that are NaN or infinite.
   */
  vtkGetMacro(NumberOfClippedPoints, vtkIdType);
  vtkGetMacro(NumberOfInvalidPoints, vtkIdType);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkVoxelMeanResampler();
  ~vtkVoxelMeanResampler() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkSmartPointer<vtkAbstractTransform> Transform;
  double WorkspaceBounds[6];
  bool AutomaticWorkspace;
  int Dimensions[3];
  double VoxelSize;
  int OutputPointsPrecision;
  bool ComputeCovariance;
  bool PassAttributes;
  std::set<std::string> CategoricalArrays;
  vtkIdType NumberOfClippedPoints;
  vtkIdType NumberOfInvalidPoints;

private:
  // The steps of RequestData; false after an error was reported, or the execution aborted.
  bool ReadTransform(pointhaptics::AffineTransform& transform);
  bool MakeLattice(const pointhaptics::PointView& points, const pointhaptics::AffineTransform& transform,
    pointhaptics::Lattice& lattice);
  bool AverageArrays(vtkPointSet* input, const pointhaptics::VoxelMeans& voxels,
    const pointhaptics::AffineTransform& transform, vtkPolyData* output);

  vtkVoxelMeanResampler(const vtkVoxelMeanResampler&) = delete;
  void operator=(const vtkVoxelMeanResampler&) = delete;
};

#endif
