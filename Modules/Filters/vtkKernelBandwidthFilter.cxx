#include "vtkKernelBandwidthFilter.h"

#include "PolyDataAccess.h"
#include "SettingText.h"
#include "SmpExecutor.h"
#include "VoxelOutput.h"

#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Base/Host/InterpreterLock.h"
#include "Core/Distributed/FarPoints.h"
#include "Core/Distributed/SharedBandwidths.h"
#include "Core/Resample/TransformedBounds.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

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
class ReportingExecutor : public Executor
{
public:
  ReportingExecutor(vtkAlgorithm* filter, double from, double to)
    : Filter(filter)
    , Now(from)
    , From(from)
    , To(to)
  {
  }

  int concurrency() const override { return this->Smp.concurrency(); }
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
      // A slice that is slow with few items is short of a grain for each thread.
      forRange(this->Smp, size, std::clamp<std::int64_t>(size / shares, 1, grain),
        [&](std::int64_t first, std::int64_t last) { body(context, begin + first, begin + last); });
      begin += size;
      this->Report(double(begin) / double(count));
      piece = std::min(largest, piece * (Clock::now() - start < kSlice ? 2 : 1));
    }
  }

private:
  static constexpr std::int64_t Slices = 8;
  static constexpr std::chrono::milliseconds kSlice{ 50 };

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

  SmpExecutor Smp;
  vtkAlgorithm* Filter;
  mutable double Now;
  double From;
  double To;
};

/// The points and their arrays: a vtkPolyData as it is, others with a vertex each.
void passCloud(vtkPointSet* cloud, vtkPolyData* output)
{
  if (vtkPolyData::SafeDownCast(cloud))
  {
    output->ShallowCopy(cloud);
  }
  else
  {
    output->SetPoints(cloud->GetPoints());
    output->SetVerts(makeVertices(cloud->GetNumberOfPoints(), SmpExecutor()));
    output->GetPointData()->ShallowCopy(cloud->GetPointData());
    output->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  }
  if (!output->GetPoints())
  {
    output->SetPoints(vtkNew<vtkPoints>());
  }
}

/// VoxelPointCount; empty where it is missing or of no use. @p problem: why it is of no use.
std::vector<double> voxelCounts(vtkPolyData* cloud, std::string& problem)
{
  vtkAbstractArray* any = cloud->GetPointData()->GetAbstractArray("VoxelPointCount");
  auto* array = vtkDataArray::SafeDownCast(any);
  const vtkIdType points = cloud->GetNumberOfPoints();
  bool areCounts = array && array->GetNumberOfComponents() == 1 && array->GetNumberOfTuples() == points;
  std::vector<double> counts;
  for (vtkIdType i = 0; areCounts && i < points; ++i)
  {
    counts.push_back(array->GetComponent(i, 0));
    areCounts = counts.back() > 0.0 && std::isfinite(counts.back());
  }
  if (any && !areCounts)
  {
    counts.clear();
    problem = "VoxelPointCount is not a number above 0 for each point: bandwidths are those of the points as "
              "they are. Mend the array, or remove it.";
  }
  return counts;
}

/// Why settings.check() gave @p status.
std::string problemOf(const BandwidthSettings& settings, Status status)
{
  std::ostringstream text;
  text << "NumberOfNeighbors " << settings.numberOfNeighbors << ", Radius " << settings.radius
       << ", RadiusScale " << settings.radiusScale << ", MinimumRadius " << settings.minimumRadius
       << ", MaximumRadius " << settings.maximumRadius << ": " << message(status) << ".";
  return text.str();
}

void addArray(vtkPolyData* output, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(vtkIdType(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  output->GetPointData()->AddArray(array);
}

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

/// Makes the arrays that are wanted. Aborted: @p filter was asked to stop.
Status search(vtkAlgorithm* filter, const BandwidthSettings& wanted, const PointView& points,
  const std::vector<double>& counts, const NeighborQuery& query, BandwidthsOfPoints& found)
{
  const double end = wanted.computeDensity ? 0.4 : 0.95;
  const bool wantsPoints = wanted.computeBandwidth || wanted.computeProxyRadius;
  const bool wantsMeans = wanted.computeDensity || wanted.computeMeanBandwidth;
  Status status = Status::Ok;
  // One search does for both where each mean is one point.
  if (wantsPoints || counts.empty())
  {
    status = localBandwidths(
      points, counts, query, wanted, found.bandwidths, found.radii, ReportingExecutor(filter, 0.1, end));
  }
  if (wantsMeans && counts.empty())
  {
    found.ofMeans = found.bandwidths;
  }
  else if (wantsMeans && !filter->GetAbortExecute())
  {
    std::vector<double> unused;
    static_cast<void>(localBandwidths(points, {}, query, wanted, found.ofMeans, unused,
      ReportingExecutor(filter, wantsPoints ? end : 0.1, end)));
  }
  if (wanted.computeDensity && !filter->GetAbortExecute())
  {
    surfaceDensities(points, counts, query, found.ofMeans, found.densities,
      ReportingExecutor(filter, end, 0.95), wanted.densityKernel);
  }
  return filter->GetAbortExecute() ? Status::Aborted : status;
}

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
    this->Fail(problemOf(this->Settings, status));
  }
  return status == Status::Ok;
}

bool vtkKernelBandwidthFilter::RunCloud(vtkPointSet* cloud, const Outputs& outputs)
{
  const BandwidthSettings& settings = this->SettingsOfRun;
  vtkPolyData* output = outputs[0];
  passCloud(cloud, output);
  if (!settings.computeBandwidth && !settings.computeProxyRadius && !settings.computeDensity &&
    !settings.computeMeanBandwidth)
  {
    return true;
  }
  std::string problem;
  const auto counts = settings.usePointCounts ? voxelCounts(output, problem) : std::vector<double>();
  this->Warn(problem);
  const PointAccess points(output->GetPoints());
  BandwidthsOfPoints found;
  const Status status = this->Estimate(points.view(), counts, found);
  if (status != Status::Ok)
  {
    if (status != Status::Aborted)
    {
      this->Fail(problemOf(settings, status));
    }
    return false;
  }
  const std::tuple<bool, const char*, const std::vector<double>&> arrays[] = {
    { settings.computeDensity, "Density", found.densities },
    { settings.computeMeanBandwidth, "MeanBandwidth", found.ofMeans },
    { settings.computeBandwidth, "Bandwidth", found.bandwidths },
    { settings.computeProxyRadius, "ProxyRadius", found.radii },
  };
  for (const auto& [isWanted, name, values] : arrays)
  {
    if (isWanted)
    {
      addArray(output, name, values);
    }
  }
  return true;
}

Status vtkKernelBandwidthFilter::Estimate(
  const PointView& points, const std::vector<double>& counts, BandwidthsOfPoints& found)
{
  if (points.size() > NeighborQuery::kMostPoints)
  {
    this->Fail("The input has " + std::to_string(points.size()) + " points, more than " +
      std::to_string(NeighborQuery::kMostPoints) + ": resample it first.");
    return Status::Aborted;
  }
  NeighborQuery query;
  query.build(points, SmpExecutor());
  this->UpdateProgress(0.1);
  const bool isFixed = this->SettingsOfRun.fixedRadius;
  const std::string problem = isFixed ? tooManyPairs(query, this->SettingsOfRun.radius) : "";
  if (!problem.empty())
  {
    this->Fail(problem);
    return Status::Aborted;
  }
  if (const std::int64_t invalid = points.size() - query.finitePoints(); invalid > 0)
  {
    this->Warn(std::to_string(invalid) + " of " + std::to_string(points.size()) +
      " points are NaN or infinite: they have bandwidth and radius 0. Remove them first.");
  }
  if (const FarPoints far = findFarPoints(points, transformedBounds(points, {}, SmpExecutor()));
      far.count > 0 && counts.empty())
  {
    this->Warn(
      far.text() + "; density and bandwidth there are those of the gap: clip them off to leave them out");
  }
  return search(this, this->SettingsOfRun, points, counts, query, found);
}

void vtkKernelBandwidthFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  keyed::printSettings(os, indent, this->Settings);
}
