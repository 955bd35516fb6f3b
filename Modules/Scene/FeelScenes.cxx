#include "FeelScenes.h"

#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/StoppableThread.h"
#include "Core/Distributed/FarPoints.h"
#include "Core/Resample/TransformedBounds.h"
#include "Haptics/ServoLoop.h"

#include "vtkCallbackCommand.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <chrono>
#include <exception>
#include <new>
#include <thread>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Between two looks at where the hand is: 0.25 mm at 50 mm/s.
constexpr auto kLook = std::chrono::milliseconds(5);

/// Gives the resampler the lattice of feel and view: about the cloud without the points that are far from all
/// others. Finer scenes are counted from its corner. @return note on the far points; empty where there are
/// none.
std::string setLattice(vtkPoints* cloud, vtkVoxelMeanResampler* resampler)
{
  VoxelMeanSettings settings = resampler->GetSettings();
  AffineTransform transform;
  if (!cloud || !settings.lattice.automaticWorkspace ||
    !readTransform(resampler->GetTransform(), transform).empty())
  {
    return {};
  }
  const PointAccess points(cloud);
  const FarPoints far =
    findFarPoints(points.view(), transformedBounds(points.view(), transform, SmpExecutor()), transform);
  Lattice lattice;
  if (makeLattice(settings.lattice, far.others, lattice) != Status::Ok)
  {
    return {};
  }
  settings.lattice.workspace = lattice.bounds();
  settings.lattice.automaticWorkspace = false;
  resampler->SetSettings(settings);
  return far.count > 0 ? far.note() : std::string();
}

} // namespace

std::shared_ptr<const PointIndex> indexOf(vtkPoints* points)
{
  const auto index = std::make_shared<PointIndex>();
  return points && index->build(PointAccess(points).view(), SmpExecutor()) == Status::Ok ? index : nullptr;
}

void FeelScenes::adopt(std::shared_ptr<const HapticScene> whole, vtkPoints* cloud)
{
  const bool refines = whole && whole->origin();
  follower_ = LocalSceneFollower(std::move(whole), indexOf(refines ? cloud : nullptr));
}

void FeelScenes::publishNearHand(ServoLoop& loop, StoppableThread& thread)
{
  if (!follower_.cloud())
  {
    return;
  }
  thread.start(
    [this, &loop, &thread]
    {
      for (double lastLook = 0.0; !thread.stopIsRequested(); std::this_thread::sleep_for(kLook))
      {
        const ServoSample latest = loop.latest();
        const double seconds = latest.timeSeconds - std::exchange(lastLook, latest.timeSeconds);
        Bounds hand;
        hand.include(latest.state.hip);
        hand.include(latest.state.proxy);
        try
        {
          if (latest.tick > 0 && follower_.update(hand, seconds, SmpExecutor()))
          {
            loop.publishScene(follower_.scene());
          }
        }
        catch (const std::exception&)
        {
          // Without memory for a finer scene the one that is there goes on.
        }
      }
    });
}

namespace
{

/// Status of an update, and its @p message.
Status outcomeOf(vtkVoxelMeanResampler* resampler, std::string& message)
{
  message = resampler->GetErrorMessage();
  message.erase(message.find_last_not_of(" .") + 1);
  if (resampler->GetErrorCode() == kOutOfMemoryCode)
  {
    throw std::bad_alloc();
  }
  if (!message.empty())
  {
    return Status::InvalidParameter;
  }
  if (resampler->GetAbortExecute())
  {
    message = pointhaptics::message(Status::Aborted);
    return Status::Aborted;
  }
  if (resampler->GetOutput()->GetNumberOfPoints() == 0)
  {
    message = "no finite point lies in the workspace; mend points that are NaN, leave out the workspace, or "
              "mend the transform";
    return Status::Empty;
  }
  return Status::Ok;
}

}

Status FeelScenes::resample(vtkPointSet* cloud, vtkVoxelMeanResampler* resampler,
  const FeelSceneSettings& settings, std::string& message)
{
  auto* unit = vtkStringArray::SafeDownCast(cloud->GetFieldData()->GetAbstractArray("LengthUnit"));
  if (unit && unit->GetNumberOfValues() == 1 && unit->GetValue(0).rfind("deg", 0) == 0)
  {
    message =
      "x and y are degrees of longitude and latitude, which are no lengths; let the reader give local "
      "metres, or project the cloud";
    return Status::InvalidParameter;
  }
  // The input is a copy, as the original may belong to a pipeline that would update again.
  auto input = vtkSmartPointer<vtkPointSet>::Take(cloud->NewInstance());
  input->ShallowCopy(cloud);
  resampler->SetPassAttributes(false);
  resampler->SetComputeCovariance(settings.useCovariance);
  resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  note_ = setLattice(cloud->GetPoints(), resampler);
  resampler->SetInputData(input);
  // The caller reports the errors of the resampler and note().
  vtkNew<vtkCallbackCommand> silence;
  resampler->AddObserver(vtkCommand::ErrorEvent, silence);
  resampler->AddObserver(vtkCommand::WarningEvent, silence);
  std::function<bool(double)> goesOn = settings.goesOn;
  vtkNew<vtkCallbackCommand> progress;
  progress->SetClientData(&goesOn);
  progress->SetCallback(
    [](vtkObject* caller, unsigned long, void* asked, void*)
    {
      auto* filter = static_cast<vtkAlgorithm*>(caller);
      const auto& ask = *static_cast<const std::function<bool(double)>*>(asked);
      filter->SetAbortExecute(!ask || ask(filter->GetProgress()) ? 0 : 1);
    });
  resampler->AddObserver(vtkCommand::ProgressEvent, progress);
  resampler->Update();
  resampler->RemoveObserver(progress);
  vtkPolyData* felt = resampler->GetOutput();
  Status status = outcomeOf(resampler, message);
  if (status != Status::Ok)
  {
    return status;
  }
  // No picture is drawn: the scene computes the few radii it needs.
  auto whole =
    makeHapticScene(felt, status, settings.useCovariance, settings.bandwidth, &resampler->GetSettings());
  const bool refines = settings.refineNearHand && settings.useCovariance;
  this->adopt(std::move(whole), refines ? cloud->GetPoints() : nullptr);
  message = pointhaptics::message(status);
  return status;
}

} // namespace pointhaptics
