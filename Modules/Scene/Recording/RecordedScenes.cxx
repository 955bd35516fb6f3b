#include "Replay.h"

#include "HapticSceneBuilder.h"
#include "LocalSceneProvider.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics
{

struct RecordedScenes::Maker
{
  vtkNew<vtkMatrix4x4> matrix;
  vtkNew<vtkVoxelMeanResampler> resampler;
  LocalSceneProvider local;

  explicit Maker(vtkPointSet* cloud)
  {
    const auto copyOf = [cloud]
    {
      auto copy = vtkSmartPointer<vtkPointSet>::Take(cloud->NewInstance());
      copy->SetPoints(cloud->GetPoints());
      return copy;
    };
    vtkNew<vtkMatrixToLinearTransform> transform;
    transform->SetInput(matrix);
    resampler->SetTransform(transform);
    resampler->SetInputDataObject(copyOf());
    local.setCloud(copyOf());
  }

  std::shared_ptr<const HapticScene> makeWhole(const SceneOrigin& origin)
  {
    setElements(matrix, origin.modelToWorkspace);
    resampler->SetSettings(origin.voxels);
    resampler->Update();
    Status status = Status::Ok;
    return makeHapticScene(
      resampler->GetOutput(), status, origin.useCovariance, origin.bandwidth, &origin.voxels);
  }
};

RecordedScenes::RecordedScenes(const Recording& recording, vtkPointSet* cloud)
  : recording_(recording)
  , maker_(std::make_unique<Maker>(cloud))
{
}

RecordedScenes::~RecordedScenes() = default;

/// As it was made, before it was moved.
std::shared_ptr<const HapticScene> RecordedScenes::cloudOf(std::uint64_t number)
{
  const auto known = clouds_.find(number);
  if (known != clouds_.end())
  {
    return known->second;
  }
  const auto origin = recording_.clouds.find(number);
  if (origin == recording_.clouds.end())
  {
    return nullptr;
  }
  const SceneOrigin& how = *origin->second;
  const bool isPart = how.kind != SceneOrigin::Kind::Whole;
  const auto global = isPart && how.globalCloud != 0 ? this->cloudOf(how.globalCloud) : nullptr;
  return clouds_[number] = !isPart   ? maker_->makeWhole(how)
    : global || how.globalCloud == 0 ? maker_->local.make(how, global)
                                     : nullptr;
}

/// Forgets the scenes that @p event does not use: they would be made again.
void RecordedScenes::keepThoseOf(const RecordedEvent& event)
{
  const auto origin = recording_.clouds.find(event.number);
  const std::uint64_t global = origin == recording_.clouds.end() ? 0 : origin->second->globalCloud;
  for (auto cloud = clouds_.begin(); cloud != clouds_.end();)
  {
    const bool isUsed =
      cloud->first == event.number || cloud->first == event.fallback || cloud->first == global;
    cloud = isUsed ? std::next(cloud) : clouds_.erase(cloud);
  }
}

bool RecordedScenes::make(
  const RecordedEvent& event, std::shared_ptr<const HapticScene>& scene, std::string& message)
{
  scene.reset();
  this->keepThoseOf(event);
  if (event.number == 0)
  {
    return true;
  }
  Status status = Status::Ok;
  scene = this->cloudOf(event.number);
  if (scene && event.fallback != 0 && recording_.clouds.at(event.number)->globalCloud != event.fallback)
  {
    const std::shared_ptr<const HapticScene> global = this->cloudOf(event.fallback);
    scene = global ? scene->withFallback(*global, status) : nullptr;
  }
  if (scene && !(scene->modelToWorkspace() == event.model))
  {
    scene = scene->moved(event.model, status);
  }
  if (!scene)
  {
    message = fmt::format("tick {}: the scene cannot be made again{}; was the header changed?", event.tick,
      status == Status::Ok ? "" : std::string(": ") + pointhaptics::message(status));
  }
  return scene != nullptr;
}

} // namespace pointhaptics
