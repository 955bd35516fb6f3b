#include "RecordedScenes.h"

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
  const auto use = [this](std::uint64_t number, const RecordedEvent& event)
  {
    lastUse_[number] = &event;
    const auto origin = recording_.clouds.find(number);
    if (origin != recording_.clouds.end() && origin->second->globalCloud != 0)
    {
      lastUse_[origin->second->globalCloud] = &event;
    }
  };
  for (const RecordedEvent& event : recording.events)
  {
    if (event.kind == RecordedEvent::Kind::Scene)
    {
      use(event.number, event);
      use(event.fallback, event);
    }
  }
}

RecordedScenes::~RecordedScenes() = default;

bool RecordedScenes::isOf(const Recording& recording, vtkPointSet* cloud, std::string& message)
{
  const RecordedFiles& felt = recording.header.cloud;
  const vtkIdType points = cloud ? cloud->GetNumberOfPoints() : 0;
  if (points != felt.points)
  {
    message = fmt::format("it has {} points, and the recording was made with {}; give that cloud ({})",
      points, felt.points, felt.files.front());
    return false;
  }
  if (checksumOf(cloud) != felt.checksum)
  {
    message =
      fmt::format("its points are others than those the recording was made with; give that cloud ({})",
        felt.files.front());
    return false;
  }
  return true;
}

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
  std::shared_ptr<const HapticScene> made;
  if (origin->second->kind == SceneOrigin::Kind::Whole)
  {
    made = maker_->makeWhole(*origin->second);
  }
  else if (origin->second->globalCloud == 0)
  {
    made = maker_->local.make(*origin->second, nullptr);
  }
  else if (const std::shared_ptr<const HapticScene> global = this->cloudOf(origin->second->globalCloud))
  {
    made = maker_->local.make(*origin->second, global);
  }
  clouds_[number] = made;
  return made;
}

void RecordedScenes::forgetBefore(const RecordedEvent& event)
{
  for (auto cloud = clouds_.begin(); cloud != clouds_.end();)
  {
    const auto last = lastUse_.find(cloud->first);
    const bool isOver = last == lastUse_.end() || last->second < &event;
    cloud = isOver ? clouds_.erase(cloud) : std::next(cloud);
  }
}

bool RecordedScenes::make(
  const RecordedEvent& event, std::shared_ptr<const HapticScene>& scene, std::string& message)
{
  scene.reset();
  this->forgetBefore(event);
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
