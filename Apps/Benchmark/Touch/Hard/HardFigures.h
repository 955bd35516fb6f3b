/// @file
/// Figures of a hand on a hard scene beside the truth: they say whether it is let go, gets energy or falls
/// through.
#pragma once

#include "Benchmark/Touch/Hard/HardScenes.h"
#include "Benchmark/Touch/TouchJudge.h"

#include "Core/Neighbors/NeighborQuery.h"

#include <array>
#include <limits>
#include <vector>

namespace pointhaptics::bench::touch::hard
{

/// N; longer forces of the truth are cut to this length, as the felt ones are.
constexpr double kForceLimit = 8.0;
/// N; less counts as none.
constexpr double kFeltForce = 0.05;

/// The points of a cloud and their spacings, for the distance of contacts and hands from them.
class CloudDistance
{
public:
  /// @param points outlives this.
  explicit CloudDistance(const std::vector<Vec3>& points);
  /// Metres to the nearest point. @param spacing its local spacing, metres.
  double operator()(const Vec3& p, double& spacing) const;

private:
  NeighborQuery query_;
  const std::vector<Vec3>& points_;
};

/// Truths of the strokes of a scene: of solids those of truthOf(), of open meshes one god object that meets
/// them from both sides; cut to kForceLimit. Empty for scenes without a mesh.
std::vector<TouchTruth> hardTruths(const HardScene& scene, double stiffness);

struct HardFigures
{
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  bool hasTruth() const { return phantomPercent == phantomPercent; }

  int strokes = 0;
  int held = 0; ///< Strokes with a force in all of the last 50 ticks, in which the hand should be free.
  /// Strokes with a force in all of the last 50 ticks, in which the hand is farther than 3 F_max/K (5 to 15
  /// mm at F_max/K) from its contact and 10 mm from every point: whatever a truth says, a hand is let go
  /// there.
  int notLetGo = 0;
  int truthHeld = 0;   ///< Strokes whose truth has a force in the last 50 ticks.
  int fellThrough = 0; ///< Strokes with 20 ticks or more without a force where the truth has 0.2 to 8 N.
  int nonFinite = 0;   ///< States that are not finite: beyond doubt wrong.
  double phantomPercent = kNone; ///< Ticks with a force, per cent of those in which the truth is free.
  double phantomNewton = kNone;  ///< Largest force in them.
  double lostPercent = kNone;    ///< Ticks without a force, per cent of those in which the truth has 0.2 to 8
                                 ///< N.
  double medianPercent = kNone;  ///< Error of the force, of HardScene::hasErrors only.
  double p95Percent = kNone;
  /// Largest over the strokes of what the force gives to the hand, J. All strokes begin free, so an ideal
  /// contact gives nothing on a path that closes or ends free.
  double energyJoule = 0.0;
  double largestNewton = 0.0;
  double contactSpacings = 0.0; ///< Largest distance of a contact point from the nearest point of the cloud.
  double p50 = 0.0;             ///< Median time of a tick in contact, microseconds.
  double p99 = 0.0;
  std::array<double, kStatusBits> statusPercent{};
};

/// Adds the strokes of a scene up.
class HardJudge
{
public:
  HardJudge(const HardScene& scene, const CloudDistance& distance, double stiffness);
  /// @param truth null for a scene without.
  void add(const TouchTrace& trace, const TouchTruth* truth);
  HardFigures figures() const;

private:
  void addTicks(const TouchTrace& trace);
  void addTruth(const TouchTrace& trace, const TouchTruth& truth);
  bool isFar(const ProxyState& state) const;
  void addEnd(const TouchTrace& trace, const TouchTruth* truth);

  const CloudDistance& distance_;
  double stiffness_;
  bool hasTruth_;
  bool hasErrors_;
  HardFigures sum_;
  TouchJudge errors_; ///< Judge of solids, as in the other studies.
  std::vector<double> microseconds_;
  std::array<std::int64_t, kStatusBits> status_{};
  std::int64_t ticks_ = 0;
  std::int64_t freeTicks_ = 0;
  std::int64_t phantomTicks_ = 0;
  std::int64_t pressedTicks_ = 0;
  std::int64_t lostTicks_ = 0;
};

} // namespace pointhaptics::bench::touch::hard
