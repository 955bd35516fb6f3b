/// @file
/// Every constant of the haptic rendering that a user may set, with its unit, default and range.
#pragma once

#include "Core/Base/SettingsMembers.h"
#include "Core/Base/Status.h"

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
  /// Viscous damping of the device, N s/m, 0 to 1e3; 0: unknown. It is for programs that step a Proxy without
  /// ServoLoop, which refuses such springs by HapticPort::limits(). Where it is known the stiffness is kept
  /// at largestPassiveStiffness(), here 2 (deviceDamping - damping) / T, T the tick.
  double deviceDamping = 0.0;
  /// F, N: the force never exceeds it; above 0, infinity: none, for virtual time only. The spring has its
  /// full force up to F/K, the limit from there to twice the hold length (F/K, within 5 and 15 mm), and fades
  /// to nothing at three times that. There contact ends where no point is within 10 mm of the hand. A servo
  /// loop lowers it to what the device declares.
  double forceLimit = 8.0;

  static constexpr auto members()
  {
    using S = ContactParameters;
    return std::make_tuple(settingsMember("stiffness", &S::stiffness), settingsMember("damping", &S::damping),
      settingsMember("staticFriction", &S::staticFriction),
      settingsMember("dynamicFriction", &S::dynamicFriction), settingsMember("settleRate", &S::settleRate),
      settingsMember("deviceDamping", &S::deviceDamping), settingsMember("forceLimit", &S::forceLimit));
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
    return std::make_tuple(settingsMember("freeGain", &S::freeGain),
      settingsMember("normalGain", &S::normalGain), settingsMember("tangentGain", &S::tangentGain),
      settingsMember("sinkTolerance", &S::sinkTolerance),
      settingsMember("stepPeriodSeconds", &S::stepPeriodSeconds),
      settingsMember("maximumStepsPerTick", &S::maximumStepsPerTick),
      settingsMember("largestStep", &S::largestStep),
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
    return std::make_tuple(settingsMember("method", &S::method), settingsMember("contact", &S::contact),
      settingsMember("gradientSteps", &S::gradientSteps));
  }
};
static_assert(listsEveryMember<HapticParameters>());

} // namespace pointhaptics
