/// How long do bandwidth and radius of every point take, and how far off are they, beside loops over other
/// libraries' searches?
#include "Benchmark/Bandwidth/Rivals/Rival.h"
#include "Benchmark/Harness/Race.h"
#include "Benchmark/Harness/RivalModule.h"
#include "Benchmark/Tasks.h"
#include "Clouds/Pipeline.h"
#include "Options/OptionParsing.h"

#include "vtkKernelBandwidthFilter.h"

#include "Core/Reference/ReferenceBandwidth.h"
#include "Shapes/Shapes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace pointhaptics::bench::bandwidth
{
namespace
{

using namespace app;

constexpr std::int64_t kMostPoints = 100000000;
constexpr std::int64_t kMostNeighbors = 1000;
/// Points whose answers are compared with long double.
constexpr int kCheckedPoints = 300;

const std::vector<RivalFile>& rivalFiles()
{
  static const std::vector<RivalFile> files{
#ifdef POINTHAPTICS_RIVAL_BANDWIDTH_PCL
    { "pcl", POINTHAPTICS_RIVAL_BANDWIDTH_PCL },
#endif
#ifdef POINTHAPTICS_RIVAL_BANDWIDTH_NANOFLANN
    { "nanoflann", POINTHAPTICS_RIVAL_BANDWIDTH_NANOFLANN },
#endif
  };
  return files;
}

struct Options
{
  std::int64_t points = 0; ///< 0: the default.
  std::int64_t neighbors = 16;
  std::string file;
};

struct NamedCloud
{
  std::string name;
  vtkSmartPointer<vtkPolyData> polyData; ///< Finite float points.

  PointView view() const
  {
    auto* coordinates = vtkFloatArray::SafeDownCast(polyData->GetPoints()->GetData());
    return { coordinates->GetPointer(0), polyData->GetNumberOfPoints() };
  }
};

NamedCloud cloudOf(const std::string& name, const std::vector<Vec3>& points)
{
  vtkNew<vtkPoints> floats;
  for (const Vec3& p : points)
  {
    floats->InsertNextPoint(p.x, p.y, p.z);
  }
  NamedCloud cloud{ name, vtkSmartPointer<vtkPolyData>::New() };
  cloud.polyData->SetPoints(floats);
  return cloud;
}

NamedCloud shapeCloud(Shape shape, std::int64_t count)
{
  std::vector<Vec3> points;
  static_cast<void>(generateShape(shape, count, 1, 0.0, points));
  return cloudOf(shapeName(shape), points);
}

/// Every so many points of the file, so that about @p count are left.
NamedCloud fileCloud(const std::string& fileName, std::int64_t count)
{
  const Cloud cloud = readCloud(fileName);
  const vtkIdType all = cloud.points->GetNumberOfPoints();
  std::vector<Vec3> points;
  for (vtkIdType i = 0; i < all; i += std::max<vtkIdType>(1, all / count))
  {
    Vec3 p;
    cloud.points->GetPoint(i, &p.x);
    if (isFinite(p))
    {
      points.push_back(p);
    }
  }
  return cloudOf(std::filesystem::path(fileName).filename().string(), points);
}

struct ExpectedPoint
{
  std::size_t index = 0;
  double bandwidth = 0.0;
  double radius = 0.0;
};

struct Verdict
{
  bool right = false;
  double worstError = 0.0; ///< Relative, of bandwidths and radii.
  std::string text;        ///< "right to 2e-16", "12 of 300 differ by up to 3 %".
};

constexpr double kOursMayDiffer = 1e-9;
constexpr double kOthersMayDiffer = 1e-4;

ExpectedPoint expectedAt(const BandwidthTask& task, std::int64_t center, std::vector<Neighbor>& all)
{
  all.clear();
  for (std::int64_t i = 0; i < task.points.size(); ++i)
  {
    all.push_back({ norm2(task.points[i] - task.points[center]), i });
  }
  const std::ptrdiff_t count = std::min<std::ptrdiff_t>(task.neighbors + 1, std::ptrdiff_t(all.size()));
  std::nth_element(all.begin(), all.begin() + count - 1, all.end());
  std::vector<std::int64_t> indices;
  std::for_each(all.begin(), all.begin() + count, [&](const Neighbor& n) { indices.push_back(n.index); });
  const auto n = (long double)(count);
  const long double b = reference::bandwidthFactor(BandwidthRule::NormalReference, n, 2) *
    reference::surfaceSpread(task.points, indices);
  const long double farthest = all[std::size_t(count - 1)].squaredDistance;
  const long double spacing = std::sqrt(farthest * 3.14159265358979323846264338327950288L / (n - 1));
  ExpectedPoint point;
  point.index = std::size_t(center);
  point.bandwidth = double(b);
  point.radius = double(std::max(kRadiusScale * b, kSmallestRadiusInSpacings * spacing));
  return point;
}

double relativeError(double value, double expected)
{
  const double error = std::fabs(value / expected - 1.0);
  return std::isfinite(error) ? error : INFINITY;
}

/// At @p count points spread over the cloud, by the definition in long double; those whose neighbourhood has
/// no spread are left out, as their answer is a matter of convention.
std::vector<ExpectedPoint> expectedPoints(const BandwidthTask& task, int count)
{
  std::vector<ExpectedPoint> expected;
  std::vector<Neighbor> all;
  const std::int64_t step = std::max<std::int64_t>(1, task.points.size() / count);
  for (std::int64_t i = 0; i < task.points.size(); i += step)
  {
    const ExpectedPoint point = expectedAt(task, i, all);
    if (point.bandwidth > 0.0)
    {
      expected.push_back(point);
    }
  }
  return expected;
}

/// Ours may be off by 1e-9 relative; a loop over numbers in float by 1e-4.
Verdict judge(const BandwidthAnswer& answer, const std::vector<ExpectedPoint>& expected, bool isOurs)
{
  const double tolerance = isOurs ? kOursMayDiffer : kOthersMayDiffer;
  Verdict verdict;
  std::size_t different = 0;
  for (const ExpectedPoint& point : expected)
  {
    const bool there = point.index < answer.bandwidths.size() && point.index < answer.radii.size();
    const double error = there ? std::max(relativeError(answer.bandwidths[point.index], point.bandwidth),
                                   relativeError(answer.radii[point.index], point.radius))
                               : INFINITY;
    verdict.worstError = std::max(verdict.worstError, error);
    different += error > tolerance ? 1 : 0;
  }
  verdict.right = different == 0;
  verdict.text = verdict.right ? fmt::format("right to {:.1g}", verdict.worstError)
                               : fmt::format("{}{} of {} differ by up to {:.2g} %", isOurs ? "wrong: " : "",
                                   different, expected.size(), 100.0 * verdict.worstError);
  return verdict;
}

std::vector<double> valuesOf(vtkPolyData* cloud, const char* name)
{
  std::vector<double> values;
  vtkDataArray* array = cloud->GetPointData()->GetArray(name);
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
  }
  return values;
}

class Ours : public Rival
{
public:
  std::string name() const override { return "ours"; }
  bool isOurs() const override { return true; }
  void load(const BandwidthTask& task) override
  {
    input_->SetPoints(task.cloud->GetPoints());
    filter_->SetInputData(input_);
    filter_->SetNumberOfNeighbors(task.neighbors);
    filter_->SetRadiusScale(kRadiusScale);
    filter_->ComputeDensityOff();
  }
  void run(bool) override
  {
    input_->Modified();
    filter_->Update();
  }
  BandwidthAnswer answer() const override
  {
    return { valuesOf(filter_->GetOutput(), "Bandwidth"), valuesOf(filter_->GetOutput(), "ProxyRadius") };
  }

private:
  vtkNew<vtkPolyData> input_;
  vtkNew<vtkKernelBandwidthFilter> filter_;
};

void raceOn(Run& run, const NamedCloud& cloud, const BandwidthTask& task,
  const std::vector<ExpectedPoint>& expected, int threads)
{
  run.say(fmt::format("{} points of {}, {} threads", task.points.size(), cloud.name, threads));
  std::vector<std::unique_ptr<Rival>> rivals;
  std::vector<Contestant> contestants;
  std::vector<Verdict> verdicts(1 + 2 * run.rivals.size());
  const auto add = [&](std::unique_ptr<Rival> owned, bool parallel, const std::string& suffix)
  {
    Rival& rival = *rivals.emplace_back(std::move(owned));
    rival.load(task);
    Verdict& verdict = verdicts[contestants.size()];
    const auto check = [&rival, &expected, &verdict]
    {
      verdict = judge(rival.answer(), expected, rival.isOurs());
      return true; // a wrong one is timed too, and said to be wrong
    };
    contestants.push_back({ rival.name() + suffix, [&rival, parallel] { rival.run(parallel); }, {}, check });
  };
  add(std::make_unique<Ours>(), true, "");
  for (const std::string& word : run.rivals)
  {
    // As their examples do, and on as many threads as ours.
    add(makeRival<Rival>(rivalFiles(), word), false, ", loop on 1 thread");
    if (threads > 1)
    {
      add(makeRival<Rival>(rivalFiles(), word), true, fmt::format(", loop on {} threads", threads));
    }
  }
  RaceSettings settings;
  settings.rounds = run.repetitions;
  std::vector<Lap> laps;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(threads), [&] { laps = race(contestants, settings); });
  for (std::size_t i = 0; i < laps.size(); ++i)
  {
    Json row{ { "cloud", cloud.name }, { "points", task.points.size() }, { "neighbors", task.neighbors },
      { "threads", threads } };
    row.update(timesOf(laps, i));
    row.update({ { "ns_per_point", 1e9 * quartiles(laps[i].seconds).median / double(task.points.size()) },
      { "worst_relative_error", verdicts[i].worstError }, { "right", verdicts[i].right },
      { "answer", verdicts[i].text } });
    run.add("search", std::move(row));
  }
  if (!verdicts.front().right)
  {
    run.fault("an answer of vtkKernelBandwidthFilter is wrong; look at the errors of our own rows");
  }
}

TaskRun addOptions(CLI::App& command)
{
  auto options = std::make_shared<Options>();
  addInteger(command, "--points", options->points, 100, kMostPoints, "Points of the clouds; default 200000");
  addInteger(command, "--neighbors", options->neighbors, 1, kMostNeighbors,
    "Nearest neighbours the spread is taken from; default 16");
  command.add_option("--file", options->file, "A cloud of your own beside the generated ones")
    ->type_name("FILE");
  return [options](Run& run)
  {
    const std::int64_t points = run.chosen<std::int64_t>(options->points, 200000, 3000);
    std::vector<NamedCloud> clouds{ shapeCloud(Shape::Sphere, points),
      shapeCloud(Shape::DensityStep, points) };
    if (!options->file.empty())
    {
      clouds.push_back(fileCloud(options->file, points));
    }
    for (const NamedCloud& cloud : clouds)
    {
      const BandwidthTask task{ cloud.polyData, cloud.view(), int(options->neighbors) };
      const std::vector<ExpectedPoint> expected = expectedPoints(task, kCheckedPoints);
      for (const int threads : run.threads)
      {
        raceOn(run, cloud, task, expected, threads);
      }
    }
  };
}

} // namespace
} // namespace pointhaptics::bench::bandwidth

namespace pointhaptics::bench
{

Task bandwidthTask()
{
  return { "bandwidth",
    "Time bandwidths and radii against their error; PCL's and nanoflann's searches beside", 15, 3, true,
    { "search" }, wordsOf(bandwidth::rivalFiles()), bandwidth::addOptions };
}

} // namespace pointhaptics::bench
