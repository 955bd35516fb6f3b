#include "C/Handles.h"

#include "VirtualTouch.h"
#include "vtkVoxelMeanResampler.h"

#include "Devices/PathUnits.h"

#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <new>

using namespace pointhaptics;
using namespace pointhaptics::c;

namespace
{

/// Steps between two looks at a stop.
constexpr std::int64_t kStepsBetweenLooks = 64;
/// Stands for what nobody looks at.
constexpr double kNothing = 0.0;

bool isGiven(const double* numbers, std::size_t count)
{
  return std::any_of(numbers, numbers + count, [](double number) { return number != 0.0; });
}

int createScene(vtkDataArray* xyz, const ph_scene_options* given, ph_scene** out)
{
  const ph_scene_options options = optionsOf(given);
  vtkNew<vtkPoints> points;
  points->SetData(xyz);
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkVoxelMeanResampler> resampler;
  if (options.voxel != 0.0)
  {
    resampler->SetVoxelSize(options.voxel);
  }
  const bool hasDims = options.dims[0] != 0 || options.dims[1] != 0 || options.dims[2] != 0;
  if (hasDims)
  {
    resampler->SetDimensions(options.dims);
  }
  if (isGiven(options.workspace, 6))
  {
    resampler->SetWorkspaceBounds(options.workspace);
  }
  FeelSceneSettings settings;
  settings.refineNearHand = options.voxel == 0.0 && !hasDims;
  settings.goesOn = [&options](double) { return !isStopped(options.stop); };
  auto scenes = std::make_shared<FeelScenes>();
  std::string message;
  if (isStopped(options.stop))
  {
    return fail(Status::Aborted);
  }
  const Status status = scenes->resample(cloud, resampler, settings, message);
  if (status != Status::Ok)
  {
    return fail(status, message);
  }
  *out = new ph_scene{ scenes };
  return PH_OK;
}

/// False: the problem was passed to fail().
bool countSteps(const HipPath& path, double rate, std::int64_t& steps)
{
  std::string message =
    rate >= 1.0 && rate <= 1e5 ? "" : "rate: " + std::to_string(rate) + " Hz; give 1 to 1e5";
  const bool isValid = message.empty() && countTicks(path, "path", rate, kMostTicks, steps, message);
  return isValid || fail(PH_INVALID_PARAMETER, message) == PH_OK;
}

} // namespace

bool pointhaptics::c::readPath(const double* rows, std::size_t count, HipPath& path)
{
  path.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double* v = rows + 4 * i;
    path.points.push_back({ v[0], { v[1], v[2], v[3] } });
  }
  const std::string problem = path.problem();
  return problem.empty() || fail(PH_INVALID_PARAMETER, problem) == PH_OK;
}

int ph_scene_create(const double* xyz, size_t count, const ph_scene_options* options, ph_scene** out)
{
  return guarded({ out, count > 0 ? xyz : &kNothing },
    [&]
    {
      vtkNew<vtkDoubleArray> array;
      array->SetNumberOfComponents(3);
      array->SetArray(const_cast<double*>(xyz), vtkIdType(3 * count), 1); // not written to
      return createScene(array, options, out);
    });
}

int ph_scene_create_float(
  const float* xyz, size_t count, size_t stride, const ph_scene_options* options, ph_scene** out)
{
  return guarded({ out, count > 0 ? static_cast<const void*>(xyz) : &kNothing },
    [&]
    {
      vtkNew<vtkFloatArray> array;
      array->SetNumberOfComponents(3);
      if (stride == 0 || stride == 3 * sizeof(float))
      {
        array->SetArray(const_cast<float*>(xyz), vtkIdType(3 * count), 1); // not written to
        return createScene(array, options, out);
      }
      array->SetNumberOfTuples(vtkIdType(count));
      for (std::size_t i = 0; i < count; ++i)
      {
        std::memcpy(array->GetPointer(vtkIdType(3 * i)), reinterpret_cast<const char*>(xyz) + i * stride,
          3 * sizeof(float));
      }
      return createScene(array, options, out);
    });
}

const char* ph_scene_note(const ph_scene* scene)
{
  return hasNull({ scene }) ? "" : scene->scenes->note().c_str();
}

void ph_scene_destroy(ph_scene* scene)
{
  delete scene;
}

int ph_feel_steps(const double* path, size_t count, double rate, size_t* steps)
{
  return guarded({ steps, count > 0 ? path : &kNothing },
    [&]
    {
      HipPath rows;
      std::int64_t number = 0;
      if (!readPath(path, count, rows) || !countSteps(rows, rate, number))
      {
        return int(PH_INVALID_PARAMETER);
      }
      *steps = std::size_t(number);
      return int(PH_OK);
    });
}

const char* ph_unlikely_units(const ph_scene* scene, const double* path, size_t count, int touched)
{
  std::string* odd = textOfThread(ThreadText::Units);
  if (!odd || hasNull({ scene, count > 0 ? path : &kNothing }))
  {
    return "";
  }
  const int status = guarded(
    [&]
    {
      HipPath hand;
      *odd = readPath(path, count, hand)
        ? unlikelyUnits(hand, scene->scenes->whole()->bounds(), {}, touched != 0)
        : std::string();
      return int(PH_OK);
    });
  return status == PH_OK ? odd->c_str() : "";
}

int ph_feel(const ph_scene* scene, const double* path, size_t count, double rate,
  const ph_proxy_options* options, const ph_stop* stop, double* rows)
{
  return guarded({ scene, rows, count > 0 ? path : &kNothing },
    [&]
    {
      FeelScenes scenes(*scene->scenes); // first: the scene may be destroyed from here on
      HapticParameters parameters;
      HipPath hand;
      std::int64_t steps = 0;
      if (!parametersOf(options, parameters) || !readPath(path, count, hand) ||
        !countSteps(hand, rate, steps))
      {
        return int(PH_INVALID_PARAMETER);
      }
      std::int64_t step = 0;
      feelPath(parameters, scenes, hand, rate, steps,
        [&](double time, const VirtualTouch& touch)
        {
          const auto row = feltRow(time, touch.sample());
          std::copy(row.begin(), row.end(), rows + PH_COLUMNS * step);
          return ++step % kStepsBetweenLooks != 0 || !isStopped(stop);
        });
      return step == steps ? int(PH_OK) : fail(Status::Aborted);
    });
}
