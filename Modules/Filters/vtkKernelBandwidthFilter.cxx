#include "vtkKernelBandwidthFilter.h"

#include "BandwidthArrays.h"
#include "PolyDataAccess.h"
#include "PrintSettings.h"
#include "SmpExecutor.h"

#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Base/Host/GuardedWork.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>

using namespace pointhaptics;

vtkStandardNewMacro(vtkKernelBandwidthFilter);

static_assert(int(vtkKernelBandwidthFilter::SheatherJones) == int(BandwidthRule::SheatherJones),
  "the filter's rules are Core's, in the same order");
static_assert(int(vtkKernelBandwidthFilter::Epanechnikov) == int(pointhaptics::DensityKernel::Epanechnikov),
  "the filter's kernels are Core's, in the same order");

namespace
{

/// Runs a loop in slices on VTK's threads and reports the filter's progress after each slice. After an abort
/// request it skips the remaining slices; the results of the loop are invalid then.
class ReportingExecutor : public SmpExecutor
{
public:
  ReportingExecutor(vtkAlgorithm* filter, double from, double to)
    : Filter(filter)
    , From(from)
    , To(to)
  {
  }

  void run(std::int64_t count, std::int64_t grain, void* context, Body body) const override
  {
    const std::int64_t piece =
      std::max<std::int64_t>(4 * grain, std::min((count + Slices - 1) / Slices, MostInSlice));
    for (std::int64_t begin = 0; begin < count && !this->Filter->GetAbortExecute(); begin += piece)
    {
      Shifted shifted{ context, body, begin };
      SmpExecutor::run(std::min(piece, count - begin), grain, &shifted,
        [](void* here, std::int64_t first, std::int64_t last)
        {
          const auto* s = static_cast<const Shifted*>(here);
          s->Inner(s->Context, s->Offset + first, s->Offset + last);
        });
      this->Report(double(begin + piece) / double(count));
    }
  }

private:
  static constexpr std::int64_t Slices = 8;
  /// Some 50 ms: an abort request waits no longer.
  static constexpr std::int64_t MostInSlice = 250000;
  struct Shifted
  {
    void* Context;
    Body Inner;
    std::int64_t Offset;
  };

  /// Several loops share the range: progress never decreases.
  void Report(double fraction) const
  {
    const double progress = this->From + (this->To - this->From) * std::min(fraction, 1.0);
    if (progress > this->Filter->GetProgress())
    {
      this->Filter->UpdateProgress(progress);
    }
  }

  vtkAlgorithm* Filter;
  double From;
  double To;
};

}

void vtkKernelBandwidthFilter::SetSettings(const BandwidthSettings& settings)
{
  if (!equalSettings(this->Settings, settings))
  {
    this->Settings = settings;
    this->Modified();
  }
}

void vtkKernelBandwidthFilter::SetRule(int value)
{
  this->SetMember(
    &BandwidthSettings::rule, BandwidthRule(std::clamp<int>(value, NormalReference, SheatherJones)));
}

void vtkKernelBandwidthFilter::SetDensityKernel(int value)
{
  this->SetMember(&BandwidthSettings::densityKernel,
    pointhaptics::DensityKernel(std::clamp<int>(value, Gaussian, Epanechnikov)));
}

int vtkKernelBandwidthFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* input = vtkPolyData::GetData(inputVector[0]);
  auto* output = vtkPolyData::GetData(outputVector);

  LocalBandwidthSettings settings = this->Settings;
  settings.smoothRadius = settings.smoothRadius && this->Settings.computeProxyRadius;
  this->SetErrorCode(0);
  const Status status = settings.check();
  if (status != Status::Ok)
  {
    vtkErrorMacro(<< bandwidthProblem(this->Settings, status));
    return 1;
  }
  if (input->GetNumberOfPoints() > NeighborQuery::kMostPoints)
  {
    vtkErrorMacro("The input has " << input->GetNumberOfPoints() << " points, more than "
                                   << NeighborQuery::kMostPoints << ": resample it first.");
    return 1;
  }
  output->ShallowCopy(input);
  const bool wanted = this->Settings.computeBandwidth || this->Settings.computeProxyRadius ||
    this->Settings.computeDensity || this->Settings.computeMeanBandwidth;
  bool isMade = !wanted;
  const Status end = guardedWork([&] { isMade = isMade || this->Estimate(input, output, settings); });
  if (!isMade)
  {
    output->Initialize();
  }
  if (end != Status::Ok)
  {
    this->SetErrorCode(kOutOfMemoryCode);
    vtkErrorMacro(<< message(end) << ".");
  }
  return 1;
}

/// @return false where an abort was asked for.
bool vtkKernelBandwidthFilter::Estimate(
  vtkPolyData* input, vtkPolyData* output, const LocalBandwidthSettings& settings)
{
  const PointAccess points(input->GetPoints());
  const double found = this->Settings.computeDensity ? 0.4 : 0.95;
  NeighborQuery query;
  query.build(points.view(), SmpExecutor());
  this->UpdateProgress(0.1);
  const std::vector<double> counts = voxelCounts(input, settings.usePointCounts);
  const bool wantsPoints = this->Settings.computeBandwidth || this->Settings.computeProxyRadius;
  const bool wantsMeans = this->Settings.computeDensity || this->Settings.computeMeanBandwidth;
  std::vector<double> bandwidths;
  std::vector<double> radii;
  std::vector<double> ofMeans;
  std::vector<double> densities;
  // One search does for both where each mean is one point.
  if (this->GetAbortExecute() ||
    ((wantsPoints || counts.empty()) &&
      localBandwidths(points.view(), counts, query, settings, bandwidths, radii,
        ReportingExecutor(this, 0.1, found)) != Status::Ok))
  {
    return false;
  }
  if (wantsMeans && !counts.empty() && !this->GetAbortExecute())
  {
    LocalBandwidthSettings alone = settings;
    alone.smoothRadius = false;
    std::vector<double> unused;
    (void)localBandwidths(points.view(), query, alone, ofMeans, unused,
      ReportingExecutor(this, wantsPoints ? found : 0.1, found));
  }
  const std::vector<double>& widths = counts.empty() ? bandwidths : ofMeans;
  if (this->Settings.computeDensity && !this->GetAbortExecute())
  {
    surfaceDensities(points.view(), counts, query, widths, densities, ReportingExecutor(this, found, 0.95),
      this->Settings.densityKernel);
  }
  if (this->GetAbortExecute())
  {
    return false;
  }
  addBandwidthArrays(output, this->Settings, densities, widths, bandwidths, radii);
  this->UpdateProgress(1.0);
  return true;
}

void vtkKernelBandwidthFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  printSettings(os, indent, this->Settings);
}
