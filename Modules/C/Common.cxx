#include "C/Handles.h"

#include <fmt/format.h>

#include <array>
#include <new>

#include <pthread.h>

namespace pointhaptics::c
{
namespace
{

static_assert(PH_EMPTY == int(Status::Empty) && PH_INVALID_PARAMETER == int(Status::InvalidParameter) &&
    PH_STOPPED == int(Status::Aborted) && PH_OUT_OF_MEMORY == int(Status::OutOfMemory),
  "the statuses are Core's");
static_assert(PH_SURFACE_FIT == int(ProxyMethod::SurfaceFit) &&
    PH_GRADIENT_STEPS == int(ProxyMethod::GradientSteps) && PH_SPHERE == int(ProxyMethod::Sphere),
  "the methods are those of Haptics");

GradientStepsParameters gainsOf(const ph_gains& gains)
{
  GradientStepsParameters result;
  result.freeGain = gains.free_gain;
  result.normalGain = gains.normal_gain;
  result.tangentGain = gains.tangent_gain;
  result.sinkTolerance = gains.sink_tolerance;
  result.stepPeriodSeconds = gains.step_period;
  result.maximumStepsPerTick = gains.maximum_steps;
  result.largestStep = gains.largest_step;
  result.normalizedByDensity = gains.normalized_by_density != 0;
  return result;
}

} // namespace

std::string* textOfThread(ThreadText which) noexcept
{
  // Variables of a thread with a destructor end the process where there is no memory for them.
  using Texts = std::array<std::string, 2>;
  static pthread_key_t key;
  static const bool hasKey =
    pthread_key_create(&key, [](void* texts) { delete static_cast<Texts*>(texts); }) == 0;
  auto* texts = hasKey ? static_cast<Texts*>(pthread_getspecific(key)) : nullptr;
  if (hasKey && !texts)
  {
    texts = new (std::nothrow) Texts;
    if (texts && pthread_setspecific(key, texts) != 0)
    {
      delete texts;
      texts = nullptr;
    }
  }
  return texts ? &(*texts)[std::size_t(which)] : nullptr;
}

int fail(int status, std::string_view text) noexcept
{
  std::string* problem = textOfThread(ThreadText::Problem);
  try
  {
    if (problem)
    {
      *problem = text;
    }
  }
  catch (const std::exception&)
  {
    problem->clear(); // no memory for the sentence
  }
  return status;
}

bool parametersOf(const ph_proxy_options* given, HapticParameters& parameters)
{
  const ph_proxy_options options = optionsOf(given);
  ContactParameters& contact = parameters.contact;
  parameters.method = static_cast<ProxyMethod>(options.method);
  if (options.stiffness != 0.0)
  {
    contact.stiffness = options.stiffness < 0.0 ? 0.0 : options.stiffness;
  }
  contact.damping = options.damping;
  contact.staticFriction = options.mu_s != 0.0 ? options.mu_s : options.mu_d;
  contact.dynamicFriction = options.mu_d;
  if (options.force_limit != 0.0)
  {
    contact.forceLimit = options.force_limit;
  }
  if (options.gains)
  {
    parameters.gradientSteps = gainsOf(optionsOf(options.gains));
  }
  if (options.method < PH_SURFACE_FIT || options.method > PH_SPHERE)
  {
    fail(PH_INVALID_PARAMETER,
      fmt::format("method {}; give {}, {} or {}", options.method, int(PH_SURFACE_FIT), int(PH_GRADIENT_STEPS),
        int(PH_SPHERE)));
    return false;
  }
  const bool isValid = parameters.check() == Status::Ok;
  if (!isValid)
  {
    fail(PH_INVALID_PARAMETER,
      fmt::format(
        "stiffness {} N/m, damping {} N s/m, mu_s {}, mu_d {}, force_limit {} N, or a gain; give 0 to "
        "1e5, 0 to 1e3, 0 to 10, 0 to mu_s, above 0, and gains in the ranges of "
        "GradientStepsParameters",
        contact.stiffness, contact.damping, contact.staticFriction, contact.dynamicFriction,
        contact.forceLimit));
  }
  return isValid;
}

} // namespace pointhaptics::c

using namespace pointhaptics;
using namespace pointhaptics::c;

const char* ph_version(void)
{
  return POINTHAPTICS_VERSION;
}

const char* ph_message(int status)
{
  return message(static_cast<Status>(status));
}

const char* ph_problem(void)
{
  const std::string* problem = textOfThread(ThreadText::Problem);
  return problem ? problem->c_str() : message(Status::OutOfMemory);
}

int ph_stop_create(ph_stop** out)
{
  return guarded({ out },
    [&]
    {
      *out = new ph_stop;
      return PH_OK;
    });
}

void ph_stop_request(ph_stop* stop)
{
  if (stop)
  {
    stop->requested = true;
  }
}

void ph_stop_destroy(ph_stop* stop)
{
  delete stop;
}

int ph_gains_of(int preset, ph_gains* out)
{
  if (hasNull({ out }))
  {
    return PH_INVALID_PARAMETER;
  }
  if (preset != PH_TUNED && preset != PH_PAPER)
  {
    return guarded(
      [&]
      {
        return fail(
          PH_INVALID_PARAMETER, fmt::format("preset {}; give {}, tuned, or {}, the paper's", preset, 0, 1));
      });
  }
  const GradientStepsParameters gains =
    preset == PH_PAPER ? GradientStepsParameters::paper() : GradientStepsParameters::tuned();
  const ph_gains all = { out->struct_size, gains.freeGain, gains.normalGain, gains.tangentGain,
    gains.sinkTolerance, gains.stepPeriodSeconds, gains.largestStep, gains.maximumStepsPerTick,
    gains.normalizedByDensity };
  std::memcpy(out, &all, std::min(out->struct_size, sizeof all));
  return PH_OK;
}

void ph_set_interpreter_lock(int (*is_held)(void), void* (*release)(void), void (*take)(void*),
  int (*is_ending)(void), int (*run_handlers)(void))
{
  setInterpreterLock({ is_held, release, take, is_ending, run_handlers });
}

void ph_end_interpreter(void)
{
  endInterpreter();
}
