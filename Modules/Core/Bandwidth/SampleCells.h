/// @file
/// A sorted univariate sample cut into cells no wider than a part of the bandwidth, and the power sums of a
/// cell: the basis of the fast kernel sums. Internal to Core.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace detail
{

/// Values [begin, end) of the sorted sample. The centre is first + halfWidth bandwidths and need not be a
/// number that double can hold: offsets are taken from first, so they are exact however large the values are.
struct SampleCell
{
  double first = 0.0;
  double last = 0.0;
  double halfWidth = 0.0; ///< In bandwidths.
  std::int64_t begin = 0;
  std::int64_t end = 0;
  std::int64_t series = -1; ///< Which row of power sums is its own; -1: none, few points.
  std::int64_t count() const { return end - begin; }
  /// Offset of @p value from the centre, in bandwidths.
  double offset(double value, double bandwidth) const { return (value - first) / bandwidth - halfWidth; }
};

/// Cells with fewer points than this have no power sums: their points are taken one by one.
constexpr std::int64_t kSeriesCount = 8;

/// From the left: a cell begins with the first value that the cell before, of @p width bandwidths, does not
/// hold. Beginnings are more than @p width apart; there are at most @p count cells. @return the number of
/// cells that have a series.
inline std::int64_t splitIntoCells(
  const double* sorted, std::int64_t count, double bandwidth, double width, std::vector<SampleCell>& cells)
{
  cells.clear();
  std::int64_t series = 0;
  for (std::int64_t begin = 0; begin < count;)
  {
    SampleCell cell;
    cell.first = sorted[begin];
    cell.begin = begin;
    while (begin < count && sorted[begin] - cell.first <= width * bandwidth)
    {
      ++begin;
    }
    cell.end = begin;
    cell.last = sorted[begin - 1];
    cell.halfWidth = 0.5 * ((cell.last - cell.first) / bandwidth);
    cell.series = cell.count() >= kSeriesCount ? series++ : -1;
    cells.push_back(cell);
  }
  return series;
}

template <int Terms>
constexpr std::array<double, Terms> inverseFactorials()
{
  std::array<double, Terms> result{};
  long double factorial = 1.0L;
  for (int k = 0; k < Terms; ++k)
  {
    factorial *= k > 0 ? k : 1;
    result[std::size_t(k)] = double(1.0L / factorial);
  }
  return result;
}

/// Adds sum_i u_i^k over values [begin, end) of @p cell to power sums k = 0 ... Terms - 1.
template <int Terms>
void addPowers(const double* sorted, std::int64_t begin, std::int64_t end, const SampleCell& cell,
  double bandwidth, double* powers)
{
  constexpr int kLanes = 8;
  double sums[Terms][kLanes] = {};
  for (std::int64_t i = begin; i < end; i += kLanes)
  {
    double u[kLanes] = {};
    double term[kLanes] = {};
    const int filled = int(std::min<std::int64_t>(kLanes, end - i));
    for (int lane = 0; lane < filled; ++lane)
    {
      u[lane] = cell.offset(sorted[i + lane], bandwidth);
      term[lane] = 1.0;
    }
    for (int k = 0; k < Terms; ++k)
    {
      for (int lane = 0; lane < kLanes; ++lane)
      {
        sums[k][lane] += term[lane];
        term[lane] *= u[lane];
      }
    }
  }
  for (int k = 0; k < Terms; ++k)
  {
    for (int lane = 0; lane < kLanes; ++lane)
    {
      powers[k] += sums[k][lane];
    }
  }
}

/// @p moments[k] = sum_i u_i^k / k! over the points of @p cell. Summed in eight lanes and pieces
/// of 1024: rounding grows with 128 + count / 1024 at worst.
template <int Terms>
void cellMoments(const double* sorted, const SampleCell& cell, double bandwidth, double* moments)
{
  constexpr std::int64_t kPiece = 1024;
  constexpr std::array<double, Terms> inverse = inverseFactorials<Terms>();
  std::fill(moments, moments + Terms, 0.0);
  for (std::int64_t begin = cell.begin; begin < cell.end; begin += kPiece)
  {
    addPowers<Terms>(sorted, begin, std::min(begin + kPiece, cell.end), cell, bandwidth, moments);
  }
  for (int k = 0; k < Terms; ++k)
  {
    moments[k] *= inverse[std::size_t(k)];
  }
}

/// table[k] = He_(order + k)(t) exp(-t^2 / 2) for k = 0 ... terms - 1: the derivatives of exp(-t^2 / 2), of
/// alternating sign. He is the Hermite polynomial with leading coefficient 1.
inline void hermiteTable(double t, int order, int terms, double* table)
{
  double before = 0.0;
  double now = std::exp(-0.5 * t * t);
  for (int k = 0; k < order + terms; ++k)
  {
    if (k >= order)
    {
      table[k - order] = now;
    }
    const double next = t * now - double(k) * before;
    before = now;
    now = next;
  }
}

/// A compensated sum: it keeps its rounding error (Neumaier 1974).
class CompensatedSum
{
public:
  void add(double value) noexcept
  {
    const double next = sum_ + value;
    error_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - next) + value : (value - next) + sum_;
    sum_ = next;
  }
  double value() const noexcept { return sum_ + error_; }

private:
  double sum_ = 0.0;
  double error_ = 0.0;
};

} // namespace detail
} // namespace pointhaptics
