/**
 * @class   vtkKernelBandwidthFilter
 * @brief   kernel bandwidth, proxy radius and density at every point, from its neighbourhood
 *
 * For each point the spread s of its neighbourhood gives a kernel bandwidth b by a rule of kernel density
 * estimation, and the bandwidth a radius for the haptic proxy: large where the cloud is sparse, small where
 * it is dense. NormalReference         b = 1.06 s n^(-1/5)                    (the paper's rule with its
 * misprint mended; default) SilvermanRobust         b = 0.9 min(s, IQR / 1.34) n^(-1/5)    (of the distances)
 *   ScottMultivariate       b = s n^(-1/(d + 4)), d = 2
 *   SilvermanMultivariate   b = s (n (d + 2) / 4)^(-1/(d + 4)), d = 2
 * n = the number of points of the neighbourhood, the point itself among them; s = sqrt(trace(C) / 2) with C
 * the neighbourhood's sample covariance (divided by n - 1): the standard deviation along one direction of the
 * surface. Proxy radius = clamp(RadiusScale b, r1, r2).
 *
 * Output: the input with the point arrays added that are asked for: "Bandwidth" and "ProxyRadius" (double,
 * metres, or whatever unit the points have) and "Density" (double, per squared unit: the Gaussian kernel
 * density estimate f_b(x) = 1/(N 2 pi b^2) sum_i exp(-|x - x_i|^2 / (2 b^2)) on a surface, cut off at 6 b,
 * which leaves out less than 2e-8 of a kernel's height for each point beyond).
 *
 * Neighbourhoods are exact (k nearest, ties broken by the point's index), points that are NaN or infinite
 * take no part and get the value 0. A neighbourhood without spread (duplicates, a single point) gets as its
 * radius the bound r1 and the bandwidth r1 / RadiusScale: never 0, NaN or infinity for a valid point.
 *
 * Results do not depend on the number of threads. Cost: O(n log n); about 60 bytes per point while it runs.
 * @warning A number of neighbours below 1, a radius not above 0 or r1 > r2 is reported by vtkErrorMacro and
 * gives an empty output.
 * @sa vtkVoxelMeanResampler
 */
#ifndef vtkKernelBandwidthFilter_h
#define vtkKernelBandwidthFilter_h

#include "PointHapticsFiltersModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class POINTHAPTICSFILTERS_EXPORT vtkKernelBandwidthFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkKernelBandwidthFilter* New();
  vtkTypeMacro(vtkKernelBandwidthFilter, vtkPolyDataAlgorithm);
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
    SilvermanMultivariate = 3
  };

  ///@{
  /**
   * What counts as the neighbourhood of a point. In a fixed ball the spread hardly changes with density, so
   * only KNearest (default) makes the radius follow it.
   */
  vtkSetClampMacro(Neighborhood, int, KNearest, FixedRadius);
  vtkGetMacro(Neighborhood, int);
  void SetNeighborhoodToKNearest() { this->SetNeighborhood(KNearest); }
  void SetNeighborhoodToFixedRadius() { this->SetNeighborhood(FixedRadius); }
  ///@}

  ///@{
  /**
   * Neighbours of KNearest, the point itself not counted; at least 1. More than the cloud has: all of it.
   * Default: 16.
   */
  vtkSetMacro(NumberOfNeighbors, int);
  vtkGetMacro(NumberOfNeighbors, int);
  ///@}

  ///@{
  /**
   * Radius of FixedRadius in the units of the points, above 0. Default: 0.001.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Rule from spread to bandwidth. Default: NormalReference.
   */
  vtkSetClampMacro(Rule, int, NormalReference, SilvermanMultivariate);
  vtkGetMacro(Rule, int);
  ///@}

  ///@{
  /**
   * beta of the paper: proxy radius over bandwidth, above 0. Default: 4, which for 16 neighbours on a
   * uniformly sampled surface is about 2.8 point spacings.
   */
  vtkSetMacro(RadiusScale, double);
  vtkGetMacro(RadiusScale, double);
  ///@}

  ///@{
  /**
   * r1 and r2 of the paper, bounds of the proxy radius in the units of the points. 0 (default) for r1:
   * automatic, 2.2 local spacings at each point, the radius at which a sphere no longer falls through the
   * widest gap of a random sample. 0 (default) for r2: no upper bound.
   */
  vtkSetMacro(MinimumRadius, double);
  vtkGetMacro(MinimumRadius, double);
  vtkSetMacro(MaximumRadius, double);
  vtkGetMacro(MaximumRadius, double);
  ///@}

  ///@{
  /**
   * Which arrays to add; what is off costs nothing, and Density costs a second search. Default: all on.
   */
  vtkSetMacro(ComputeBandwidth, bool);
  vtkGetMacro(ComputeBandwidth, bool);
  vtkBooleanMacro(ComputeBandwidth, bool);
  vtkSetMacro(ComputeProxyRadius, bool);
  vtkGetMacro(ComputeProxyRadius, bool);
  vtkBooleanMacro(ComputeProxyRadius, bool);
  vtkSetMacro(ComputeDensity, bool);
  vtkGetMacro(ComputeDensity, bool);
  vtkBooleanMacro(ComputeDensity, bool);
  ///@}

protected:
  vtkKernelBandwidthFilter() = default;
  ~vtkKernelBandwidthFilter() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int Neighborhood = KNearest;
  int NumberOfNeighbors = 16;
  double Radius = 0.001;
  int Rule = NormalReference;
  double RadiusScale = 4.0;
  double MinimumRadius = 0.0;
  double MaximumRadius = 0.0;
  bool ComputeBandwidth = true;
  bool ComputeProxyRadius = true;
  bool ComputeDensity = true;

private:
  vtkKernelBandwidthFilter(const vtkKernelBandwidthFilter&) = delete;
  void operator=(const vtkKernelBandwidthFilter&) = delete;
};

#endif
