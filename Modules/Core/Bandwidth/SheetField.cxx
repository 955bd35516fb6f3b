#include "Core/Bandwidth/SheetField.h"

#include "Core/Base/Vector3.h"
#include "Core/Neighbors/NeighborSweep.h"
#include "Core/Neighbors/PrincipalPlane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
/// Neighbours that tell normal and spacing. Fewer: noise of a tenth of the spacing turns normals away.
constexpr int kNeighbors = 16;
/// Widths of the weights by height over the plane, over the distance of the last neighbour, round by round.
/// With one round the normals beside an edge lie between both faces.
constexpr double kWidths[] = { 0.3, 0.1 };
/// A neighbour is of the same sheet where it is no steeper above the plane (a sine), and its normal agrees (a
/// cosine). Looser: the other face of an edge or of a thin plate halves the spacing.
constexpr double kSteep = 0.35;
constexpr double kAgree = 0.7;
/// Neighbours of the same sheet that are counted at most, and needed at least: scattered points have two by
/// chance.
constexpr int kCounted = 12;
constexpr int kLeast = 4;
/// The middle of half a disk is 0.42 radii aside. The middle of a few points on a whole disk lies aside by
/// chance up to the first; the filled part falls by the second for each radius beyond, to that of one
/// neighbour.
constexpr double kChanceOffset = 0.3;
constexpr double kPartPerOffset = 4.0;
/// The middle of a quarter of a disk is 0.6 radii aside. A point farther from its neighbours is no part of
/// their sheet: it is a stray in their plane, and its ball would reach to them.
constexpr double kMostAside = 0.7;
/// Spacing of a sheet over that of all neighbours, at most. Without it a bend of few points has balls as wide
/// as the part.
constexpr double kMostOfAll = 1.4142135623730951;
/// Least eigenvalue of the neighbours' moments over the next where they lie in a plane.
constexpr double kFlat = 0.1;
/// Ratio below which all neighbours count alike; without it each point of a smooth surface takes three fits.
constexpr double kThin = 0.01;
/// Spacing over the median up to which points are a sheet, and where all neighbours lie in a plane. Without
/// the second a point in the middle of a ring has a ball as wide as the ring.
constexpr double kScattered = 4.0;
constexpr double kSparsest = 10.0;
/// Ratio of radii that is a step in density, and no chance.
constexpr double kStep = 1.5;
/// Below 2.2 spacings a ball falls through a random sample.
constexpr double kRadiusInSpacings = 2.4;
/// Least fall of the radius over the way. More: a hand falls through beside a step in density.
constexpr double kSlope = 0.25;

class Field
{
public:
  Field(const PointView& points, const SheetFieldSettings& settings, const Executor& executor)
    : settings_(settings)
    , executor_(executor)
  {
    query_.build(points, executor);
    near_.resize(std::size_t(query_.size()));
    sheets_.resize(std::size_t(query_.size()));
    NeighborSweep::runAll(
      query_, kNeighbors + 1, executor, [this](const NeighborList& list) { this->findNormal(list); });
    this->forEachSlot([this](std::uint32_t slot) { this->findSpacing(slot); });
    this->dropScattered();
    this->forEachSlot([this](std::uint32_t slot) { this->findRadius(slot); });
    this->reachAcrossSteps();
    this->limitSlope();
  }

  std::vector<SheetPoint> result() const
  {
    std::vector<SheetPoint> result(sheets_.size());
    for (std::size_t slot = 0; slot < sheets_.size(); ++slot)
    {
      result[std::size_t(query_.index(std::int64_t(slot)))] = sheets_[slot];
    }
    return result;
  }

private:
  struct Near
  {
    int count = 0;
    bool isFlat = false;                         ///< The neighbours lie in a plane, all of them.
    float spacing = 0.0F;                        ///< Spacing of all neighbours, as if they lay in one sheet.
    std::array<std::uint32_t, kNeighbors> slots; ///< Nearest first.
  };

  template <typename Visitor>
  void forEachSlot(const Visitor& visit) const
  {
    forEachIndex(executor_, query_.size(), [&visit](std::int64_t slot) { visit(std::uint32_t(slot)); });
  }

  Vec3 normalOf(std::uint32_t slot) const
  {
    const float* n = sheets_[slot].normal;
    return { double(n[0]), double(n[1]), double(n[2]) };
  }
  Vec3 offset(std::uint32_t from, std::uint32_t to) const
  {
    return query_.point(std::int64_t(to)) - query_.point(std::int64_t(from));
  }

  void findNormal(const NeighborList& list)
  {
    const auto slot = std::uint32_t(list.slot);
    Near& near = near_[slot];
    for (int i = 0; i < list.count && near.count < kNeighbors; ++i)
    {
      if (list.slots[i] != slot)
      {
        near.slots[std::size_t(near.count++)] = list.slots[i];
      }
    }
    if (near.count < kLeast)
    {
      return;
    }
    Vec3 offsets[kNeighbors + 1];
    for (int i = 0; i < near.count; ++i)
    {
      offsets[i + 1] = this->offset(slot, near.slots[std::size_t(i)]);
    }
    const double reach = norm(offsets[near.count]);
    near.spacing = float(reach * std::sqrt(kPi / near.count));
    PrincipalPlane plane;
    Vec3 middle;
    double width = 0.0;
    const auto fit = [&]
    {
      Vec3 sum;
      SymMat3 moments;
      double weights = 0.0;
      for (int i = 0; i <= near.count; ++i)
      {
        const double height = width > 0.0 ? dot(offsets[i] - middle, plane.normal) / width : 0.0;
        const double weight = 1.0 / ((1.0 + height * height) * (1.0 + height * height));
        weights += weight;
        sum += weight * offsets[i];
        SymMat3 moment = outerProduct(offsets[i]);
        moment *= weight;
        moments += moment;
      }
      middle = sum / weights;
      SymMat3 mean = outerProduct(middle);
      mean *= -weights;
      moments += mean;
      plane = principalPlane(moments);
    };
    fit();
    near.isFlat = plane.values[0] < kFlat * plane.values[1];
    if (plane.values[0] > kThin * plane.values[1])
    {
      for (const double part : kWidths)
      {
        width = part * reach;
        fit();
      }
    }
    std::copy(&plane.normal.x, &plane.normal.x + 3, sheets_[slot].normal);
  }

  /// Whether the way from one to the other stays in the plane of the first, whose normal agrees.
  bool isOfSheet(std::uint32_t a, std::uint32_t b) const
  {
    const Vec3 way = this->offset(a, b);
    const Vec3 normal = this->normalOf(a);
    const double height = dot(way, normal);
    return height * height < kSteep * kSteep * norm2(way) &&
      std::abs(dot(normal, this->normalOf(b))) > kAgree;
  }

  void findSpacing(std::uint32_t slot)
  {
    SheetPoint& sheet = sheets_[slot];
    const Near& near = near_[slot];
    int count = 0;
    double reach = 0.0;
    Vec3 sum;
    for (int i = 0; i < near.count && count < kCounted; ++i)
    {
      const std::uint32_t other = near.slots[std::size_t(i)];
      const Vec3 way = this->offset(slot, other);
      reach = norm(way);
      if (this->isOfSheet(slot, other))
      {
        sum += way;
        ++count;
      }
    }
    const double aside = norm(sum) / (std::max(1, count) * reach);
    if (count >= kLeast && aside < kMostAside)
    {
      const double part = std::clamp(1.0 - kPartPerOffset * (aside - kChanceOffset), 1.0 / kLeast, 1.0);
      // Two sheets have twice the points of one; where fewer agree the surface bends.
      sheet.spacing =
        float(std::min(reach * std::sqrt(kPi * part / count), kMostOfAll * double(near.spacing)));
    }
  }

  /// The spacing of a few points is off by chance: that of the neighbours counts where it is larger. With the
  /// mean of both a hand falls through on the sparse side of a step.
  void findRadius(std::uint32_t slot)
  {
    SheetPoint& sheet = sheets_[slot];
    double sum = 0.0;
    double count = 0.0;
    for (int i = 0; i < near_[slot].count && sheet.spacing > 0.0F; ++i)
    {
      const std::uint32_t other = near_[slot].slots[std::size_t(i)];
      if (sheets_[other].spacing > 0.0F && this->isOfSheet(slot, other))
      {
        sum += double(sheets_[other].spacing);
        count += 1.0;
      }
    }
    const double spacing = std::max(double(sheet.spacing), count > 0.0 ? sum / count : 0.0);
    sheet.radius = float(std::max(settings_.leastRadius, kRadiusInSpacings * spacing));
  }

  /// Points much sparser than most are scattered: a slab of strays lies in a plane, roughly.
  void dropScattered()
  {
    if (near_.empty())
    {
      return;
    }
    std::vector<float> spacings(near_.size());
    std::transform(
      near_.begin(), near_.end(), spacings.begin(), [](const Near& near) { return near.spacing; });
    const auto middle = spacings.begin() + std::ptrdiff_t(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    for (std::size_t slot = 0; slot < sheets_.size(); ++slot)
    {
      SheetPoint& sheet = sheets_[slot];
      const double most = (near_[slot].isFlat ? kSparsest : kScattered) * double(*middle);
      if (double(sheet.spacing) > most)
      {
        sheet.spacing = 0.0F;
      }
    }
  }

  /// Beside a step in density the nearest points are all on the dense side. The sparse ones that have them as
  /// neighbours tell that the sheet goes on.
  void reachAcrossSteps()
  {
    std::vector<std::pair<std::uint32_t, float>> raised;
    for (std::uint32_t slot = 0; slot < sheets_.size(); ++slot)
    {
      for (int i = 0; i < near_[slot].count && sheets_[slot].spacing > 0.0F; ++i)
      {
        const std::uint32_t other = near_[slot].slots[std::size_t(i)];
        if (double(sheets_[slot].radius) > kStep * double(sheets_[other].radius) &&
          this->isOfSheet(slot, other))
        {
          raised.emplace_back(other, sheets_[slot].radius);
        }
      }
    }
    const float most = settings_.mostRadius > 0.0 ? float(settings_.mostRadius) : INFINITY;
    for (const auto& [slot, radius] : raised)
    {
      sheets_[slot].radius = std::max(sheets_[slot].radius, std::min(most, radius));
    }
  }

  /// Raises radii to those of their neighbours, less the slope. The result is the least field with that
  /// slope, whatever the order.
  void limitSlope()
  {
    const double most = settings_.mostRadius > 0.0 ? settings_.mostRadius : INFINITY;
    std::vector<std::uint32_t> changed(sheets_.size());
    for (std::uint32_t slot = 0; slot < changed.size(); ++slot)
    {
      changed[slot] = slot;
    }
    while (!changed.empty())
    {
      std::vector<std::uint32_t> next;
      for (const std::uint32_t slot : changed)
      {
        if (!(sheets_[slot].spacing > 0.0F) && !(double(sheets_[slot].radius) > settings_.leastRadius))
        {
          continue; // on no sheet
        }
        const Near& near = near_[slot];
        for (int i = 0; i < near.count; ++i)
        {
          const std::uint32_t other = near.slots[std::size_t(i)];
          const float radius =
            float(std::min(most, double(sheets_[slot].radius) - kSlope * norm(this->offset(slot, other))));
          if (radius > sheets_[other].radius && this->isOfSheet(slot, other))
          {
            sheets_[other].radius = radius;
            next.push_back(other);
          }
        }
      }
      changed = std::move(next);
    }
  }

  SheetFieldSettings settings_;
  const Executor& executor_;
  NeighborQuery query_;
  std::vector<Near> near_;
  std::vector<SheetPoint> sheets_;
};

} // namespace

std::vector<SheetPoint> sheetField(
  const PointView& points, const SheetFieldSettings& settings, const Executor& executor)
{
  return Field(points, settings, executor).result();
}

} // namespace pointhaptics
