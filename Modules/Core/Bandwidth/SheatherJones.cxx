#include "Core/Bandwidth/SheatherJones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr double kSqrtPi = 1.77245385090551602730;
constexpr double kSqrtTwoPi = 2.50662827463100050242;
/// Where the search begins, a little above the best bandwidth for any density of this scale (Terrell 1990).
constexpr double kStart = 1.144;
/// Steps of the search, as a ratio, and how many: 1.2^190 > 1e15.
constexpr double kStepRatio = 1.2;
constexpr int kLargestNumberOfSteps = 190;
constexpr int kLargestNumberOfRefinements = 100;
/// Steps of the logarithm of b as short as this end the refinement, which by then converges superlinearly.
constexpr double kTolerance = 1e-12;

bool isUsable(double value)
{
  return value > 0.0 && std::isfinite(value);
}

/// Values of a sorted sample from begin to before end, within half a bandwidth of each other.
struct SampleCell
{
  static constexpr int kTerms = 28;
  /// Fewer values are summed one by one.
  static constexpr std::int64_t kSeriesCount = 8;

  std::int64_t begin;
  std::int64_t end;
  /// Element k: sum of u^k / k!, u the distance of a value from the first one, over the bandwidth.
  std::array<double, kTerms> moments{};

  bool hasSeries() const { return end - begin >= kSeriesCount; }
};

/// Sums H_r((x_i - x_j) / h) over all pairs of a sorted sample, i = j among them, in linear time, after an
/// idea of Raykar and Duraiswami 2006. The sample is cut into cells at most h/2 wide. With D the distance of
/// the first values of two cells and u, v the offsets from these, all over h, H_r(D + u - v) = sum_ab
/// H_(r+a+b)(D) (-u)^a v^b / (a! b!), so that two cells need only the power sums of their values.
///
/// By Cramer's bound |H_k(t)| <= 1.0865 sqrt(k!) the series, cut at a + b < 28, is within
/// 1.0865 sqrt((28 + r)!) / 28! 2^-28 < 3e-19 of H_r for each pair, and pairs more than 11 h apart, left out,
/// have |H_r| < 1e-20: less than rounding.
class PairSum
{
public:
  /// @param h above 0 and finite. @param order r, 4 or 6.
  double sum(const double* sorted, std::int64_t count, double h, int order)
  {
    constexpr double kReach = 11.0;
    sorted_ = sorted;
    h_ = h;
    order_ = order;
    this->split(count);
    double total = 0.0;
    for (auto a = cells_.begin(); a != cells_.end(); ++a)
    {
      total += this->cellPair(*a, *a);
      for (auto b = a + 1; b != cells_.end() && (sorted[b->begin] - sorted[a->end - 1]) / h <= kReach; ++b)
      {
        total += 2.0 * this->cellPair(*a, *b);
      }
    }
    return total;
  }

private:
  void split(std::int64_t count)
  {
    constexpr double kCellWidth = 0.5;
    cells_.clear();
    for (std::int64_t begin = 0; begin < count; begin = cells_.back().end)
    {
      SampleCell cell{ begin, begin + 1 };
      while (cell.end < count && sorted_[cell.end] - sorted_[begin] <= kCellWidth * h_)
      {
        ++cell.end;
      }
      cells_.push_back(cell);
      cell.hasSeries() ? this->sumPowers(cells_.back()) : void();
    }
  }

  void sumPowers(SampleCell& cell) const
  {
    for (std::int64_t i = cell.begin; i < cell.end; ++i)
    {
      const double u = (sorted_[i] - sorted_[cell.begin]) / h_;
      double power = 1.0;
      for (double& moment : cell.moments)
      {
        moment += power;
        power *= u;
      }
    }
    double factorial = 1.0;
    for (int k = 1; k < SampleCell::kTerms; ++k)
    {
      factorial *= k;
      cell.moments[std::size_t(k)] /= factorial;
    }
  }

  double cellPair(const SampleCell& a, const SampleCell& b) const
  {
    return a.hasSeries() && b.hasSeries() ? this->bothSeries(a, b) : this->everyPair(a, b);
  }

  /// Element k: H_(order + k)(t), by He_(k + 1) = t He_k - k He_(k - 1).
  std::array<double, SampleCell::kTerms> derivativesAt(double t) const
  {
    std::array<double, SampleCell::kTerms> table{};
    double before = 0.0;
    double now = std::exp(-0.5 * t * t);
    for (int k = 0; k < order_ + SampleCell::kTerms; ++k)
    {
      table[std::size_t(std::max(k - order_, 0))] = now;
      before = std::exchange(now, t * now - double(k) * before);
    }
    return table;
  }

  double bothSeries(const SampleCell& a, const SampleCell& b) const
  {
    constexpr std::size_t kTerms = SampleCell::kTerms;
    const auto table = this->derivativesAt((sorted_[a.begin] - sorted_[b.begin]) / h_);
    double sum = 0.0;
    for (std::size_t j = 0; j < kTerms; ++j)
    {
      double inner = 0.0;
      for (std::size_t i = 0; i < kTerms - j; ++i)
      {
        inner += (i % 2 == 0 ? a.moments[i] : -a.moments[i]) * table[i + j];
      }
      sum += b.moments[j] * inner;
    }
    return sum;
  }

  double everyPair(const SampleCell& a, const SampleCell& b) const
  {
    double sum = 0.0;
    for (std::int64_t i = a.begin; i < a.end; ++i)
    {
      for (std::int64_t j = b.begin; j < b.end; ++j)
      {
        const double t = (sorted_[i] - sorted_[j]) / h_;
        const double q = t * t;
        sum += (order_ == 4 ? (q - 6.0) * q + 3.0 : ((q - 15.0) * q + 45.0) * q - 15.0) * std::exp(-0.5 * q);
      }
    }
    return sum;
  }

  const double* sorted_ = nullptr; ///< Valid during sum() only, as are the next two.
  double h_ = 1.0;
  int order_ = 0;
  std::vector<SampleCell> cells_;
};

/// A sample and the constants of its equation. Bandwidths are in units of the scale, which keeps their powers
/// in range.
class Equation
{
public:
  Equation(const double* sorted, std::int64_t count, double scale)
    : sorted_(sorted)
    , count_(count)
    , n_(double(count))
    , scale_(scale)
    , thirdDerivative_(roughness(1.23 * std::pow(n_, -1.0 / 9.0), false))
    , pilotFactor_(
        1.357 * std::pow(roughness(1.24 * std::pow(n_, -1.0 / 7.0), true) / thirdDerivative_, 1.0 / 7.0))
  {
  }
  bool isSolvable() const { return isUsable(thirdDerivative_) && isUsable(pilotFactor_); }

  /// Logarithms of two bandwidths with a solution between them, and excess() there.
  struct Bracket
  {
    double low;
    double high;
    double atLow;
    double atHigh;
  };
  std::optional<Bracket> bracket()
  {
    const double step = std::log(kStepRatio);
    const double start = std::log(kStart * std::pow(n_, -0.2));
    const double atStart = this->excess(start);
    Bracket b{ start, start, atStart, atStart };
    for (int i = 0; i < kLargestNumberOfSteps && std::isfinite(b.atLow) && std::isfinite(b.atHigh); ++i)
    {
      if (b.atLow >= 0.0 && b.atHigh <= 0.0)
      {
        return b;
      }
      const double next = atStart < 0.0 ? b.low - step : b.high + step;
      const double atNext = this->excess(next);
      b = atStart < 0.0 ? Bracket{ next, b.low, atNext, b.atLow } : Bracket{ b.high, next, b.atHigh, atNext };
    }
    return {};
  }

  /// Regula falsi where the end that stays has its value halved (Illinois): never leaves the bracket.
  double root(Bracket b)
  {
    double last = b.low;
    int side = 0;
    for (int i = 0; i < kLargestNumberOfRefinements && b.atLow != b.atHigh; ++i)
    {
      const double next = b.high - b.atHigh * (b.high - b.low) / (b.atHigh - b.atLow);
      const bool arrived = std::fabs(next - last) <= kTolerance;
      last = next;
      if (arrived)
      {
        break;
      }
      const double value = this->excess(next);
      const int towards = value > 0.0 ? 1 : -1;
      double& stays = value > 0.0 ? b.atHigh : b.atLow;
      stays *= side == towards ? 0.5 : 1.0;
      (value > 0.0 ? b.low : b.high) = next;
      (value > 0.0 ? b.atLow : b.atHigh) = value;
      side = towards;
    }
    return last;
  }

private:
  /// Integral of the squared second or third derivative of the density with unit scale.
  double roughness(double g, bool second)
  {
    const double h = g * scale_;
    const double sum = isUsable(h) ? sums_.sum(sorted_, count_, h, second ? 4 : 6) : 0.0;
    return (second ? sum : -sum) / (n_ * (n_ - 1.0) * kSqrtTwoPi * std::pow(g, second ? 5.0 : 7.0));
  }
  /// log of right-hand side over left-hand side of the equation at bandwidth exp(logarithm); falls to 0 at a
  /// solution.
  double excess(double logarithm)
  {
    const double g = pilotFactor_ * std::exp(5.0 / 7.0 * logarithm);
    return std::log(std::pow(2.0 * kSqrtPi * n_ * this->roughness(g, true), -0.2)) - logarithm;
  }

  const double* sorted_;
  std::int64_t count_;
  double n_;
  double scale_;
  PairSum sums_;           ///< Before what is made with it.
  double thirdDerivative_; ///< T(b).
  double pilotFactor_;     ///< 1.357 (S(a) / T(b))^(1/7).
};

}

Status sheatherJones(const double* sorted, std::int64_t count, double scale, double& bandwidth)
{
  if (count < 2 || !isUsable(scale))
  {
    return Status::DegenerateSample;
  }
  Equation equation(sorted, count, scale);
  const auto bracket = equation.isSolvable() ? equation.bracket() : std::nullopt;
  if (!bracket)
  {
    return Status::EquationUnsolved;
  }
  const double result = std::exp(equation.root(*bracket)) * scale;
  if (!isUsable(result))
  {
    return Status::EquationUnsolved;
  }
  bandwidth = result;
  return Status::Ok;
}

} // namespace pointhaptics
