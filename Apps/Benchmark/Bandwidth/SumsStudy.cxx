#include "Benchmark/Bandwidth/Studies.h"

#include "Core/Bandwidth/Bandwidth.h"
#include "Core/Bandwidth/EpanechnikovSum.h"
#include "Core/Bandwidth/GaussianPairSum.h"
#include "Core/Bandwidth/GaussianSum.h"
#include "Core/Base/PortableRandom.h"
#include "Core/Reference/ReferenceKernelSum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

constexpr double kErrors[] = { 1e-3, 1e-6, 1e-9, GaussianSum::kSmallestError };
/// What the headers promise.
constexpr double kGaussianMayDiffer = 1e-12;
constexpr double kSheatherJonesMayDiffer = 1e-9;
/// Targets and pairs that are summed directly, to be extrapolated.
constexpr std::int64_t kDirectTargets = 100;
constexpr std::int64_t kDirectPairs = 4096;
/// Values whose bandwidth is compared with the one of all pairs in long double.
constexpr std::int64_t kOracleValues = 800;

/// Two bumps of different width: what plug-in rules are for.
std::vector<double> sampleOf(std::int64_t count)
{
  detail::PortableRandom random(11);
  std::vector<double> values;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double x = random.gaussian();
    values.push_back(i % 5 < 3 ? x : 4.0 + 0.3 * x);
  }
  return values;
}

std::vector<double> directTargets(const std::vector<double>& sample)
{
  std::vector<double> targets;
  const auto step = std::max<std::size_t>(1, sample.size() / std::size_t(kDirectTargets));
  for (std::size_t i = 0; i < sample.size(); i += step)
  {
    targets.push_back(sample[i]);
  }
  return targets;
}

/// At those targets, every value summed in long double.
using ExactSums = std::vector<long double>;

ExactSums exactGaussians(const std::vector<double>& sample, double h)
{
  ExactSums sums;
  for (const double target : directTargets(sample))
  {
    sums.push_back(reference::gaussianSum(sample, h, target));
  }
  return sums;
}

ExactSums exactEpanechnikovs(const std::vector<double>& sample, double w)
{
  ExactSums sums;
  for (const double target : directTargets(sample))
  {
    std::int64_t inside = 0;
    sums.push_back(reference::epanechnikovSum(sample, w, target, inside));
  }
  return sums;
}

/// Largest relative error of @p sum at those targets.
template <typename Sum>
double worstError(const Sum& sum, const std::vector<double>& sample, const ExactSums& exact)
{
  const std::vector<double> targets = directTargets(sample);
  double worst = 0.0;
  for (std::size_t i = 0; i < targets.size(); ++i)
  {
    worst = std::max(worst, double(std::fabs(sum.sum(targets[i]) / exact[i] - 1)));
  }
  return worst;
}

struct Line
{
  std::string what;
  double asked = 0.0; ///< The error allowed, relative.
  std::function<void()> run;
  double directSeconds = 0.0;    ///< Extrapolated.
  std::function<double()> error; ///< Largest relative error; empty: not known.
  double mayDiffer = 0.0;        ///< 0: nothing is promised.
};

/// Sums at every value of the sample, and the largest error at some of them.
Line gaussianLine(const std::vector<double>& sample, double h, const ExactSums& exact,
  const std::string& name, double epsilon, double directSeconds)
{
  auto sum = std::make_shared<GaussianSum>();
  Line line;
  line.what = fmt::format("Gaussian, {}, epsilon {:.0e}", name, epsilon);
  line.asked = epsilon;
  line.run = [&sample, h, epsilon, sum]
  {
    (void)sum->build(sample.data(), std::int64_t(sample.size()), h, epsilon);
    double total = 0.0;
    for (const double target : sample)
    {
      total += sum->sum(target);
    }
    volatile double keep = total;
    (void)keep;
  };
  line.directSeconds = directSeconds;
  line.error = [&sample, &exact, sum] { return worstError(*sum, sample, exact); };
  line.mayDiffer = std::max(epsilon, kGaussianMayDiffer);
  return line;
}

Line epanechnikovLine(
  const std::vector<double>& sample, double w, const ExactSums& exact, double directSeconds)
{
  auto sum = std::make_shared<EpanechnikovSum>();
  Line line;
  line.what = "Epanechnikov, nothing left out";
  line.run = [&sample, w, sum]
  {
    (void)sum->build(sample.data(), std::int64_t(sample.size()), w);
    double total = 0.0;
    for (const double target : sample)
    {
      total += sum->sum(target);
    }
    volatile double keep = total;
    (void)keep;
  };
  line.directSeconds = directSeconds;
  line.error = [&sample, &exact, sum] { return worstError(*sum, sample, exact); };
  line.mayDiffer = kGaussianMayDiffer;
  return line;
}

double secondsOf(const std::function<void()>& work)
{
  RaceSettings settings;
  settings.rounds = 3;
  settings.warmUps = 0;
  const std::vector<Lap> laps = race({ { "", work, nullptr, nullptr } }, settings);
  return quartiles(laps.front().seconds).median;
}

/// Of the direct sum in double, a plain loop, from some targets on to one at every value.
double directGaussianSeconds(const std::vector<double>& sample, double h)
{
  const std::vector<double> targets = directTargets(sample);
  const double seconds = secondsOf(
    [&]
    {
      double total = 0.0;
      for (const double target : targets)
      {
        for (const double x : sample)
        {
          const double t = (target - x) / h;
          total += std::exp(-0.5 * t * t);
        }
      }
      volatile double keep = total;
      (void)keep;
    });
  return seconds * double(sample.size()) / double(targets.size());
}

double directEpanechnikovSeconds(const std::vector<double>& sample, double w)
{
  const std::vector<double> targets = directTargets(sample);
  const double seconds = secondsOf(
    [&]
    {
      double total = 0.0;
      for (const double target : targets)
      {
        for (const double x : sample)
        {
          const double t = (target - x) / w;
          total += std::max(0.0, 1.0 - t * t);
        }
      }
      volatile double keep = total;
      (void)keep;
    });
  return seconds * double(sample.size()) / double(targets.size());
}

/// One sum of the fourth derivative over all pairs, from a part of the sample on to all of it.
double directPairSeconds(const std::vector<double>& sample, double h)
{
  const std::size_t part = std::min<std::size_t>(sample.size(), std::size_t(kDirectPairs));
  const double seconds = secondsOf(
    [&]
    {
      double total = 0.0;
      for (std::size_t i = 0; i < part; ++i)
      {
        for (std::size_t j = 0; j < i; ++j)
        {
          const double q = (sample[i] - sample[j]) / h * ((sample[i] - sample[j]) / h);
          total += (q * q - 6.0 * q + 3.0) * std::exp(-0.5 * q);
        }
      }
      volatile double keep = total;
      (void)keep;
    });
  const double times = double(sample.size()) / double(part);
  return seconds * times * times;
}

Line pairLine(const std::vector<double>& sorted, double h, double directSeconds)
{
  auto sum = std::make_shared<GaussianPairSum>();
  Line line;
  line.what = "all pairs, fourth derivative";
  line.run = [&sorted, h, sum]
  {
    volatile double keep =
      sum->sum(sorted.data(), std::int64_t(sorted.size()), h, GaussianDerivative::Fourth);
    (void)keep;
  };
  line.directSeconds = directSeconds;
  return line;
}

/// @param directSeconds of one sum over all pairs; solving takes some 15 of them.
Line sheatherJonesLine(const std::vector<double>& sample, double directSeconds)
{
  auto scratch = std::make_shared<BandwidthScratch>();
  Line line;
  line.what = "Sheather-Jones bandwidth";
  line.run = [&sample, scratch]
  {
    double b = 0.0;
    (void)sampleBandwidth(
      BandwidthRule::SheatherJones, sample.data(), std::int64_t(sample.size()), *scratch, b);
    volatile double keep = b;
    (void)keep;
  };
  line.directSeconds = 15.0 * directSeconds;
  line.error = [scratch]
  {
    const std::vector<double> small = sampleOf(kOracleValues);
    double b = 0.0;
    (void)sampleBandwidth(
      BandwidthRule::SheatherJones, small.data(), std::int64_t(small.size()), *scratch, b);
    return double(std::fabs(b / reference::SheatherJonesOracle(small).solveTheEquation() - 1));
  };
  line.mayDiffer = kSheatherJonesMayDiffer;
  return line;
}

void addRow(
  const Line& line, const Lap& lap, StudyContext& context, ReportPart& part, std::vector<Series>& lines)
{
  const double seconds = quartiles(lap.seconds).median;
  const double error = line.error ? line.error() : 0.0;
  const bool right = line.mayDiffer == 0.0 || error <= line.mayDiffer;
  context.allRight = context.allRight && right;
  part.table.rows.push_back({ line.what, milliseconds(seconds), brief(line.directSeconds),
    grouped((long long)(line.directSeconds / seconds)), line.error ? fmt::format("{:.1e}", error) : "",
    line.mayDiffer > 0.0 ? (right ? "right" : "wrong") : "" });
  part.rows.push_back(
    { { "sum", line.what }, { "values", context.options.values }, { "median_seconds", seconds },
      { "direct_seconds_extrapolated", line.directSeconds }, { "times_faster", line.directSeconds / seconds },
      { "worst_relative_error", error }, { "may_differ", line.mayDiffer }, { "right", right } });
  if (line.asked > 0.0)
  {
    const std::size_t comma = line.what.find(", epsilon");
    addPoint(lines, line.what.substr(0, comma), 1e3 * seconds, std::max(error, 1e-17));
  }
}

} // namespace

ReportPart studySums(StudyContext& context)
{
  const std::int64_t count = context.options.values;
  context.progress(fmt::format("kernel sums over {} values", count));
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Fast kernel sums";
  std::vector<double> sample = sampleOf(count);
  std::vector<double> sorted = sample;
  const SampleSpread spread = sampleSpread(sorted);
  double wide = 0.0;
  (void)univariateBandwidth(BandwidthRule::SilvermanRobust, spread, wide);
  // So narrow that a kernel covers few values, and every target walks over cells.
  const double narrow = 20.0 * spread.standardDeviation / double(count);
  part.text = fmt::format(

    "{} values of two normal bumps, one thread, a sum at every value.\n"
    "\n"
    "- direct: the plain sum in double, extrapolated from {} targets, or from the pairs of {} values.\n"
    "  A Sheather-Jones bandwidth counts as 15 sums over all pairs.\n"
    "- wide: Silverman's bandwidth, {:.3g}; narrow: {:.2g}.\n"
    "- errors: at {} values against long double; of Sheather-Jones for {} values, whose pairs can all\n"
    "  be summed.",
    grouped(count), kDirectTargets, grouped(kDirectPairs), wide, narrow, kDirectTargets, kOracleValues);
  part.table.header = { "sum", "ms", "direct s", "times faster", "largest relative error", "answer" };
  const double directWide = directGaussianSeconds(sample, wide);
  const double directNarrow = directGaussianSeconds(sample, narrow);
  const double directPairs = directPairSeconds(sorted, wide);
  const ExactSums exactWide = exactGaussians(sample, wide);
  const ExactSums exactNarrow = exactGaussians(sample, narrow);
  const ExactSums exactEpanechnikov = exactEpanechnikovs(sample, wide);
  std::vector<Line> work;
  for (const double epsilon : kErrors)
  {
    work.push_back(gaussianLine(sample, wide, exactWide, "wide", epsilon, directWide));
  }
  for (const double epsilon : kErrors)
  {
    work.push_back(gaussianLine(sample, narrow, exactNarrow, "narrow", epsilon, directNarrow));
  }
  work.push_back(epanechnikovLine(sample, wide, exactEpanechnikov, directEpanechnikovSeconds(sample, wide)));
  work.push_back(pairLine(sorted, wide, directPairs));
  work.push_back(sheatherJonesLine(sample, directPairs));
  std::vector<Contestant> contestants;
  for (const Line& line : work)
  {
    Contestant contestant;
    contestant.run = line.run;
    contestants.push_back(std::move(contestant));
  }
  const std::vector<Lap> laps = timed(contestants, 1, context, 0.3);
  std::vector<Series> lines;
  for (std::size_t i = 0; i < work.size(); ++i)
  {
    addRow(work[i], laps[i], context, part, lines);
  }
  part.charts.push_back({ "bandwidth-sums", fmt::format("Gaussian sums at {} values", grouped(count)),
    { "time (ms)", true }, { "largest relative error", true }, lines });
  return part;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
