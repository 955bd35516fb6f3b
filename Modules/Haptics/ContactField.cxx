#include "Haptics/ContactField.h"

#include "Core/Base/Boxes.h"

#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace pointhaptics
{
namespace
{

/// Points are sparser than cells from this radius on, over the index cell: they are then 1.5 cells apart.
/// With a smaller limit bends of dense surfaces would count.
constexpr double kSparseInCells = 3.6;
/// For each cell of level 0 the index of the first one at the same place.
std::vector<std::uint32_t> firstAtPlace(const CellPyramid& pyramid)
{
  const CellPyramid::Level& level = pyramid.level(0);
  const auto isBefore = [&](std::uint32_t a, std::uint32_t b)
  {
    const Vec3& p = level.cells[a].mean;
    const Vec3& q = level.cells[b].mean;
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  };
  std::vector<std::uint32_t> sorted(level.cells.size());
  std::iota(sorted.begin(), sorted.end(), 0U);
  std::vector<std::uint32_t> first = sorted;
  // The points of a place are in one voxel.
  for (std::size_t slot = 0; slot + 1 < level.slotBegin.size(); ++slot)
  {
    const std::uint32_t begin = level.slotBegin[slot];
    const std::uint32_t end = level.slotBegin[slot + 1];
    std::sort(sorted.begin() + begin, sorted.begin() + end, isBefore);
    for (std::uint32_t i = begin + 1; i < end; ++i)
    {
      const std::uint32_t before = sorted[i - 1];
      first[sorted[i]] = level.cells[sorted[i]].mean == level.cells[before].mean ? first[before] : sorted[i];
    }
  }
  return first;
}

} // namespace

void ContactField::build(const CellPyramid& pyramid, const SheetFieldSettings& settings, const Bounds& felt,
  const Executor& executor, const std::function<double(const Vec3&)>& coarser)
{
  constexpr std::uint32_t kNoPlace = ~std::uint32_t(0);
  pyramid_ = &pyramid;
  const std::vector<Cell>& cells = pyramid.level(0).cells;
  const std::vector<std::uint32_t> first = firstAtPlace(pyramid);
  std::vector<Vec3> places;
  std::vector<std::uint32_t> placeOf(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const bool isFelt = felt.empty() || contains(felt, cells[i].mean);
    placeOf[i] = !isFelt ? kNoPlace : first[i] == i ? std::uint32_t(places.size()) : placeOf[first[i]];
    if (isFelt && first[i] == i)
    {
      places.push_back(cells[i].mean);
    }
  }
  const std::vector<SheetPoint> field =
    sheetField({ places.data(), std::int64_t(places.size()) }, settings, executor);
  cells_.assign(1, std::vector<float>(cells.size()));
  sparse_ = kSparseInCells * pyramid.level(0).voxelSize;
  std::transform(placeOf.begin(), placeOf.end(), cells_[0].begin(),
    [&](std::uint32_t place)
    { return place == kNoPlace ? float(settings.leastRadius) : field[place].radius; });
  for (std::size_t i = 0; coarser && i < cells.size(); ++i)
  {
    if (placeOf[i] != kNoPlace)
    {
      cells_[0][i] = std::max(cells_[0][i], float(coarser(cells[i].mean)));
    }
  }
  std::vector<float> sorted = cells_[0];
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2), sorted.end());
  typical_ = double(sorted[sorted.size() / 2]);
  largest_ = double(*std::max_element(sorted.begin(), sorted.end()));
  this->mergeCells();
  this->boundBricks();
}

double ContactField::sparseRadiusAt(const Vec3& place, double search) const
{
  double distance = 0.0;
  const std::int64_t nearest = pyramid_->nearest(0, place, search, distance);
  const double radius = nearest >= 0 ? double(cells_[0][std::size_t(nearest)]) : 0.0;
  return radius > sparse_ ? radius : 0.0;
}

bool ContactField::isSparseNear(const Bounds& box) const
{
  bool isFound = false;
  const std::vector<float>& radii = cells_[0];
  pyramid_->visitRuns(0, box.center(), 0.5 * norm(box.extent()),
    [&](std::uint32_t first, std::uint32_t last)
    {
      isFound = std::any_of(radii.begin() + first, radii.begin() + last,
        [this](float radius) { return double(radius) > sparse_; });
      return !isFound;
    });
  return isFound;
}

/// The cells below a coarser one follow each other along the Morton curve.
void ContactField::mergeCells()
{
  const std::vector<Cell>& cells = pyramid_->level(0).cells;
  const auto voxelOf = [this](const Vec3& p, double size)
  {
    const Vec3 d = p - pyramid_->corner();
    return std::array<std::int64_t, 3>{ std::int64_t(std::floor(d.x / size)),
      std::int64_t(std::floor(d.y / size)), std::int64_t(std::floor(d.z / size)) };
  };
  for (int level = 1; level < pyramid_->numberOfCellLevels(); ++level)
  {
    std::vector<float> merged;
    std::array<std::int64_t, 3> last{};
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      std::array<std::int64_t, 3> voxel = voxelOf(cells[i].mean, pyramid_->level(0).voxelSize);
      std::transform(
        voxel.begin(), voxel.end(), voxel.begin(), [level](std::int64_t index) { return index >> level; });
      if (merged.empty() || voxel != last)
      {
        merged.push_back(0.0F);
        last = voxel;
      }
      merged.back() = std::max(merged.back(), cells_[0][i]);
    }
    // A run that the pyramid counted otherwise would shift the radii of all cells behind it.
    if (merged.size() != pyramid_->level(level).cells.size())
    {
      merged.assign(pyramid_->level(level).cells.size(), float(largest_));
    }
    cells_.push_back(std::move(merged));
  }
}

void ContactField::boundBricks()
{
  bricks_.resize(std::size_t(pyramid_->numberOfLevels()));
  for (int level = 0; level < pyramid_->numberOfLevels(); ++level)
  {
    const CellPyramid::Level& l = pyramid_->level(level);
    std::vector<float>& bounds = bricks_[std::size_t(level)];
    for (const CellPyramid::Brick& brick : l.bricks)
    {
      const std::uint32_t end = brick.slot + std::uint32_t(__builtin_popcountll(brick.mask));
      const bool isFinest = level == 0;
      const float* const below = isFinest ? cells_[0].data() : bricks_[std::size_t(level) - 1].data();
      const std::uint32_t begin = isFinest ? l.slotBegin[brick.slot] : brick.child;
      bounds.push_back(
        *std::max_element(below + begin, below + (isFinest ? l.slotBegin[end] : begin + brick.childCount)));
    }
  }
}

} // namespace pointhaptics
