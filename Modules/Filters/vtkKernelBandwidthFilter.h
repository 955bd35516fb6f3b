/**
 * @class   vtkKernelBandwidthFilter
 * @brief   kernel bandwidth, proxy radius and on request density at every point, from its neighbourhood
 *
 * For each point the spread s of its neighbourhood gives a kernel bandwidth b by a rule of kernel density
 * estimation, and the bandwidth a radius for the haptic proxy, clamp(RadiusScale b, r1, r2): large where the
 * cloud is sparse, small where it is dense. n is the number of points of the neighbourhood, the point itself
 * among them.
 *
 * | Rule                  | b                                                            |
 * |-----------------------|--------------------------------------------------------------|
 * | NormalReference       | 1.06 s n^(-1/5): the paper's, its misprint mended; default    |
 * | SilvermanRobust       | 0.9 min(s', IQR / 1.34) n^(-1/5), of the distances            |
 * | ScottMultivariate     | s n^(-1/(d + 4)), d = 2                                       |
 * | SilvermanMultivariate | s (n (d + 2) / 4)^(-1/(d + 4)), d = 2                         |
 * | SheatherJones         | solve-the-equation, of the distances; 75 times as slow        |
 *
 * s = sqrt(trace(C) / 2) with C the neighbourhood's sample covariance (divided by n - 1): the standard
 * deviation along one direction of the surface. s' and IQR are those of the distances of the neighbours,
 * which are also the sample of SheatherJones.
 *
 * The means of a resampled cloud stand about a voxel apart whatever the density of its points was. Where the
 * input has the point array "VoxelPointCount" of vtkVoxelMeanResampler, bandwidths and radii are therefore
 * those of the points that the means stand for (UsePointCounts).
 *
 * Input: any vtkPointSet, or a composite of them (vtkCloudAlgorithm: neighbours are those of the same
 * block, and of the same piece where a pipeline runs on several processes); its points are read, float or
 * double, and VoxelPointCount. Output: a vtkPolyData as it is, of others the points with a vertex each, their
 * point arrays and field data; with the point arrays added that are asked for: "Bandwidth" and "ProxyRadius"
 * (double, metres, or whatever unit the points have) and "Density" (double, per squared unit: the kernel
 * density estimate on a surface with each point's own bandwidth, see DensityKernel). Arrays of these names in
 * the input are replaced; the active scalars stay.
 *
 * Neighbourhoods are exact (k nearest, ties broken by the point's index). Points that are NaN or infinite
 * take no part and get the value 0; a warning says how many. So does a VoxelPointCount that is of no use: not
 * a number above 0 for each point. A neighbourhood without spread (duplicates, a single point) gets as its
 * radius the bound r1 (where that is automatic: the smallest radius of other points, or a thousandth of the
 * cloud's diagonal, or 0.001) and the bandwidth r1 / RadiusScale: never 0, NaN or infinity for a valid point.
 *
 * Accuracy: bandwidths are within 1e-9 relative of the definition, and all values scale with the cloud.
 * Results do not depend on the number of threads, the SMP backend or the type of number, bit for bit.
 * Cost: O(n); 200 ns a point and thread for 16 neighbours, density six times as much. 100 bytes a point
 * while it runs. Parallel by vtkSMPTools. Progress is reported ten times a second and more often, and
 * AbortExecute ends the work there.
 * @warning A number of neighbours below 1, a radius not above 0, r1 > r2, a scale not above 0 and more than
 * 2^31 - 1 points are errors.
 * @sa vtkVoxelMeanResampler
 */
#ifndef vtkKernelBandwidthFilter_h
#define vtkKernelBandwidthFilter_h

#include "Core/Bandwidth/BandwidthSettings.h" // For Settings
#include "PointHapticsFiltersModule.h"        // For export macro
#include "vtkCloudAlgorithm.h"

#include <vector> // For Estimate

namespace pointhaptics
{
class PointView;
struct BandwidthsOfPoints;
}

class POINTHAPTICSFILTERS_EXPORT vtkKernelBandwidthFilter : public vtkCloudAlgorithm
{
public:
  static vtkKernelBandwidthFilter* New();
  vtkTypeMacro(vtkKernelBandwidthFilter, vtkCloudAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum NeighborhoodType
  {
    KNearest = 0,
    FixedRadius = 1
  };
  enum RuleType
  {
    NormalReference = 0,
    SilvermanRobust = 1,
    ScottMultivariate = 2,
    SilvermanMultivariate = 3,
    SheatherJones = 4
  };
  enum DensityKernelType
  {
    Gaussian = 0,
    Epanechnikov = 1
  };

  ///@{
  /**
   * Kind of a point's neighbourhood. In a fixed ball the spread hardly changes with density, so only KNearest
   * (default) makes the radius follow it.
   */
  vtkSettingEnumMacro(Neighborhood, fixedRadius, FixedRadius);
  void SetNeighborhoodToKNearest() { this->SetNeighborhood(KNearest); }
  void SetNeighborhoodToFixedRadius() { this->SetNeighborhood(FixedRadius); }
  ///@}

  ///@{
  /**
   * Neighbours of KNearest, the point itself not counted; at least 1. More than the cloud has: all of it.
   * Default: 16.
   */
  vtkSettingMacro(NumberOfNeighbors, int, numberOfNeighbors);
  ///@}

  ///@{
  /**
   * Radius of FixedRadius in the units of the points, above 0. Default: 0.001.
   */
  vtkSettingMacro(Radius, double, radius);
  ///@}

  ///@{
  /**
   * Rule from spread to bandwidth. Default: NormalReference.
   */
  vtkSettingEnumMacro(Rule, rule, SheatherJones);
  void SetRuleToNormalReference() { this->SetRule(NormalReference); }
  void SetRuleToSilvermanRobust() { this->SetRule(SilvermanRobust); }
  void SetRuleToScottMultivariate() { this->SetRule(ScottMultivariate); }
  void SetRuleToSilvermanMultivariate() { this->SetRule(SilvermanMultivariate); }
  void SetRuleToSheatherJones() { this->SetRule(SheatherJones); }
  ///@}

  ///@{
  /**
   * beta of the paper: proxy radius over bandwidth, above 0. Default: 4, which for 16 neighbours on a
   * uniformly sampled surface is about 2.8 point spacings.
   */
  vtkSettingMacro(RadiusScale, double, radiusScale);
  ///@}

  ///@{
  /**
   * r1 and r2 of the paper, bounds of the proxy radius in the units of the points. 0 (default) for r1:
   * automatic, 2.2 local spacings at each point, the radius at which a sphere no longer falls through the
   * widest gap of a random sample. 0 (default) for r2: no upper bound.
   */
  vtkSettingMacro(MinimumRadius, double, minimumRadius);
  vtkSettingMacro(MaximumRadius, double, maximumRadius);
  ///@}

  ///@{
  /**
   * Kernel of Density, with t the distance over the bandwidth b. Gaussian (default): 1/(N 2 pi b^2) sum_i
   * exp(-t_i^2 / 2), cut off at t = 6, which leaves out less than 2e-8 of a kernel's height for each point
   * beyond. Epanechnikov: 1/(N 3 pi b^2) sum_i (1 - t_i^2 / 6) over t_i^2 < 6, where nothing is cut off.
   */
  vtkSettingEnumMacro(DensityKernel, densityKernel, Epanechnikov);
  void SetDensityKernelToGaussian() { this->SetDensityKernel(Gaussian); }
  void SetDensityKernelToEpanechnikov() { this->SetDensityKernel(Epanechnikov); }
  ///@}

  ///@{
  /**
   * Where there is a point array VoxelPointCount: bandwidths and radii of the points in the voxels instead of
   * their means, and every point counts in Density, whose kernels keep the bandwidths of the means. c points
   * in each voxel of the neighbourhood have sqrt(1/c) of the spacing of the means, and so of the radius. A
   * cloud of 3.9:1 in spacing on 300^3 voxels has radii of 3.9:1, and 1.6:1 without; they are 5 % larger than
   * those of the raw points in the median. Where all counts are 1 nothing is changed, not a bit. Means
   * themselves may be farther apart than such a radius: a sphere that is to stand on them needs about 2.8
   * voxels (pointhaptics::HapticScene::coveringRadius). Default: on.
   */
  vtkSettingMacro(UsePointCounts, bool, usePointCounts);
  vtkBooleanMacro(UsePointCounts, bool);
  ///@}

  ///@{
  /**
   * Add "MeanBandwidth" (double, in the unit of the points): the bandwidths of the means themselves, whatever
   * points they stand for. That is how far apart they are, and so the length for splats that are to close a
   * surface (vtkSplatMapper). Without VoxelPointCount it is Bandwidth. Default: off.
   */
  vtkSettingMacro(ComputeMeanBandwidth, bool, computeMeanBandwidth);
  vtkBooleanMacro(ComputeMeanBandwidth, bool);
  ///@}

  ///@{
  /**
   * Which arrays to add; what is off costs nothing. Default: Bandwidth and ProxyRadius. Density costs a
   * second search, five times the time of both: it is made when it is asked for.
   */
  vtkSettingMacro(ComputeBandwidth, bool, computeBandwidth);
  vtkBooleanMacro(ComputeBandwidth, bool);
  vtkSettingMacro(ComputeProxyRadius, bool, computeProxyRadius);
  vtkBooleanMacro(ComputeProxyRadius, bool);
  vtkSettingMacro(ComputeDensity, bool, computeDensity);
  vtkBooleanMacro(ComputeDensity, bool);
  ///@}

  ///@{
  /**
   * All of the above as one plain value, which other filters, Core's functions and pointhaptics::HapticScene
   * take.
   */
  virtual void SetSettings(const pointhaptics::BandwidthSettings& settings);
  const pointhaptics::BandwidthSettings& GetSettings() const { return this->Settings; }
  ///@}

protected:
  vtkKernelBandwidthFilter() = default;
  ~vtkKernelBandwidthFilter() override = default;

#ifndef __VTK_WRAP__
  bool BeginRun(const Clouds& clouds) override;
  bool RunCloud(vtkPointSet* cloud, const Outputs& outputs) override;
  /// Estimates what the settings ask for, with warnings. Aborted: an abort was asked for, or Fail() was
  /// called.
  virtual pointhaptics::Status Estimate(const pointhaptics::PointView& points,
    const std::vector<double>& counts, pointhaptics::BandwidthsOfPoints& found);
#endif

private:
  pointhaptics::BandwidthSettings Settings;
  pointhaptics::BandwidthSettings SettingsOfRun; // observers of progress may set others

  vtkKernelBandwidthFilter(const vtkKernelBandwidthFilter&) = delete;
  void operator=(const vtkKernelBandwidthFilter&) = delete;
};

#endif
