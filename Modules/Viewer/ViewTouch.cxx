#include "ViewTouch.h"

#include "HapticViewerOptions.h"
#include "ViewScene.h"
#include "VirtualTouch.h"

#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Boxes.h"
#include "Devices/PathUnits.h"

#include <vtkPointSet.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{

std::vector<ServoSample> samplesAlong(const HipPath& path, std::int64_t ticks, FeelScenes& scenes,
  const HapticParameters& parameters, double rateHz)
{
  std::vector<ServoSample> samples;
  samples.reserve(std::size_t(ticks));
  feelPath(parameters, scenes, path, rateHz, ticks,
    [&samples](double time, const VirtualTouch& touch)
    {
      samples.push_back(touch.sample());
      samples.back().timeSeconds = time;
      return true;
    });
  return samples;
}

bool makeFeelScenes(
  ViewScene& scene, const HapticViewerOptions& options, FeelScenes& scenes, std::string& message)
{
  Status status = Status::Ok;
  auto whole = scene.makeScene(options.voxels.computeCovariance, status);
  if (!whole)
  {
    message = std::string("the cloud cannot be felt: ") + pointhaptics::message(status);
    return false;
  }
  const LatticeSettings& lattice = scene.resampler()->GetSettings().lattice;
  FeelSceneSettings settings;
  settings.bandwidth = options.bandwidth;
  settings.workspace = lattice.automaticWorkspace ? Bounds() : lattice.workspace;
  settings.useCovariance = options.voxels.computeCovariance;
  settings.refineNearHand = !options.hasVoxels() && settings.useCovariance;
  auto* cloud = vtkPointSet::SafeDownCast(scene.resampler()->GetInputDataObject(0, 0));
  scenes.adopt(std::move(whole), cloud ? cloud->GetPoints() : nullptr, settings);
  return true;
}

const ServoSample& mostTelling(const std::vector<ServoSample>& samples)
{
  const ServoSample* best = &samples.back();
  double largest = 0.0;
  for (const ServoSample& sample : samples)
  {
    const double force = norm(sample.state.force);
    if (sample.state.contact && force > largest)
    {
      largest = force;
      best = &sample;
    }
  }
  return *best;
}

std::string unlikelyUnitsIn(
  ViewScene& scene, const HapticViewerOptions& options, const HipPath& path, bool isTouched)
{
  AffineTransform model;
  const Bounds& box = scene.cloudBounds();
  const bool isPlaced = !box.empty() && affineFromTransform(scene.resampler()->GetTransform(), model);
  return unlikelyUnits(path,
    isPlaced ? boxOfCorners(box, [&model](const Vec3& p) { return model.apply(p); }) : Bounds(),
    options.names.units, isTouched || options.unitIsChosen);
}

std::shared_ptr<IdealForce> idealFor(ViewScene& scene, const HapticViewerOptions& options)
{
  Shape shape = Shape::Plane;
  vtkPointSet* cloud = vtkPointSet::SafeDownCast(scene.resampler()->GetInputDataObject(0, 0));
  if (options.ideal == "none" || !cloud || !cloud->GetPoints())
  {
    return nullptr;
  }
  const bool known = options.ideal == "auto" ? recognizeShape(PointAccess(cloud->GetPoints()).view(), shape)
                                             : shapeFromName(options.ideal, shape);
  return known ? std::make_shared<IdealForce>(shape) : nullptr;
}

double idealForce(
  IdealForce& ideal, const AffineTransform& model, const Vec3& hip, const ContactParameters& contact)
{
  return std::min(ideal.at(hip, model, contact.stiffness), contact.forceLimit);
}

double idealForce(IdealForce& ideal, ViewScene& scene, const Vec3& hip, const ContactParameters& contact)
{
  AffineTransform model;
  const bool isAffine = affineFromTransform(scene.resampler()->GetTransform(), model);
  return isAffine ? idealForce(ideal, model, hip, contact) : NAN;
}

std::string traceColumns()
{
  std::string columns;
  for (const char* column : kFeltColumns)
  {
    // The time of a tick stays the last column.
    columns += column == kFeltColumns.back() ? ",status" : "";
    columns += (columns.empty() ? "" : ",") + std::string(column);
  }
  return columns;
}

void addTrace(CsvWriter& trace, const std::vector<ServoSample>& samples)
{
  for (const ServoSample& sample : samples)
  {
    const auto felt = feltRow(sample.timeSeconds, sample);
    std::array<double, kFeltColumns.size() + 1> row;
    std::copy(felt.begin(), felt.end() - 1, row.begin());
    row[felt.size() - 1] = double(sample.state.status);
    row.back() = felt.back();
    trace.row(row.data(), row.size());
  }
}

} // namespace pointhaptics
