/// @file
/// Objects behind the handles of pointhaptics.h.
#pragma once

#include "C/pointhaptics.h"

#include "Core/Base/Host/GuardedWork.h"
#include "Devices/HipPath.h"
#include "FeelScenes.h"
#include "Haptics/HapticParameters.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

struct ph_stop
{
  std::atomic<bool> requested{ false };
};

struct ph_scene
{
  std::shared_ptr<const pointhaptics::FeelScenes> scenes;
};

namespace pointhaptics::c
{

enum class ThreadText
{
  Problem,
  Units
};
/// The text that the calling thread was given last; null where there is no memory for one.
std::string* textOfThread(ThreadText which) noexcept;
/// Keeps @p text for ph_problem().
int fail(int status, std::string_view text) noexcept;
/// @p text empty: the sentence of @p status.
inline int fail(Status status, std::string_view text = {}) noexcept
{
  return status == Status::Ok ? PH_OK : fail(int(status), text.empty() ? message(status) : text);
}
/// True if one of @p pointers is null, which is passed to fail() then.
inline bool hasNull(std::initializer_list<const void*> pointers) noexcept
{
  const bool isNull = std::find(pointers.begin(), pointers.end(), nullptr) != pointers.end();
  if (isNull)
  {
    fail(PH_INVALID_PARAMETER, "a pointer is null; give one to memory of the kind that pointhaptics.h names");
  }
  return isNull;
}
inline bool isStopped(const ph_stop* stop)
{
  return stop && stop->requested.load(std::memory_order_relaxed);
}

/// The status that @p work answers; one for each exception.
template <typename Work>
int guarded(Work&& work) noexcept
{
  try
  {
    int status = PH_OK;
    const Status end = guardedWork([&] { status = work(); });
    return end == Status::Ok ? status : fail(end);
  }
  catch (const std::exception& fault)
  {
    return fail(PH_INVALID_PARAMETER, fault.what());
  }
}

/// As guarded(work), where none of the pointers @p needed is null.
template <typename Work>
int guarded(std::initializer_list<const void*> needed, Work&& work) noexcept
{
  return hasNull(needed) ? int(PH_INVALID_PARAMETER) : guarded(work);
}

/// @p given, as far as the caller knows the struct; the rest is zero.
template <typename Options>
Options optionsOf(const Options* given)
{
  Options options{};
  if (given)
  {
    std::memcpy(&options, given, given->struct_size < sizeof options ? given->struct_size : sizeof options);
  }
  return options;
}

/// Rows t, x, y, z. False: nobody can follow them; the reason was passed to fail().
bool readPath(const double* rows, std::size_t count, HipPath& path);
/// False: one is out of range, and was passed to fail().
bool parametersOf(const ph_proxy_options* options, HapticParameters& parameters);

/// As guarded(needed, work), for work that takes the parameters of @p options.
template <typename Work>
int guardedWith(
  std::initializer_list<const void*> needed, const ph_proxy_options* options, Work&& work) noexcept
{
  return guarded(needed,
    [&]
    {
      HapticParameters parameters;
      return parametersOf(options, parameters) ? int(work(parameters)) : int(PH_INVALID_PARAMETER);
    });
}

} // namespace pointhaptics::c
