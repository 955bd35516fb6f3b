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
 * The paper computes the bandwidth from the density of the points, because the proxy is to be large where
 * they are sparse and small where they are dense. The means of a resampled cloud stand about a voxel apart
 * whatever that density was. Where the input has the point array "VoxelPointCount" of vtkVoxelMeanResampler,
 * bandwidths and radii are therefore those of the points that the means stand for (see UsePointCounts).
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
 * while it runs. Parallel by vtkSMPTools; one thread may use an object at a time.
 *
 * Progress is reported ten times a second and more often, and AbortExecute ends the work there, with an empty
 * output.
 * @warning A number of neighbours below 1, a radius not above 0, r1 > r2 or a scale not above 0 is reported
 * by vtkErrorMacro and gives an empty output; so do more than 2^31 - 1 points.
 * @sa vtkVoxelMeanResampler
 */
#ifndef vtkKernelBandwidthFilter_h
#define vtkKernelBandwidthFilter_h

#include "Core/Bandwidth/BandwidthSettings.h" // For Settings
#include "PointHapticsFiltersModule.h"        // For export macro
#include "vtkCloudAlgorithm.h"

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
  virtual void SetNeighborhood(int value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::fixedRadius, value >= FixedRadius);
  }
  virtual int GetNeighborhood() const { return this->Settings.fixedRadius ? FixedRadius : KNearest; }
  void SetNeighborhoodToKNearest() { this->SetNeighborhood(KNearest); }
  void SetNeighborhoodToFixedRadius() { this->SetNeighborhood(FixedRadius); }
  ///@}

  ///@{
  /**
   * Neighbours of KNearest, the point itself not counted; at least 1. More than the cloud has: all of it.
   * Default: 16.
   */
  virtual void SetNumberOfNeighbors(int value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::numberOfNeighbors, value);
  }
  virtual int GetNumberOfNeighbors() const { return this->Settings.numberOfNeighbors; }
  ///@}

  ///@{
  /**
   * Radius of FixedRadius in the units of the points, above 0. Default: 0.001.
   */
  virtual void SetRadius(double value) { this->SetMember(&pointhaptics::BandwidthSettings::radius, value); }
  virtual double GetRadius() const { return this->Settings.radius; }
  ///@}

  ///@{
  /**
   * Rule from spread to bandwidth. Default: NormalReference.
   */
  virtual void SetRule(int value);
  virtual int GetRule() const { return static_cast<int>(this->Settings.rule); }
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
  virtual void SetRadiusScale(double value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::radiusScale, value);
  }
  virtual double GetRadiusScale() const { return this->Settings.radiusScale; }
  ///@}

  ///@{
  /**
   * r1 and r2 of the paper, bounds of the proxy radius in the units of the points. 0 (default) for r1:
   * automatic, 2.2 local spacings at each point, the radius at which a sphere no longer falls through the
   * widest gap of a random sample. 0 (default) for r2: no upper bound.
   */
  virtual void SetMinimumRadius(double value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::minimumRadius, value);
  }
  virtual double GetMinimumRadius() const { return this->Settings.minimumRadius; }
  virtual void SetMaximumRadius(double value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::maximumRadius, value);
  }
  virtual double GetMaximumRadius() const { return this->Settings.maximumRadius; }
  ///@}

  ///@{
  /**
   * Cut the radii to min_j (r_j + |x_i - x_j| / 2): the largest ones not above their own of which no two
   * differ by more than half the distance of their points, so that a proxy that moves meets no jump. No
   * radius falls below the smallest of the cloud, but beside a denser region one may fall below the automatic
   * r1. Default: off.
   */
  virtual void SetSmoothRadius(bool value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::smoothRadius, value);
  }
  virtual bool GetSmoothRadius() const { return this->Settings.smoothRadius; }
  vtkBooleanMacro(SmoothRadius, bool);
  ///@}

  ///@{
  /**
   * Kernel of Density, with t the distance over the bandwidth b. Gaussian (default): 1/(N 2 pi b^2) sum_i
   * exp(-t_i^2 / 2), cut off at t = 6, which leaves out less than 2e-8 of a kernel's height for each point
   * beyond. Epanechnikov: 1/(N 3 pi b^2) sum_i (1 - t_i^2 / 6) over t_i^2 < 6, where nothing is cut off.
   */
  virtual void SetDensityKernel(int value);
  virtual int GetDensityKernel() const { return static_cast<int>(this->Settings.densityKernel); }
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
  virtual void SetUsePointCounts(bool value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::usePointCounts, value);
  }
  virtual bool GetUsePointCounts() const { return this->Settings.usePointCounts; }
  vtkBooleanMacro(UsePointCounts, bool);
  ///@}

  ///@{
  /**
   * Add "MeanBandwidth" (double, in the unit of the points): the bandwidths of the means themselves, whatever
   * points they stand for. That is how far apart they are, and so the length for splats that are to close a
   * surface (vtkSplatMapper). Without VoxelPointCount it is Bandwidth. Default: off.
   */
  virtual void SetComputeMeanBandwidth(bool value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::computeMeanBandwidth, value);
  }
  virtual bool GetComputeMeanBandwidth() const { return this->Settings.computeMeanBandwidth; }
  vtkBooleanMacro(ComputeMeanBandwidth, bool);
  ///@}

  ///@{
  /**
   * Which arrays to add; what is off costs nothing. Default: Bandwidth and ProxyRadius. Density costs a
   * second search, five times the time of both: it is made when it is asked for.
   */
  virtual void SetComputeBandwidth(bool value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::computeBandwidth, value);
  }
  virtual bool GetComputeBandwidth() const { return this->Settings.computeBandwidth; }
  vtkBooleanMacro(ComputeBandwidth, bool);
  virtual void SetComputeProxyRadius(bool value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::computeProxyRadius, value);
  }
  virtual bool GetComputeProxyRadius() const { return this->Settings.computeProxyRadius; }
  vtkBooleanMacro(ComputeProxyRadius, bool);
  virtual void SetComputeDensity(bool value)
  {
    this->SetMember(&pointhaptics::BandwidthSettings::computeDensity, value);
  }
  virtual bool GetComputeDensity() const { return this->Settings.computeDensity; }
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
  void EndRun(bool succeeded) override;
#endif

private:
#ifndef __VTK_WRAP__ // which cannot read pointers to members
  template <typename Owner, typename Value>
  void SetMember(Value Owner::*member, Value value)
  {
    pointhaptics::BandwidthSettings settings = this->Settings;
    settings.*member = value;
    this->SetSettings(settings);
  }
#endif
  bool Estimate(vtkPolyData* cloud);

  pointhaptics::BandwidthSettings Settings;
  pointhaptics::BandwidthSettings SettingsOfRun; // observers of progress may set others

  vtkKernelBandwidthFilter(const vtkKernelBandwidthFilter&) = delete;
  void operator=(const vtkKernelBandwidthFilter&) = delete;
};

#endif
