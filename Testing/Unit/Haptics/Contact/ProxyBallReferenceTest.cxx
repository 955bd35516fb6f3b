#include "BallFixtures.h"

using namespace pointhaptics;
using trial::BallInScene;
using trial::LongVec;
using trial::Real;

namespace
{

/// The ball as one would explain it: tiny steps towards the HIP, out of what is covered, and a try all round
/// whether a small lift leads nearer. All points, long double, no cleverness.
class ReferenceBall
{
public:
  ReferenceBall(const std::vector<Vec3>& points, const Vec3& center, Real radius, const Vec3& hip)
    : center_(center)
    , hip_(hip)
    , radius_(radius)
  {
    const Real reach = norm(hip_ - center_) + 4.0L * radius;
    for (const Vec3& p : points)
    {
      if (norm(LongVec(p) - hip_) < reach)
      {
        points_.emplace_back(p);
      }
    }
  }
  void fall(trial::Random& random)
  {
    descend();
    for (int hop = 0, missed = 0; hop < 300 && missed < 16 && !isFree(); ++hop)
    {
      const LongVec start = center_;
      const Real before = away();
      const Vec3 up =
        normalized({ double(center_.x - hip_.x), double(center_.y - hip_.y), double(center_.z - hip_.z) });
      const Real reach = random.uniform(0.2, 1.0);
      go((0.3L * radius_) * LongVec(up));
      go((reach * radius_) * LongVec(normalized(cross(up, random.direction()))));
      descend();
      const bool nearer = away() < before - 1e-3L * radius_;
      missed = nearer ? 0 : missed + 1;
      center_ = nearer ? center_ : start;
    }
  }
  bool isFree() const { return away() < 1e-9L * radius_; }
  Real away() const { return norm(hip_ - center_); }
  Vec3 center() const { return { double(center_.x), double(center_.y), double(center_.z) }; }

private:
  static constexpr Real kStep = 0.04L;

  bool pushOut()
  {
    for (int push = 0; push < 40; ++push)
    {
      const LongVec* nearest = nullptr;
      Real least = radius_ * (1.0L - 1e-12L);
      for (const LongVec& p : points_)
      {
        const Real distance = norm(center_ - p);
        nearest = distance < least ? &p : nearest;
        least = std::min(least, distance);
      }
      if (!nearest)
      {
        return true;
      }
      center_ = *nearest + (radius_ / least) * (center_ - *nearest);
    }
    return false;
  }
  void descend()
  {
    for (int idle = 0; idle < 3 && !isFree();)
    {
      const LongVec start = center_;
      const Real before = away();
      center_ = center_ + std::min(1.0L, kStep * radius_ / before) * (hip_ - center_);
      if (!pushOut() || away() > before)
      {
        center_ = start;
        return;
      }
      idle = away() > before - 1e-5L * radius_ ? idle + 1 : 0;
    }
  }
  void go(const LongVec& way)
  {
    const int steps = int(std::ceil(norm(way) / (kStep * radius_)));
    for (int i = 0; i < steps; ++i)
    {
      const LongVec start = center_;
      center_ = center_ + (1.0L / steps) * way;
      if (!pushOut())
      {
        center_ = start;
        return;
      }
    }
  }

  std::vector<LongVec> points_;
  LongVec center_;
  LongVec hip_;
  Real radius_;
};

double quantile(std::vector<double> values, double part)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[std::size_t(part * double(values.size() - 1))];
}

} // namespace

TEST(ProxyBallReference, FindsThePlaneAndTheSphere)
{
  trial::Random random(32);
  const BallInScene plane(trial::rawScene(trial::jitteredPlane(100, 0.02, 0.0, random)));
  const BallInScene sphere(trial::rawScene(trial::spherePoints(20000, 0.01, random)));
  for (const bool flat : { true, false })
  {
    std::vector<double> off;
    std::vector<double> aside;
    for (int run = 0; run < 100; ++run)
    {
      BallInScene hand = (flat ? plane : sphere).copy();
      const Vec3 up = flat ? Vec3(0, 0, 1) : random.direction();
      const Vec3 foot = flat ? random.inBox({ -0.006, -0.006, 0 }, { 0.006, 0.006, 0 }) : 0.01 * up;
      const double depth = random.uniform(2e-4, 3e-3);
      hand.step(foot + 0.003 * up + 0.001 * random.direction());
      hand.go(foot - depth * up, random.uniform(0.02, 0.3));
      hand.rest(100);
      ASSERT_FALSE(hand.ball().isFree());
      const Vec3 found = hand.ball().nearestPoint(hand.hip());
      ASSERT_NEAR(hand.ball().depth(hand.hip()), norm(found - hand.hip()), 1e-15);
      const double r = hand.ball().radius();
      const Vec3 lean = found - foot - dot(found - foot, up) * up;
      off.push_back(std::abs(flat ? found.z : norm(found) - 0.01) / r);
      aside.push_back(norm(lean) / r);
    }
    const char* names[2][2] = { { "sphereOff", "sphereAside" }, { "planeOff", "planeAside" } };
    EXPECT_LE(trial::recorded(names[flat][0], quantile(off, 1.0)), 0.3);
    // The bumps between points hold it aside where gliding does not help.
    EXPECT_LE(quantile(aside, 0.5), 0.3);
    EXPECT_LE(trial::recorded(names[flat][1], quantile(aside, 1.0)), 1.2);
  }
}

TEST(ProxyBallReference, EndsWhereABallInTinyStepsEnds)
{
  constexpr int kRuns = 40;
  trial::Random random(34);
  std::vector<double> off;
  std::vector<double> farther;
  int differ = 0;
  int free = 0;
  for (int run = 0; run < kRuns; ++run)
  {
    std::vector<Vec3> points = trial::jitteredPlane(56, 0.014, 0.0, random);
    const double height = random.uniform(0.0, 0.002);
    const double angle = random.uniform(0.0, 6.0);
    for (Vec3& p : points)
    {
      p.z = height * std::sin(400 * p.x + angle) * std::cos(300 * p.y);
    }
    BallInScene hand(trial::rawScene(points));
    const Vec3 foot = points[56 * (20 + random.below(16)) + 20 + random.below(16)];
    const Vec3 start = foot + random.inBox({ -0.001, -0.001, 0.003 }, { 0.001, 0.001, 0.004 });
    const Vec3 end =
      foot + Vec3(0, 0, run % 4 == 0 ? random.uniform(3e-4, 1e-3) : random.uniform(-2e-3, 3e-4));
    hand.step(start);
    hand.go(end, 0.05);
    hand.rest(150);
    const double r = hand.ball().radius();
    ReferenceBall reference(points, start, r, end);
    reference.fall(random);
    free += reference.isFree();
    if (reference.isFree() != hand.ball().isFree())
    {
      ++differ;
      continue;
    }
    off.push_back(norm(reference.center() - hand.ball().center()) / r);
    farther.push_back((norm(hand.ball().center() - end) - double(reference.away())) / r);
  }
  EXPECT_LE(trial::recorded("freeDiffers", differ), kRuns / 20);
  EXPECT_GT(free, kRuns / 20);
  EXPECT_LT(free, kRuns / 2);
  EXPECT_LE(trial::recorded("apartMedian", quantile(off, 0.5)), 0.15);
  EXPECT_LE(trial::recorded("apartP90", quantile(off, 0.9)), 1.0);
  // Two may lie in two pockets; neither is deeper than the other by much.
  EXPECT_GE(trial::recorded("fartherLeast", quantile(farther, 0.0)), -0.1);
  EXPECT_LE(trial::recorded("fartherMost", quantile(farther, 1.0)), 0.1);
}
