#include "Core/Distributed/FarPoints.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"
#include "Core/Distributed/SharedVoxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <locale>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr std::int64_t kFewest = 100;  ///< None of fewer points is called far.
constexpr std::int64_t kMostPart = 20; ///< One in so many is far at most.
constexpr double kMostLength = 0.1;    ///< The core's longest side over that of all.
constexpr std::int64_t kLookedAt = 1000;
/// Part of the sample that is cut off at each end of an axis: more than ever is far.
constexpr std::size_t kCut = 10;
constexpr int kCells = 32;
/// Points of a cell over those of one beside it below which the cell is no connection.
constexpr double kConnects = 0.01;

/// Whether programs write this for no data; LAS has a multiple of a step near it.
bool isUsualNoData(double value)
{
  const double whole = std::round(value);
  return std::abs(value - whole) <= 1e-9 * std::abs(whole) &&
    (whole == -9999.0 || whole == -99999.0 || whole == -32768.0);
}

/// Where on @p axis those of @p sample lie that @p counts, without a tenth at either end, which may be
/// strays.
/// @pre It counts one at least.
template <typename Counts>
std::pair<double, double> middleOf(const std::vector<Vec3>& sample, int axis, const Counts& counts)
{
  std::vector<double> places;
  for (const Vec3& p : sample)
  {
    counts(p) ? places.push_back(p[axis]) : void();
  }
  std::sort(places.begin(), places.end());
  const std::size_t cut = places.size() / kCut;
  return { places[cut], places[places.size() - 1 - cut] };
}

/// The values on @p axis that stand for no data: one in 200 points of @p sample and more, but no more than
/// the others are, has exactly such a value, and it is ten times as far from all others as these are long. A
/// usual value may be that of most points, and be far on its axis alone, also from one value.
std::vector<double> noDataOn(const std::vector<Vec3>& sample, int axis)
{
  constexpr std::size_t kOneIn = 200;
  constexpr double kFar = 10.0;
  std::map<double, std::size_t> counts;
  for (const Vec3& p : sample)
  {
    ++counts[p[axis]];
  }
  std::vector<double> found;
  for (const auto& [value, count] : counts)
  {
    const bool isUsual = isUsualNoData(value);
    const std::size_t others = sample.size() - count;
    if (count < 2 + sample.size() / kOneIn || others == 0 || (count > others && !isUsual))
    {
      continue;
    }
    const auto isOther = [axis, none = value](const Vec3& p) { return p[axis] != none; };
    const auto [low, high] = middleOf(sample, axis, isOther);
    double longest = high - low;
    for (int of = 0; of < 3 && !isUsual; ++of)
    {
      const auto [from, to] = middleOf(sample, of, isOther);
      longest = std::max(longest, to - from);
    }
    const bool isBeside = (value < low || value > high) && (high > low || isUsual);
    const double away = std::max(std::abs(value - low), std::abs(value - high));
    if (isBeside && away >= kFar * longest)
    {
      found.push_back(value);
    }
  }
  return found;
}

double longestSide(const Bounds& bounds)
{
  const Vec3 size = bounds.extent();
  return std::max({ size.x, size.y, size.z });
}

std::int64_t& at(std::vector<std::int64_t>& cells, const std::array<int, 3>& cell)
{
  return cells[static_cast<std::size_t>((cell[2] * kCells + cell[1]) * kCells + cell[0])];
}

struct CellBox
{
  std::array<int, 3> low{ kCells, kCells, kCells };
  std::array<int, 3> high{ -1, -1, -1 };

  void include(const std::array<int, 3>& cell)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], cell[axis]);
      high[axis] = std::max(high[axis], cell[axis]);
    }
  }
  /// One cell more on each side, where there is one.
  CellBox grown() const
  {
    CellBox result = *this;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      result.low[axis] = std::max(low[axis] - 1, 0);
      result.high[axis] = std::min(high[axis] + 1, kCells - 1);
    }
    return result;
  }
  int longest() const { return 1 + std::max({ high[0] - low[0], high[1] - low[1], high[2] - low[2] }); }
  template <typename Visitor>
  void forEach(Visitor&& visit) const
  {
    std::array<int, 3> cell;
    for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2])
    {
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
      {
        for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
        {
          visit(cell);
        }
      }
    }
  }
};

CellBox around(const std::array<int, 3>& cell)
{
  CellBox box;
  box.include(cell);
  return box.grown();
}

class CoreSearch
{
public:
  CoreSearch(const std::vector<PointView>& parts, const AffineTransform& transform, Ranks& ranks)
    : parts_(parts)
    , transform_(transform)
    , ranks_(ranks)
  {
  }

  template <typename Visitor>
  void forEach(std::int64_t first, std::int64_t step, Visitor&& visit) const
  {
    for (const PointView& part : parts_)
    {
      for (; first < part.size(); first += step)
      {
        const Vec3 p = part[first];
        if (isFinite(p))
        {
          visit(p, transform_.apply(p));
        }
      }
      first -= part.size();
    }
  }
  /// Whether a file has this in the place of coordinates that were not measured.
  bool isNoData(const Vec3& p) const
  {
    bool result = isAtZero(p);
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::vector<double>& values = noData_[axis];
      result = result || std::find(values.begin(), values.end(), p[axis]) != values.end();
    }
    return result;
  }
  std::int64_t size() const
  {
    return std::accumulate(parts_.begin(), parts_.end(), std::int64_t{ 0 },
      [](std::int64_t sum, const PointView& part) { return sum + part.size(); });
  }

  /// Finds what stands for no data, too. @return whether most of the points may lie within a small part of
  /// @p longest.
  bool mayBeSmall(double longest);
  Bounds core(const Bounds& all) const;

private:
  std::vector<std::int64_t> count(const Bounds& box, double edge) const;
  static CellBox cellsOfCore(std::vector<std::int64_t>& cells);

  const std::vector<PointView>& parts_;
  const AffineTransform& transform_;
  Ranks& ranks_;
  std::vector<double> noData_[3]; ///< On each axis.
};

bool CoreSearch::mayBeSmall(double longest)
{
  const std::int64_t count = this->size();
  const std::int64_t before = ranks_.sumBefore(count);
  const std::int64_t step = std::max<std::int64_t>(1, ranks_.sum(count) / kLookedAt);
  std::vector<Vec3> own;
  this->forEach((step - before % step) % step, step,
    [&own](const Vec3& p, const Vec3&) { isAtZero(p) ? void() : own.push_back(p); });
  std::vector<Vec3> sample = ranks_.gatherAll(own);
  for (int axis = 0; axis < 3; ++axis)
  {
    noData_[axis] = noDataOn(sample, axis);
  }
  const auto isFill = [this](const Vec3& p) { return this->isNoData(p); };
  sample.erase(std::remove_if(sample.begin(), sample.end(), isFill), sample.end());
  std::transform(
    sample.begin(), sample.end(), sample.begin(), [this](const Vec3& p) { return transform_.apply(p); });
  bool isSmall = !sample.empty();
  for (int axis = 0; axis < 3 && isSmall; ++axis)
  {
    const auto [low, high] = middleOf(sample, axis, [](const Vec3&) { return true; });
    isSmall = high - low <= kMostLength * longest;
  }
  return isSmall;
}

/// The measured points of all ranks in each cell of @p box.
std::vector<std::int64_t> CoreSearch::count(const Bounds& box, double edge) const
{
  std::vector<std::int64_t> cells(std::size_t(kCells * kCells * kCells), 0);
  this->forEach(0, 1,
    [&](const Vec3& raw, const Vec3& p)
    {
      if (this->isNoData(raw) || !contains(box, p))
      {
        return;
      }
      std::array<int, 3> cell{};
      for (int axis = 0; axis < 3; ++axis)
      {
        cell[std::size_t(axis)] = int(std::min((p[axis] - box.minimum[axis]) / edge, kCells - 1.0));
      }
      ++at(cells, cell);
    });
  const std::vector<std::int64_t> ofRanks = ranks_.gatherAll(cells);
  std::fill(cells.begin(), cells.end(), 0);
  for (std::size_t i = 0; i < ofRanks.size(); ++i)
  {
    cells[i % cells.size()] += ofRanks[i];
  }
  return cells;
}

/// The fullest cell, and those connected with it.
CellBox CoreSearch::cellsOfCore(std::vector<std::int64_t>& cells)
{
  const auto fullest = static_cast<int>(std::max_element(cells.begin(), cells.end()) - cells.begin());
  std::vector<std::array<int, 3>> reached{ { fullest % kCells, fullest / kCells % kCells,
    fullest / kCells / kCells } };
  std::vector<std::int64_t> waiting = cells; // 0: it was reached
  at(waiting, reached.front()) = 0;
  CellBox box;
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    box.include(reached[i]);
    around(reached[i])
      .forEach(
        [&](const std::array<int, 3>& next)
        {
          if (at(waiting, next) == 0)
          {
            return;
          }
          std::int64_t most = 0;
          around(next).forEach(
            [&](const std::array<int, 3>& beside) { most = std::max(most, at(cells, beside)); });
          if (double(at(cells, next)) >= kConnects * double(most))
          {
            at(waiting, next) = 0;
            reached.push_back(next);
          }
        });
  }
  return box;
}

/// On ever finer lattices, as long as the core does not fall apart there.
Bounds CoreSearch::core(const Bounds& all) const
{
  Bounds core = all;
  std::int64_t measured = 0; // on the first lattice
  for (double edge = longestSide(core) / kCells; edge > 0.0; edge = longestSide(core) / kCells)
  {
    std::vector<std::int64_t> cells = this->count(core, edge);
    measured = std::max(measured, std::accumulate(cells.begin(), cells.end(), std::int64_t(0)));
    const CellBox found = this->cellsOfCore(cells);
    std::int64_t inside = 0;
    found.forEach([&](const std::array<int, 3>& cell) { inside += at(cells, cell); });
    if ((measured - inside) * kMostPart > measured)
    {
      break;
    }
    const CellBox cut = found.grown();
    const Vec3 corner = core.minimum;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto a = std::size_t(axis);
      core.minimum[axis] = corner[axis] + edge * cut.low[a];
      core.maximum[axis] =
        cut.high[a] < kCells - 1 ? corner[axis] + edge * (cut.high[a] + 1) : core.maximum[axis];
    }
    if (found.longest() > kCells / 4)
    {
      break;
    }
  }
  return core;
}

std::string boxText(const Bounds& box, int digits)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(digits);
  for (int axis = 0; axis < 3; ++axis)
  {
    text << (axis > 0 ? "," : "") << box.minimum[axis] << "," << box.maximum[axis];
  }
  return text.str();
}

} // namespace

std::string FarPoints::text() const
{
  return countText(count) + " of " + countText(of) + (count == 1 ? " points is" : " points are") +
    " far from all others";
}

std::string FarPoints::note() const
{
  // Digits enough for the margin, also of map coordinates: they may not cut.
  const double margin = 0.001 * longestSide(all);
  const int digits = int(std::clamp(std::ceil(-std::log10(margin)), 0.0, 17.0));
  const std::string them = count == 1 ? "it" : "them";
  return text() + "; lattice and picture leave " + them + " out, a workspace of " +
    boxText(grown(all, margin), digits) + " takes " + them + " in";
}

FarPoints findFarPoints(const PointView& points, const Bounds& bounds, const AffineTransform& transform)
{
  Ranks alone;
  return findFarPoints({ points }, bounds, alone, transform);
}

FarPoints findFarPoints(
  const std::vector<PointView>& parts, const Bounds& bounds, Ranks& ranks, const AffineTransform& transform)
{
  FarPoints none;
  none.all = none.others = commonBounds(ranks, bounds);
  const double longest = longestSide(none.all);
  CoreSearch search(parts, transform, ranks);
  if (ranks.sum(search.size()) < kFewest || !(longest > 0.0) || !std::isfinite(longest) ||
    !search.mayBeSmall(longest))
  {
    return none;
  }
  const Bounds core = search.core(none.all);
  if (longestSide(core) > longest / 2.0)
  {
    return none;
  }
  FarPoints found;
  search.forEach(0, 1,
    [&](const Vec3&, const Vec3& p)
    {
      ++found.of;
      contains(core, p) ? found.others.include(p) : static_cast<void>(++found.count);
    });
  found.of = ranks.sum(found.of);
  found.count = ranks.sum(found.count);
  found.all = none.all;
  found.others = commonBounds(ranks, found.others);
  return found.count > 0 && longestSide(found.others) <= kMostLength * longest ? found : none;
}

Bounds boundsForLattice(const LatticeSettings& settings, const std::vector<PointView>& parts,
  const Bounds& bounds, Ranks& ranks, const AffineTransform& transform, std::string& note)
{
  const Bounds all = commonBounds(ranks, bounds);
  Lattice lattice;
  note.clear();
  if (settings.voxelSize > 0.0 && makeLattice(settings, all, lattice) == Status::Ok)
  {
    return all;
  }
  const FarPoints far = findFarPoints(parts, bounds, ranks, transform);
  note = far.count > 0 ? far.note() : std::string();
  return far.others;
}

} // namespace pointhaptics
