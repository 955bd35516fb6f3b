/**
 * @class   vtkHapticFeel
 * @brief   what a hand feels of a point cloud along a path, in virtual time
 *
 * Port 0 takes the cloud (any vtkPointSet, its points float or double), port 1 the path of the hand: a
 * vtkTable with the columns t, x, y and z, or t, hip_x, hip_y and hip_z as this filter writes them (seconds
 * and metres in the frame of the transformed cloud, times strictly ascending). The output is the table of
 * `pointhaptics feel`: one row a tick of Rate, with the double columns t, hip_x, hip_y, hip_z, proxy_x,
 * proxy_y, proxy_z, normal_x, normal_y, normal_z, force_x, force_y, force_z, radius, contact and update_us
 * (seconds, metres, newtons; contact 0 or 1; update_us the wall time of the tick in microseconds). The same
 * input gives the same bits on every machine and with any number of threads, update_us aside.
 *
 * Use:
 *
 * @code
 * vtkNew< vtkHapticFeel > feel;
 * feel->SetInputConnection(0, reader->GetOutputPort());
 * feel->SetInputConnection(1, table->GetOutputPort());
 * feel->GetResampler()->SetVoxelSize(0.001); // lattice and transform, where the default is not wanted
 * feel->Update();
 * @endcode
 *
 * The cloud is resampled as GetResampler() says and its proxy radii follow the rule of GetBandwidthFilter():
 * set lattice, transform and rule there. The scene that comes of it is kept until the cloud, one of these or
 * UseCovariance or RefineNearHand changes, so that many paths are felt in one scene.
 *
 * Of a composite each block is felt alone, and the output is a composite of tables. Blocks without points are
 * left empty with a warning.
 *
 * @warning A path without rows or columns, times that do not ascend, numbers that are not finite, more than
 * 1e8 ticks, gains out of range and a cloud without a finite point in the workspace are reported by
 * vtkErrorMacro with the cure, and the output has no rows. Sizes and times that make other units likely
 * are said by vtkWarningMacro. A cloud without points gives no rows without a message: whatever left it empty
 * has said why.
 *
 * Cost: the resampling, some 10 us a tick and 128 bytes a row. Progress is reported; AbortExecute ends the
 * work within 256 ticks, with an output without rows. One object is used by one thread at a time.
 *
 * @sa vtkVoxelMeanResampler vtkKernelBandwidthFilter
 */
#ifndef vtkHapticFeel_h
#define vtkHapticFeel_h

#include "Haptics/HapticParameters.h" // For Settings
#include "PointHapticsSceneModule.h"  // For export macro
#include "vtkCloudAlgorithm.h"        // For vtkSettingMacro
#include "vtkTableAlgorithm.h"

#include <memory> // For Internals

class vtkKernelBandwidthFilter;
class vtkVoxelMeanResampler;

class POINTHAPTICSSCENE_EXPORT vtkHapticFeel : public vtkTableAlgorithm
{
public:
  static vtkHapticFeel* New();
  vtkTypeMacro(vtkHapticFeel, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    SurfaceFit = 0,
    GradientSteps = 1,
    Sphere = 2
  };

  ///@{
  /**
   * How the proxy meets the surface: by a local fit, by the paper's iteration, or as a sphere among the
   * points. Default: SurfaceFit.
   */
  vtkSettingEnumMacro(Method, method, Sphere);
  void SetMethodToSurfaceFit() { this->SetMethod(SurfaceFit); }
  void SetMethodToGradientSteps() { this->SetMethod(GradientSteps); }
  void SetMethodToSphere() { this->SetMethod(Sphere); }
  ///@}

  ///@{
  /**
   * Spring between hand and proxy, N/m, 0 to 1e5. Default: 800.
   */
  vtkSettingMacro(Stiffness, double, contact.stiffness);
  ///@}

  ///@{
  /**
   * Damping of the hand's speed along the normal, in contact, N s/m, 0 to 1e3. Default: 0.
   */
  vtkSettingMacro(Damping, double, contact.damping);
  ///@}

  ///@{
  /**
   * mu_s and mu_d of the paper, 0 to 10, the dynamic one not above the static one. Default: 0.
   */
  vtkSettingMacro(StaticFriction, double, contact.staticFriction);
  vtkSettingMacro(DynamicFriction, double, contact.dynamicFriction);
  ///@}

  ///@{
  /**
   * All of the above as one plain value, with the other parameters of a Proxy.
   */
  virtual void SetSettings(const pointhaptics::HapticParameters& settings);
  const pointhaptics::HapticParameters& GetSettings() const { return this->Settings; }
  ///@}

  ///@{
  /**
   * Ticks a second, 1 to 1e5. Between two rows of the path the hand moves linearly. Default: 1000.
   */
  vtkSetMacro(Rate, double);
  vtkGetMacro(Rate, double);
  ///@}

  ///@{
  /**
   * Feel the second moments of the voxels beside their means: more accurate. Default: on.
   */
  vtkSetMacro(UseCovariance, bool);
  vtkGetMacro(UseCovariance, bool);
  vtkBooleanMacro(UseCovariance, bool);
  ///@}

  ///@{
  /**
   * Where that tells more, feel voxels near the hand about as fine as the points. Turn it off where the
   * voxels of the resampler are to be felt everywhere, as the program does for --dims and --voxel. Needs
   * UseCovariance. Default: on.
   */
  vtkSetMacro(RefineNearHand, bool);
  vtkGetMacro(RefineNearHand, bool);
  vtkBooleanMacro(RefineNearHand, bool);
  ///@}

  ///@{
  /**
   * Lattice, transform and rule of the filters that the cloud goes through. Each run has filters of its own
   * with these settings, so that what an observer sets here counts from the next run on.
   */
  vtkVoxelMeanResampler* GetResampler();
  vtkKernelBandwidthFilter* GetBandwidthFilter();
  ///@}

  ///@{
  /**
   * As in vtkCloudAlgorithm. Default: on.
   */
  vtkSetMacro(RepeatsErrors, bool);
  vtkGetMacro(RepeatsErrors, bool);
  vtkBooleanMacro(RepeatsErrors, bool);
  ///@}

  /**
   * Number of points of the resampled cloud that were felt in the last update.
   */
  vtkGetMacro(NumberOfFeltPoints, vtkIdType);

  /**
   * MTime of the filter, the two inner filters included.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkHapticFeel();
  ~vtkHapticFeel() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int ComputePipelineMTime(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*, int, vtkMTimeType*) override;
  vtkMTimeType SettingsTime();

  bool RepeatsErrors = true;
  pointhaptics::HapticParameters Settings;
  double Rate = 1000.0;
  bool UseCovariance = true;
  bool RefineNearHand = true;
  vtkIdType NumberOfFeltPoints = 0;

private:
  class Internals;
  std::unique_ptr<Internals> Impl;

  vtkHapticFeel(const vtkHapticFeel&) = delete;
  void operator=(const vtkHapticFeel&) = delete;
};

#endif
