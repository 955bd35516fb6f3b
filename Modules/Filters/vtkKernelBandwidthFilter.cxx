#include "vtkKernelBandwidthFilter.h"

#include "BandwidthArrays.h"
#include "PolyDataAccess.h"
#include "SettingText.h"
#include "SmpExecutor.h"

#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Distributed/FarPoints.h"
#include "Core/Resample/TransformedBounds.h"

#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

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
    , Now(from)
    , From(from)
    , To(to)
  {
  }

  void run(std::int64_t count, std::int64_t grain, void* context, Body body) const override
  {
    using Clock = std::chrono::steady_clock;
    const std::int64_t largest = std::max<std::int64_t>(grain, (count + Slices - 1) / Slices);
    const std::int64_t shares = 4 * std::int64_t(this->concurrency());
    std::int64_t piece = 1; // a long one is heard of at once
    for (std::int64_t begin = 0; begin < count && !this->Filter->GetAbortExecute();)
    {
      const Clock::time_point start = Clock::now();
      const std::int64_t size = std::min(piece, count - begin);
      Shifted shifted{ context, body, begin };
      // A slice that is slow with few items is short of a grain for each thread.
      SmpExecutor::run(size, std::clamp<std::int64_t>(size / shares, 1, grain), &shifted,
        [](void* here, std::int64_t first, std::int64_t last)
        {
          const auto* s = static_cast<const Shifted*>(here);
          s->Inner(s->Context, s->Offset + first, s->Offset + last);
        });
      begin += size;
      this->Report(double(begin) / double(count));
      piece = std::min(largest, piece * (Clock::now() - start < kSlice ? 2 : 1));
    }
  }

private:
  static constexpr std::int64_t Slices = 8;
  static constexpr std::chrono::milliseconds kSlice{ 50 };
  struct Shifted
  {
    void* Context;
    Body Inner;
    std::int64_t Offset;
  };

  /// Several loops share the range: progress never decreases.
  void Report(double fraction) const
  {
    const double progress = this->From + (this->To - this->From) * fraction;
    if (progress > this->Now)
    {
      this->Now = progress;
      this->Filter->UpdateProgress(progress);
      runSignalHandlers();
    }
  }

  vtkAlgorithm* Filter;
  mutable double Now;
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

bool vtkKernelBandwidthFilter::BeginRun(const Clouds&)
{
  this->SettingsOfRun = this->Settings;
  const Status status = this->Settings.check();
  if (status != Status::Ok)
  {
    this->Fail(bandwidthProblem(this->Settings, status));
  }
  return status == Status::Ok;
}

void vtkKernelBandwidthFilter::EndRun(bool) {}

bool vtkKernelBandwidthFilter::RunCloud(vtkPointSet* cloud, const Outputs& outputs)
{
  if (cloud->GetNumberOfPoints() > NeighborQuery::kMostPoints)
  {
    this->Fail("The input has " + std::to_string(cloud->GetNumberOfPoints()) + " points, more than " +
      std::to_string(NeighborQuery::kMostPoints) + ": resample it first.");
    return false;
  }
  passCloud(cloud, outputs[0]);
  const BandwidthSettings& settings = this->SettingsOfRun;
  const bool wanted = settings.computeBandwidth || settings.computeProxyRadius || settings.computeDensity ||
    settings.computeMeanBandwidth;
  return !wanted || this->Estimate(outputs[0]);
}

namespace
{

/// Why balls of @p radius about all points would be looked at for hours; empty: they would not.
std::string tooManyPairs(const NeighborQuery& query, double radius)
{
  constexpr std::int64_t kSample = 64;
  constexpr double kMostPairs = 1e12; // half an hour of two cores
  const std::int64_t step = std::max<std::int64_t>(1, query.size() / kSample);
  std::int64_t balls = 0;
  std::int64_t found = 0;
  for (std::int64_t slot = 0; slot < query.size(); slot += step)
  {
    ++balls;
    query.visitBallSlots(query.point(slot), radius, [&](double, std::int64_t) { ++found; });
  }
  const double each = double(found) / double(std::max<std::int64_t>(1, balls));
  return each * double(query.size()) <= kMostPairs
    ? ""
    : "balls of the radius " + std::to_string(radius) + " hold " + std::to_string(std::int64_t(each)) +
      " points each, which takes hours; give a smaller radius, or a number of neighbors.";
}

} // namespace

/// @return false where an abort was asked for.
bool vtkKernelBandwidthFilter::Estimate(vtkPolyData* cloud)
{
  LocalBandwidthSettings settings = this->SettingsOfRun;
  settings.smoothRadius = settings.smoothRadius && this->SettingsOfRun.computeProxyRadius;
  const PointAccess points(cloud->GetPoints());
  const double found = this->SettingsOfRun.computeDensity ? 0.4 : 0.95;
  NeighborQuery query;
  query.build(points.view(), SmpExecutor());
  this->UpdateProgress(0.1);
  std::string problem = settings.fixedRadius ? tooManyPairs(query, settings.radius) : "";
  if (!problem.empty())
  {
    this->Fail(problem);
    return false;
  }
  const std::vector<double> counts = voxelCounts(cloud, settings.usePointCounts, problem);
  this->Warn(problem);
  this->Warn(invalidPoints(points.view().size() - query.finitePoints(), points.view().size()));
  if (const FarPoints far = findFarPoints(points.view(), transformedBounds(points.view(), {}, SmpExecutor()));
      far.count > 0 && counts.empty())
  {
    this->Warn(
      far.text() + "; density and bandwidth there are those of the gap: clip them off to leave them out");
  }
  const bool wantsPoints = this->SettingsOfRun.computeBandwidth || this->SettingsOfRun.computeProxyRadius;
  const bool wantsMeans = this->SettingsOfRun.computeDensity || this->SettingsOfRun.computeMeanBandwidth;
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
    (void)localBandwidths(points.view(), {}, query, alone, ofMeans, unused,
      ReportingExecutor(this, wantsPoints ? found : 0.1, found));
  }
  const std::vector<double>& widths = counts.empty() ? bandwidths : ofMeans;
  if (this->SettingsOfRun.computeDensity && !this->GetAbortExecute())
  {
    surfaceDensities(points.view(), counts, query, widths, densities, ReportingExecutor(this, found, 0.95),
      this->SettingsOfRun.densityKernel);
  }
  if (this->GetAbortExecute())
  {
    return false;
  }
  addBandwidthArrays(cloud, this->SettingsOfRun, densities, widths, bandwidths, radii);
  return true;
}

void vtkKernelBandwidthFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  keyed::printSettings(os, indent, this->Settings);
}
