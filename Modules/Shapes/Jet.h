/// @file
/// Numbers that carry their derivatives by two parameters a and b. Internal to Core.
#pragma once

#include <cmath>

namespace pointhaptics
{
namespace detail
{

/// Value, d/da, d/db and, with Order 2, d2/da2, d2/dadb, d2/db2: exact up to rounding.
template <int Order>
struct Jet
{
  static constexpr int kTerms = Order == 2 ? 6 : 3;
  double d[kTerms] = {};

  Jet() = default;
  Jet(double value) { d[0] = value; }

  /// f(*this), from the value and the first two derivatives of f there.
  Jet chain(double f0, double f1, double f2) const
  {
    Jet r(f0);
    r.d[1] = f1 * d[1];
    r.d[2] = f1 * d[2];
    if constexpr (Order == 2)
    {
      r.d[3] = f1 * d[3] + f2 * d[1] * d[1];
      r.d[4] = f1 * d[4] + f2 * d[1] * d[2];
      r.d[5] = f1 * d[5] + f2 * d[2] * d[2];
    }
    return r;
  }
  friend Jet operator+(Jet x, const Jet& y)
  {
    for (int i = 0; i < kTerms; ++i)
    {
      x.d[i] += y.d[i];
    }
    return x;
  }
  friend Jet operator-(Jet x, const Jet& y)
  {
    for (int i = 0; i < kTerms; ++i)
    {
      x.d[i] -= y.d[i];
    }
    return x;
  }
  friend Jet operator*(const Jet& x, const Jet& y)
  {
    Jet r(x.d[0] * y.d[0]);
    r.d[1] = x.d[0] * y.d[1] + x.d[1] * y.d[0];
    r.d[2] = x.d[0] * y.d[2] + x.d[2] * y.d[0];
    if constexpr (Order == 2)
    {
      r.d[3] = x.d[0] * y.d[3] + 2.0 * x.d[1] * y.d[1] + x.d[3] * y.d[0];
      r.d[4] = x.d[0] * y.d[4] + x.d[1] * y.d[2] + x.d[2] * y.d[1] + x.d[4] * y.d[0];
      r.d[5] = x.d[0] * y.d[5] + 2.0 * x.d[2] * y.d[2] + x.d[5] * y.d[0];
    }
    return r;
  }
  friend Jet operator*(double s, Jet x)
  {
    for (double& term : x.d)
    {
      term *= s;
    }
    return x;
  }
  friend Jet inverse(const Jet& x)
  {
    const double i = 1.0 / x.d[0];
    return x.chain(i, -i * i, 2.0 * i * i * i);
  }
  friend Jet sqrt(const Jet& x)
  {
    const double root = std::sqrt(x.d[0]);
    return x.chain(root, 0.5 / root, -0.25 / (root * x.d[0]));
  }
};

} // namespace detail
} // namespace pointhaptics
