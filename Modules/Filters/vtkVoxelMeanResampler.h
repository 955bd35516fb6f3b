/**
 * @class   vtkVoxelMeanResampler
 * @brief   replace the points in each voxel of a regular lattice by their mean
 *
 * The points of the input (any vtkPointSet) are mapped by an optional affine transform and binned into the
 * half-open voxels of a lattice over the workspace. Each voxel that holds points gives one output point:
 * their mean, with the means of all point arrays. This is the paper's "mean filter": zooming in gives more
 * active voxels, zooming out fewer.
 *
 * Use:
 *
 * @code
 * vtkNew< vtkVoxelMeanResampler > resampler;
 * resampler->SetInputConnection(reader->GetOutputPort());
 * resampler->SetVoxelSize(0.001); // or SetDimensions(300, 300, 300), the default
 * resampler->Update();
 * @endcode
 *
 * Output: the means as points (order: by voxel index, x fastest), one vertex cell each, the averaged point
 * arrays, the vtkIdTypeArray "VoxelPointCount", and on request "VoxelCovariance" (6 doubles: XX YY ZZ XY YZ
 * XZ, central, divided by the count, in squared units of the output frame). Field data: that of the input,
 * "LatticeOrigin" and "LatticeSpacing" (3 doubles), "LatticeDimensions" (3 integers), "ModelToWorkspace" (16
 * doubles, row by row). "Viewpoint" and "ScanPoses" of vtkPointCloudReader are moved as the points are, but
 * for a viewpoint that is the identity, which says nothing; a transform that mirrors or does not keep angles
 * drops them with a warning. Output port 1 is the input with the voxel of each point (ComputeVoxelIndex).
 *
 * Composites (vtkCloudAlgorithm): each block has means of its own, and all blocks share one lattice. The
 * counts of clipped and invalid points are sums over the blocks. Pieces of a pipeline that runs on several
 * processes have an automatic workspace each, about their own points: give WorkspaceBounds for a common
 * lattice, or use vtkDistributedVoxelMeanResampler.
 *
 * Arrays: numeric arrays of any type and number of components are averaged and rounded to their own type
 * (integers to nearest, exactly), and keep their lookup table and information keys; the active normals are
 * transformed by the inverse transpose and re-normalised, those in integers keep the length of their mean;
 * arrays named in CategoricalArrays, in upper or lower case (Core/Base/FieldNames.h), take the value most
 * points of the voxel have (the smallest one on a tie; NaN counts as the largest, and both zeroes as one);
 * string arrays, other non-numeric arrays, global and pedigree ids and arrays of another number of tuples are
 * dropped with a warning; ghost flags and what an earlier resampling made (VoxelPointCount, VoxelCovariance,
 * VoxelIndex, vtkOriginalPointIds) are left out. A name in CategoricalArrays that no array has is a warning,
 * those from the start aside. NaN in an array stands for no value: a mean leaves it out, and is NaN where a
 * voxel has nothing else; infinities count as in IEEE addition. Of vectors only the normals are turned. To
 * keep some of the arrays, put a vtkPassArrays before the filter. Points flagged as ghosts, and blanked ones,
 * are averaged like all others: remove duplicates first.
 *
 * Accuracy: voxel index = floor((x - origin) / spacing), all in double about a point near the workspace, so
 * that map coordinates cost no digits. Offsets in the voxel are summed exactly, in integers whose quantum is
 * at most 2^-31 of a voxel; that is the largest error of a mean before it is rounded to the output type, and
 * a mean lies in its voxel (where voxels are larger than the output type's last digits: not in single
 * precision at map coordinates). That holds for matrices of any condition number, too. Everything - points,
 * counts, covariances, averaged arrays - is the same bit for bit for every order of the input points, number
 * of threads, SMP back end and instruction set.
 *
 * An input without points gives all arrays without tuples.
 *
 * Points that are NaN or infinite are dropped and counted by GetNumberOfInvalidPoints(), finite points
 * outside the workspace by GetNumberOfClippedPoints(). Where that leaves none at all, a warning says so.
 *
 * @warning A singular or non-finite transform, empty bounds and a lattice that cannot be addressed are
 * errors.
 *
 * Cost: a few nanoseconds a point (Documentation/Performance.md). Memory beyond input and output: 16 bytes
 * for each of at most 5 million points, 60 bytes an active voxel and a few megabytes, kept for the next
 * update; nothing in proportion to the voxels of the lattice. With covariance: 100 bytes an active voxel
 * more; with more points: up to 90 bytes in all, 280 with covariance too. With arrays: for each of those
 * points its number and tuples (up to 36 bytes); where there are more points, also the values of categories,
 * and of other arrays 8 bytes for each active voxel and component, or 16 for integers of 64 bits and for
 * most arrays of doubles (more where magnitudes differ by more than 2^50; at most 32 are kept).
 * Representatives and the voxel index hold all points at once. A workspace that shows less than half of the
 * cloud for the second time makes a PointIndex (16 bytes a point; 28 for double coordinates), after which an
 * update costs in proportion to the points inside, and a look at every value of arrays of floats and
 * doubles.
 *
 * Progress events, at which AbortExecute ends the work, come at least every 1.25 million points, but while an
 * index is made. Inside it runs on vtkSMPTools. Source: Kumari, Sreeni, Chaudhuri, "Scalable Rendering of
 * Variable Density Point Cloud Data"; the exact sums are ours (Documentation/Method.md).
 *
 * @sa vtkKernelBandwidthFilter vtkVoxelGrid
 */
#ifndef vtkVoxelMeanResampler_h
#define vtkVoxelMeanResampler_h

#include "Core/Resample/VoxelMeanSettings.h" // For Settings
#include "PointHapticsFiltersModule.h"       // For export macro
#include "vtkCloudAlgorithm.h"
#include "vtkSmartPointer.h" // For Transform

#include <memory> // For Internals
#include <set>    // For GetCategoricalArrays
#include <string> // For GetCategoricalArrays

class vtkAbstractTransform;

class POINTHAPTICSFILTERS_EXPORT vtkVoxelMeanResampler : public vtkCloudAlgorithm
{
public:
  static vtkVoxelMeanResampler* New();
  vtkTypeMacro(vtkVoxelMeanResampler, vtkCloudAlgorithm);
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
   * turns AutomaticWorkspace off. An automatic one is a cube about the points that are not far from all
   * others (Core/Distributed/FarPoints.h); a warning says how many are left out. Default: the paper's 10 cm
   * cube about the origin.
   */
  virtual void SetWorkspaceBounds(const double bounds[6]);
  virtual void SetWorkspaceBounds(double x0, double x1, double y0, double y1, double z0, double z1);
  vtkGetVector6Macro(WorkspaceBounds, double);
  ///@}

  ///@{
  /**
   * On: the workspace is a cube about the transformed cloud, half a voxel (on its finest axis) wider on
   * each side, so that nothing is clipped. Default: on.
   */
  vtkSettingMacro(AutomaticWorkspace, bool, lattice.automaticWorkspace);
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
  vtkSettingMacro(VoxelSize, double, lattice.voxelSize);
  ///@}

  ///@{
  /**
   * Type of the output points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION or DEFAULT_PRECISION (that of
   * the input). Default: DEFAULT_PRECISION.
   */
  vtkSettingEnumMacro(OutputPointsPrecision, outputPointsPrecision, DEFAULT_PRECISION);
  ///@}

  ///@{
  /**
   * Add the array VoxelCovariance: six second moments per voxel. Default: off.
   */
  vtkSettingMacro(ComputeCovariance, bool, computeCovariance);
  vtkBooleanMacro(ComputeCovariance, bool);
  ///@}

  ///@{
  /**
   * Average the point arrays of the input. Off: only the points and VoxelPointCount (and VoxelCovariance) are
   * made. Default: on.
   */
  vtkSettingMacro(PassAttributes, bool, passAttributes);
  vtkBooleanMacro(PassAttributes, bool);
  ///@}

  ///@{
  /**
   * Names of the arrays that hold labels: their voxel value is the one most points have, not a mean. Default:
   * none, but "Class", "Classification", "Instance", "Label" and "Segment" are in the list from the start.
   * They mean also names that end with them, in the plural or with an id ("scalar_Label", "instance_ids"),
   * unless ExactCategoricalNames is on. Default: off.
   */
  virtual void AddCategoricalArray(const char* name);
  virtual void RemoveCategoricalArray(const char* name);
  virtual void ClearCategoricalArrays();
  bool IsCategoricalArray(const char* name) const;
  const std::set<std::string>& GetCategoricalArrays() const { return this->Settings.categoricalArrays; }
  vtkSettingMacro(ExactCategoricalNames, bool, exactCategoricalNames);
  vtkBooleanMacro(ExactCategoricalNames, bool);
  ///@}

  enum RepresentativeType
  {
    Mean = 0,
    NearestToMean,
    NearestToCenter,
    Median
  };
  ///@{
  /**
   * Representative of the points of a voxel. NearestToMean, NearestToCenter: one of the points, whose values
   * all arrays have (the active normals turned with the transform). Among points at exactly the same distance
   * it is the one with the smallest x, then y, then z, then values in the order of the arrays. Median: by
   * coordinate and by component, the lower middle one of an even number, NaN above all numbers; categorical
   * arrays have the value most points have. VoxelPointCount and VoxelCovariance are those of all points of
   * the voxel. Results are the same for every order of the points and number of threads. Default: Mean.
   */
  vtkSettingEnumMacro(Representative, representative, Median);
  void SetRepresentativeToMean() { this->SetRepresentative(Mean); }
  void SetRepresentativeToNearestToMean() { this->SetRepresentative(NearestToMean); }
  void SetRepresentativeToNearestToCenter() { this->SetRepresentative(NearestToCenter); }
  void SetRepresentativeToMedian() { this->SetRepresentative(Median); }
  ///@}

  ///@{
  /**
   * Voxels with fewer points are left out. At least 1. Default: 1.
   */
  vtkSettingMacro(MinimumPointsPerVoxel, int, minimumPointsPerVoxel);
  ///@}

  ///@{
  /**
   * Fill output port 1, which is empty otherwise: the points of the input with their arrays and the
   * vtkIdTypeArray "VoxelIndex", the point of output 0 that each belongs to; -1 where it is clipped, invalid
   * or in a voxel that is left out. Default: off.
   */
  vtkSettingMacro(ComputeVoxelIndex, bool, computeVoxelIndex);
  vtkBooleanMacro(ComputeVoxelIndex, bool);
  ///@}

  ///@{
  /**
   * Add the vtkIdTypeArray "vtkOriginalPointIds": the point of the input that stands for the voxel, of the
   * same points with the same values the first. Only NearestToMean and NearestToCenter have one. Default:
   * off.
   */
  vtkSettingMacro(KeepOriginalPointIds, bool, keepOriginalPointIds);
  vtkBooleanMacro(KeepOriginalPointIds, bool);
  ///@}

  ///@{
  /**
   * Build an index of the input's points once parts of them are resampled repeatedly. This changes only the
   * cost of updates, provided that whoever writes to the points calls Modified() on them, or on the input.
   * Default: on.
   */
  vtkSettingMacro(UsePointIndex, bool, usePointIndex);
  vtkBooleanMacro(UsePointIndex, bool);
  ///@}

  enum InstructionSetType
  {
    InstructionSetAutomatic = 0, ///< The best the machine has.
    InstructionSetBaseline,
    InstructionSetAVX2
  };
  ///@{
  /**
   * The vector instructions of the inner loops; one the machine lacks falls back to the best below. Changes
   * the speed only: for measurements. Default: InstructionSetAutomatic.
   */
  vtkSettingEnumMacro(InstructionSet, instructionSet, InstructionSetAVX2);
  ///@}

  ///@{
  /**
   * All of the above but the transform as one plain value. MinimumPointsPerVoxel is clamped to its range.
   */
  virtual void SetSettings(const pointhaptics::VoxelMeanSettings& settings);
  const pointhaptics::VoxelMeanSettings& GetSettings() const { return this->Settings; }
  ///@}

  /**
   * At most so many threads of vtkSMPTools in the next updates; 0: all of them. The result is the same with
   * any number. Not a property of the output: the pipeline does not update for it. Default: 0.
   */
  void SetNumberOfThreads(int threads) { this->NumberOfThreads = std::max(0, threads); }

  /**
   * Takes over all settings of @p other.
   */
  void TakeSettings(vtkVoxelMeanResampler* other);

  ///@{
  /**
   * Points left out of the last update, over all blocks: finite ones outside the workspace, and those that
   * are NaN or infinite.
   */
  vtkGetMacro(NumberOfClippedPoints, vtkIdType);
  vtkGetMacro(NumberOfInvalidPoints, vtkIdType);
  ///@}

  /**
   * At least the MTime of the transform.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkVoxelMeanResampler();
  ~vtkVoxelMeanResampler() override;

#ifndef __VTK_WRAP__
  bool BeginRun(const Clouds& clouds) override;
  bool RunCloud(vtkPointSet* cloud, const Outputs& outputs) override;
  void EndRun(bool succeeded) override;
  /// Warns where the counters say that none of @p points is left.
  void WarnOfNothing(vtkIdType points);
#endif

  vtkSmartPointer<vtkAbstractTransform> Transform;
  vtkIdType NumberOfClippedPoints;
  vtkIdType NumberOfInvalidPoints;

private:
  class Internals;
  std::unique_ptr<Internals> Impl;

  void UpdateVectors();

  pointhaptics::VoxelMeanSettings Settings;
  int NumberOfThreads = 0;
  // Copies of settings that are returned by pointers, in VTK's order.
  double WorkspaceBounds[6];
  int Dimensions[3];

  vtkVoxelMeanResampler(const vtkVoxelMeanResampler&) = delete;
  void operator=(const vtkVoxelMeanResampler&) = delete;
};

#endif
