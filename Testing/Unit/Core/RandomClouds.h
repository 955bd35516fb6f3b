/// @file
/// Clouds with fixed seeds and executors that cut ranges in awkward ways, for the tests.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"
#include "Core/Base/Vector3.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

namespace pointhaptics
{
namespace trial
{

inline PointView view(const std::vector<Vec3>& points)
{
  return { points.data(), std::int64_t(points.size()) };
}

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Uniform numbers that do not depend on the standard library's distributions.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : engine_(seed)
  {
  }
  double uniform(double low = 0.0, double high = 1.0)
  {
    return low + (high - low) * (double(engine_() >> 11) * 0x1p-53);
  }
  /// Sum of twelve uniform numbers: standard deviation 1, bounded by 6.
  double normal()
  {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
    {
      sum += uniform();
    }
    return sum;
  }
  std::size_t below(std::size_t n) { return std::size_t(engine_() % n); }
  Vec3 inBox(const Vec3& low, const Vec3& high)
  {
    const double x = uniform(low.x, high.x);
    const double y = uniform(low.y, high.y);
    return { x, y, uniform(low.z, high.z) };
  }
  Vec3 direction()
  {
    for (;;)
    {
      const Vec3 v = inBox({ -1, -1, -1 }, { 1, 1, 1 });
      const double n2 = norm2(v);
      if (n2 > 1e-4 && n2 < 1.0)
      {
        return v / std::sqrt(n2);
      }
    }
  }

private:
  std::mt19937_64 engine_;
};

inline std::vector<Vec3> randomBox(std::size_t n, std::uint64_t seed, const Vec3& low, const Vec3& high)
{
  Random random(seed);
  std::vector<Vec3> points;
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    points.push_back(random.inBox(low, high));
  }
  return points;
}

inline std::vector<std::size_t> randomOrder(std::size_t n, std::uint64_t seed)
{
  Random random(seed);
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    order[i] = i;
    std::swap(order[i], order[random.below(i + 1)]);
  }
  return order;
}

/// Runs the pieces of a range one after the other, last piece first.
class BackwardExecutor : public Executor
{
public:
  explicit BackwardExecutor(std::int64_t piece)
    : piece_(piece)
  {
  }
  void run(std::int64_t count, std::int64_t, void* context, Body body) const override
  {
    for (std::int64_t end = count; end > 0; end -= piece_)
    {
      body(context, end > piece_ ? end - piece_ : 0, end);
    }
  }

private:
  std::int64_t piece_;
};

/// Runs a range on several threads, one uneven piece each.
class ThreadedExecutor : public Executor
{
public:
  explicit ThreadedExecutor(int threads)
    : threads_(threads)
  {
  }
  int concurrency() const override { return threads_; }
  void run(std::int64_t count, std::int64_t, void* context, Body body) const override
  {
    std::vector<std::thread> running;
    for (std::int64_t t = 0; t < threads_; ++t)
    {
      const std::int64_t begin = count * t * t / (threads_ * threads_);
      const std::int64_t end = count * (t + 1) * (t + 1) / (threads_ * threads_);
      if (begin < end)
      {
        running.emplace_back(body, context, begin, end);
      }
    }
    for (std::thread& thread : running)
    {
      thread.join();
    }
  }

private:
  std::int64_t threads_;
};

} // namespace trial
} // namespace pointhaptics
