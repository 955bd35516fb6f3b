#include "Benchmark/Resample/Accumulators.h"
#include "Benchmark/Resample/Clouds.h"
#include "Benchmark/Resample/Expected.h"
#include "Benchmark/Resample/Studies.h"

#include "Core/Base/PortableRandom.h"

#include <fmt/format.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace resample
{
namespace
{

/// Smaller errors, nothing among them, are drawn here: the axis is logarithmic.
constexpr double kSmallestDrawn = 1e-13;
constexpr double kUtmSpacing = 0.1;

struct AccumulatorCloud
{
  std::string key;
  std::string name;
  std::vector<Vec3> points;
  Lattice lattice;
};

/// The sphere, some tens of points a voxel.
AccumulatorCloud plainCloud(std::int64_t count)
{
  AccumulatorCloud cloud{ "plain", "sphere in a 10 cm cube, 75^3 voxels", {}, {} };
  const auto sphere = sphereCloud(count, PointOrder::Random);
  const PointView view = viewOf(sphere);
  for (std::int64_t i = 0; i < count; ++i)
  {
    cloud.points.push_back(view[i]);
  }
  const double half = 0.5 * kWorkspaceEdge;
  cloud.lattice.origin = { -half, -half, -half };
  const double spacing = kWorkspaceEdge / 75.0;
  cloud.lattice.spacing = { spacing, spacing, spacing };
  cloud.lattice.dimensions = { 75, 75, 75 };
  return cloud;
}

/// Uniform in a box of @p across x @p across x 1 voxels of 0.1 m, at a place on the ground as surveyors give
/// it: 500 km east, 4,600 km north.
AccumulatorCloud utmCloud(const std::string& key, const std::string& name, std::int64_t count, int across)
{
  AccumulatorCloud cloud{ key, name, {}, {} };
  cloud.lattice.origin = { 500000.0, 4600000.0, 100.0 };
  cloud.lattice.spacing = { kUtmSpacing, kUtmSpacing, kUtmSpacing };
  cloud.lattice.dimensions = { across, across, 1 };
  detail::PortableRandom random(1);
  const double edge = across * kUtmSpacing;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double x = random.uniform(0.0, edge), y = random.uniform(0.0, edge);
    cloud.points.push_back(cloud.lattice.origin + Vec3(x, y, random.uniform(0.0, kUtmSpacing)));
  }
  return cloud;
}

template <typename Accumulator>
struct Cell
{
  std::int64_t count = 0;
  Accumulator axis[3];
};

/// One pass over the points as plain as can be: voxel index, then the sums, in a dense array.
template <typename Accumulator>
class Pass
{
public:
  explicit Pass(const AccumulatorCloud& cloud)
    : cloud_(cloud)
  {
  }
  void clear()
  {
    const auto& n = cloud_.lattice.dimensions;
    cells_.assign(std::size_t(n[0] * n[1] * n[2]), {});
  }
  void run()
  {
    const Lattice& lattice = cloud_.lattice;
    const Vec3 scale{ 1.0 / lattice.spacing.x, 1.0 / lattice.spacing.y, 1.0 / lattice.spacing.z };
    for (const Vec3& p : cloud_.points)
    {
      const Vec3 u{ (p.x - lattice.origin.x) * scale.x, (p.y - lattice.origin.y) * scale.y,
        (p.z - lattice.origin.z) * scale.z };
      if (!lattice.contains(u))
      {
        continue;
      }
      // Inside the lattice a cast is a floor.
      const std::int64_t i = std::int64_t(u.x), j = std::int64_t(u.y), k = std::int64_t(u.z);
      Cell<Accumulator>& cell = cells_[lattice.key(i, j, k)];
      ++cell.count;
      cell.axis[0].add({ p.x, u.x - double(i) }, cell.count);
      cell.axis[1].add({ p.y, u.y - double(j) }, cell.count);
      cell.axis[2].add({ p.z, u.z - double(k) }, cell.count);
    }
  }
  /// Errors in voxels against @p expected, largest and root of the mean square; voxels whose counts differ
  /// (a point on a face) are left out.
  void errors(const ExpectedMeans& expected, double& largest, double& rms, std::int64_t& left) const
  {
    double squares = 0.0;
    std::int64_t values = 0;
    for (std::size_t v = 0; v < expected.keys.size(); ++v)
    {
      const Cell<Accumulator>& cell = cells_[expected.keys[v]];
      if (cell.count != expected.counts[v])
      {
        ++left;
        continue;
      }
      const auto index = cloud_.lattice.indexOf(expected.keys[v]);
      for (int a = 0; a < 3; ++a)
      {
        const auto axis = std::size_t(a);
        const double spacing = cloud_.lattice.spacing[a];
        const VoxelAxis place{ cloud_.lattice.origin[a], spacing, double(index[axis]) };
        const long double mean = cell.axis[axis].mean(cell.count, place);
        const double error = double(std::fabs(mean - expected.means[v][axis])) / spacing;
        largest = std::max(largest, error);
        squares += error * error;
        ++values;
      }
    }
    rms = std::sqrt(squares / double(std::max<std::int64_t>(1, values)));
  }

private:
  const AccumulatorCloud& cloud_;
  std::vector<Cell<Accumulator>> cells_;
};

/// A pass with its type forgotten.
struct Entrant
{
  Contestant contestant;
  double largest = 0.0;
  double rms = 0.0;
  std::int64_t left = 0;
};

template <typename Accumulator>
std::unique_ptr<Entrant> entrantOf(const AccumulatorCloud& cloud, const ExpectedMeans& expected)
{
  auto entrant = std::make_unique<Entrant>();
  auto pass = std::make_shared<Pass<Accumulator>>(cloud);
  Entrant* target = entrant.get();
  entrant->contestant = { Accumulator::kName, [pass] { pass->run(); }, [pass] { pass->clear(); },
    [pass, target, &expected]
    {
      pass->errors(expected, target->largest, target->rms, target->left);
      return true;
    } };
  return entrant;
}

template <typename... Accumulators>
std::vector<std::unique_ptr<Entrant>> entrantsOf(const AccumulatorCloud& cloud, const ExpectedMeans& expected)
{
  std::vector<std::unique_ptr<Entrant>> entrants;
  (entrants.push_back(entrantOf<Accumulators>(cloud, expected)), ...);
  return entrants;
}

void addRow(const AccumulatorCloud& cloud, const Entrant& entrant, const Lap& lap, const Lap& fixedPoint,
  ReportPart& part)
{
  const double count = double(cloud.points.size());
  const Quartiles seconds = quartiles(lap.seconds);
  const Quartiles ratio = pairedRatios(lap.seconds, fixedPoint.seconds);
  const double metres = entrant.largest * cloud.lattice.spacing.x;
  part.table.rows.push_back({ cloud.name, lap.name, brief(1e9 * seconds.median / count),
    brief(1e9 * seconds.lower / count) + " - " + brief(1e9 * seconds.upper / count), brief(ratio.median),
    brief(entrant.largest), brief(entrant.rms), brief(metres) });
  part.rows.push_back({ { "cloud", cloud.key }, { "points", cloud.points.size() },
    { "accumulator", lap.name }, { "repetitions", seconds.count }, { "median_seconds", seconds.median },
    { "ns_per_point", 1e9 * seconds.median / count }, { "times_fixed_point", ratio.median },
    { "largest_error_voxels", entrant.largest }, { "rms_error_voxels", entrant.rms },
    { "largest_error_metres", metres }, { "voxels_left_out", entrant.left } });
}

void studyCloud(const AccumulatorCloud& cloud, StudyContext& context, ReportPart& part)
{
  context.progress("accumulators: " + cloud.name);
  const PointView view(cloud.points.data(), std::int64_t(cloud.points.size()));
  const ExpectedMeans expected = expectedMeans(view, cloud.lattice);
  const auto entrants = entrantsOf<FixedPoint, FloatSum, DoubleSum, FloatRunningMean, DoubleRunningMean,
    FloatCompensated, FloatOffsetSum, DoubleOffsetSum>(cloud, expected);
  std::vector<Contestant> contestants;
  for (const auto& entrant : entrants)
  {
    contestants.push_back(entrant->contestant);
  }
  RaceSettings settings;
  settings.rounds = context.options.repetitions;
  settings.warmUps = context.options.warmUps;
  const std::vector<Lap> laps = race(contestants, settings);
  Chart chart{ "resample-accumulators-" + cloud.key, "Accumulators: " + cloud.name,
    { "time of a point (ns), one thread, index included", false },
    { fmt::format("largest error of a mean (voxels), {} at least", kSmallestDrawn), true }, {} };
  for (std::size_t i = 0; i < laps.size(); ++i)
  {
    addRow(cloud, *entrants[i], laps[i], laps.front(), part);
    addPoint(chart.series, laps[i].name,
      1e9 * quartiles(laps[i].seconds).median / double(cloud.points.size()),
      std::max(kSmallestDrawn, entrants[i]->largest));
  }
  part.charts.push_back(chart);
}

} // namespace

ReportPart studyAccumulators(StudyContext& context)
{
  const std::int64_t count = context.options.accumulatorPoints;
  ReportPart part;
  part.title = "Accumulators: time against error";
  part.text = fmt::format(
    "{} points, one thread, one plain pass: voxel index, then the sums, in a dense array. The error is that "
    "of the mean against long double, before the mean is rounded to an output type. Sums of offsets are "
    "taken "
    "from the voxel's centre, the others of the coordinates themselves.",
    grouped(count));
  part.table.header = { "cloud", "accumulator", "ns/point", "quartiles", "x fixed point",
    "largest error (voxels)", "RMS error (voxels)", "largest error (m)" };
  studyCloud(plainCloud(count), context, part);
  studyCloud(utmCloud("utm", "UTM, 0.1 m voxels", count, 100), context, part);
  studyCloud(utmCloud("utm-one-voxel", "UTM, all in one 0.1 m voxel", count, 1), context, part);
  return part;
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
