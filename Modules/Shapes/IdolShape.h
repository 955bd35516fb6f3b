/// @file
/// The idol: a small statue with plinth, robe, folded arms and a face; the image of the unit sphere under one
/// smooth map, so that points, normals and foot points follow from derivatives. Internal to Core.
#pragma once

#include "Core/Base/Vector3.h"

#include <algorithm>
#include <array>
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

/// A smooth step from 0 (x far below 0) to 1.
template <typename T>
T smoothStep(const T& x)
{
  return T(0.5) + 0.5 * (x * inverse(sqrt(T(1.0) + x * x)));
}
/// A smooth bump: 1 at 0, 1/4 at 1, fading with the fourth power.
template <typename T>
T smoothBump(const T& x)
{
  const T s = inverse(T(1.0) + x * x);
  return s * s;
}

/// step(c, at, width): from 0 to 1 as c passes @p at.
template <typename T>
T stepAt(const T& c, double at, double width)
{
  return smoothStep((1.0 / width) * (c - T(at)));
}
template <typename T>
T bumpAt(const T& c, double at, double width)
{
  return smoothBump((1.0 / width) * (c - T(at)));
}
/// 1 between low and high, 0 outside, smooth.
template <typename T>
T between(const T& c, double low, double high, double width)
{
  return stepAt(c, low, width) * stepAt(T(0.0) - c, -high, width);
}

/// Half-widths in metres over the height c (-1 at the foot, 1 at the crown), before the sphere's own
/// rounding.
template <typename T>
void idolWidths(const T& c, T& across, T& deep)
{
  const T plinthTop = stepAt(c, -0.80, 0.03);
  const T plinthNeck = stepAt(c, -0.70, 0.03);
  const T neck = stepAt(c, 0.27, 0.035);
  const T head = 0.0105 * bumpAt(c, 0.60, 0.27) + 0.009 * bumpAt(c, 0.88, 0.12);
  across = T(0.056) - 0.0195 * plinthTop - 0.016 * plinthNeck + 0.0035 * bumpAt(c, 0.06, 0.20) -
    0.0135 * neck + head;
  deep =
    T(0.050) - 0.018 * plinthTop - 0.0145 * plinthNeck - 0.005 * stepAt(c, -0.1, 0.2) - 0.0055 * neck + head;
}

/// Relief that the features add to the half-widths, as a fraction.
template <typename T>
T idolRelief(const T& x, const T& y, const T& c)
{
  const T front = stepAt(T(0.0) - y, 0.0, 0.15);
  const T nose = bumpAt(x, 0.0, 0.11) * between(c, 0.56, 0.74, 0.03);
  const T brow = bumpAt(c, 0.755, 0.035) * between(x, -0.50, 0.50, 0.1);
  const T eyes = (bumpAt(x, 0.28, 0.12) + bumpAt(x, -0.28, 0.12)) * bumpAt(c, 0.675, 0.045);
  const T lips = bumpAt(x, 0.0, 0.18) * (bumpAt(c, 0.495, 0.018) + bumpAt(c, 0.455, 0.018));
  const T chin = bumpAt(x, 0.0, 0.25) * bumpAt(c, 0.385, 0.035);
  const T hands = bumpAt(x, 0.0, 0.20) * bumpAt(c, -0.23, 0.09);
  const T face = 0.22 * nose + 0.08 * brow - 0.10 * eyes + 0.07 * lips + 0.12 * chin + 0.12 * hands;
  const T ears = bumpAt(y, 0.06, 0.10) * between(c, 0.54, 0.76, 0.035);
  const T alongForearm = c + T(0.25) - 0.22 * (x * x);
  const T forearms =
    stepAt(T(0.0) - y, 0.0, 0.3) * bumpAt(alongForearm, 0.0, 0.10) * between(x, -0.90, 0.90, 0.08);
  const T upperArms = bumpAt(y, 0.0, 0.34) * between(c, -0.20, 0.16, 0.05);
  return front * face + 0.17 * ears + 0.20 * forearms + 0.16 * upperArms;
}

/// The point of the idol for the point q of the unit sphere. It looks along -y; z is up; metres.
template <typename T>
std::array<T, 3> idolMap(const std::array<T, 3>& q)
{
  T across, deep;
  idolWidths(q[2], across, deep);
  const T swelling = T(1.0) + idolRelief(q[0], q[1], q[2]);
  const T forward = 0.0015 * stepAt(q[2], 0.32, 0.05);
  return { q[0] * across * swelling, q[1] * deep * swelling - forward, 0.045 * q[2] };
}

} // namespace detail
} // namespace pointhaptics
