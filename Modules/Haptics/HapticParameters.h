/// @file
/// Every constant of the haptic rendering that a user may set, with its unit, default and range.
#pragma once

#include "Core/Base/SettingsMembers.h"
#include "Core/Base/Status.h"

#include <limits>
#include <tuple>

namespace pointhaptics
{

enum class ProxyMethod
{
  SurfaceFit,    ///< Local quadric fit to the voxel means: the accurate method, default.
  GradientSteps, ///< The paper's iteration on the sum of point penetrations.
  Sphere,        ///< The ball that decides about contact for SurfaceFit, alone: a sphere among the points.
};

/// Contact and spring of a proxy. Plain data.
struct ContactParameters
{
  double stiffness = 800.0;     ///< K, N/m, 0 to 1e5.
  double damping = 0.0;         ///< Damps the HIP's speed along the normal in contact, N s/m, 0 to 1e3.
  double staticFriction = 0.0;  ///< mu_s, 0 to 10; at least dynamicFriction.
  double dynamicFriction = 0.0; ///< mu_d, 0 to 10.
  /// Rate of changes in contact that the hand did not cause, N/s, above 0; infinity: at once. With SurfaceFit
  /// and Sphere the force follows the hand by at most 2 K |dH| a tick, and a zoom in touch or a jump of the
  /// nearest point settles at this rate. With every method so do changes of parameters and scenes. Where
  /// contact ends the force ends at once.
  double settleRate = 100.0;
  /// F, N: the force never exceeds it; above 0, infinity: none, for virtual time only. The spring has its
  /// full force up to F/K, the limit from there to twice the hold length (F/K, within 5 and 15 mm), and fades
  /// to nothing at three times that. There contact ends where no point is within 10 mm of the hand. A servo
  /// loop lowers it to what the device declares.
  double forceLimit = 8.0;

  static constexpr auto members()
  {
    using S = ContactParameters;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return std::make_tuple(
      settingsMember("stiffness", &S::stiffness,
        { "--stiffness", "Stiffness of the surface; default 800", "N_PER_M", { 0.0, 1e5 } }),
      settingsMember("damping", &S::damping,
        { "--damping", "Of the hand's speed along the normal, in contact; default 0", "N_S_PER_M",
          { 0.0, 1e3 } }),
      settingsMember("staticFriction", &S::staticFriction,
        { "--mu-s", "Static friction; default that of --mu-d", "X", { 0.0, 10.0 } }),
      settingsMember("dynamicFriction", &S::dynamicFriction,
        { "--mu-d", "Dynamic friction; default 0", "X", { 0.0, 10.0 } }),
      settingsMember("settleRate", &S::settleRate, { nullptr, "", "N/s", { 0.0, kInfinity, true } }),
      settingsMember("forceLimit", &S::forceLimit,
        { "--force-limit",
          "The force never exceeds this, fades where the hand is far from its contact, and lets it go; above "
          "0, inf: none, in virtual time only; default 8",
          "N", { 0.0, kInfinity, true } }));
  }
};
static_assert(listsEveryMember<ContactParameters>());

/// Gains of GradientSteps. Symbols are the paper's.
struct GradientStepsParameters
{
  double freeGain = 0.002;            ///< k_h: part of the way to the HIP per step in free space, 0 to 1.
  double normalGain = 0.064;          ///< k_n: step along v_n (the sum of penetrations) per step, 0 to 10.
  double tangentGain = 8e-6;          ///< delta: part of v_t per step in contact, 0 to 1.
  double sinkTolerance = 0.05;        ///< zeta / r_p, 0 to 1: the proxy sinks where |v_n| exceeds zeta.
  double stepPeriodSeconds = 3.28e-5; ///< Time one step stands for: steps per tick = tick / this, at least 1.
  int maximumStepsPerTick = 64;       ///< Cap of the bounded work per tick, 1 to 10000.
  double largestStep =
    0.5; ///< Longest free or tangential step over the radius: keeps the sphere from diving in.
  bool normalizedByDensity = false; ///< k_n acts on the part of v_n above zeta, divided by the number of
                                    ///< points in the sphere: a Newton step, whatever the density.

  /// The paper's printed values: they cannot follow a moving hand (see Documentation/Method.md).
  static GradientStepsParameters paper() { return {}; }
  /// Gains that track a hand at 50 mm/s.
  static GradientStepsParameters tuned();

  static constexpr auto members()
  {
    using S = GradientStepsParameters;
    const auto within = [](double minimum, double maximum) {
      return SettingOption{ nullptr, "", "", { minimum, maximum } };
    };
    return std::make_tuple(settingsMember("freeGain", &S::freeGain, within(0.0, 1.0)),
      settingsMember("normalGain", &S::normalGain, within(0.0, 10.0)),
      settingsMember("tangentGain", &S::tangentGain, within(0.0, 1.0)),
      settingsMember("sinkTolerance", &S::sinkTolerance, within(0.0, 1.0)),
      settingsMember("stepPeriodSeconds", &S::stepPeriodSeconds, within(1e-7, 1.0)),
      settingsMember("maximumStepsPerTick", &S::maximumStepsPerTick, within(1.0, 10000.0)),
      settingsMember("largestStep", &S::largestStep, within(1e-6, 10.0)),
      settingsMember("normalizedByDensity", &S::normalizedByDensity));
  }
};
static_assert(listsEveryMember<GradientStepsParameters>());

/// Limits of the force whatever the proxy answers; newtons and newtons per second.
struct ForceLimits
{
  double maximumForce = 8.0; ///< Clamp of |f|, 0 to infinity; the Falcon's drive ends near 8 N.
  double maximumSlewRate =
    4000.0; ///< |df/dt|, 0 to infinity: at 1 kHz the force grows by at most 4 N a tick.
  /// Ok, or InvalidParameter where a limit is negative or NaN.
  Status check() const noexcept;
};

/// The parameters of a Proxy: method, contact and gains.
struct HapticParameters
{
  ProxyMethod method = ProxyMethod::SurfaceFit;
  ContactParameters contact;
  GradientStepsParameters gradientSteps = GradientStepsParameters::tuned();
  /// Ok, or InvalidParameter where a value is outside its range or not finite.
  Status check() const noexcept;

  static constexpr auto members()
  {
    using S = HapticParameters;
    return std::make_tuple(
      settingsMember("method", &S::method,
        { "--method",
          "How the proxy meets the surface: a fit (the default), a sphere among the points, or the paper's "
          "steps" }),
      settingsMember("contact", &S::contact),
      settingsMember("gradientSteps", &S::gradientSteps,
        { "--preset", "Gains of --method gradient-steps; default tuned, paper for the printed ones" }));
  }
};
static_assert(listsEveryMember<HapticParameters>());

} // namespace pointhaptics
