#include "Benchmark/Bandwidth/Clouds.h"
#include "Benchmark/Bandwidth/Studies.h"

#include "SmpExecutor.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Haptics/HapticScene.h"
#include "Haptics/Proxy.h"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <utility>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

constexpr double kEdge = 0.1; ///< Of the workspace.
constexpr int kDimension = 300;
/// The hand goes down on the top of the statue, so deep and so fast.
constexpr int kMostTicks = 100;
constexpr double kStep = 2e-4;

enum class Radii
{
  All,    ///< An array for every mean, as a picture of the radii needs it.
  Needed, ///< Those the scene needs.
  None,   ///< No rule at all: 2.8 spacings.
};

/// From points in memory to the first tick in contact.
class Touch
{
public:
  Touch(const NamedCloud& cloud, Radii radii)
    : radii_(radii)
    , resampler_(vtkSmartPointer<vtkVoxelMeanResampler>::New())
    , filter_(vtkSmartPointer<vtkKernelBandwidthFilter>::New())
  {
    resampler_->SetInputData(cloud.polyData);
    const double half = 0.5 * kEdge;
    resampler_->SetWorkspaceBounds(-half, half, -half, half, -half, half);
    resampler_->SetDimensions(kDimension, kDimension, kDimension);
    filter_->SetInputConnection(resampler_->GetOutputPort());
    filter_->ComputeDensityOff();
    filter_->ComputeBandwidthOff();
    filter_->SetComputeProxyRadius(radii == Radii::All);
  }
  void run()
  {
    filter_->Update();
    Status status = Status::Ok;
    scene_ = HapticScene::create(inputOf(filter_->GetOutput()), status, SmpExecutor());
    state_ = ProxyState();
    Proxy proxy;
    proxy.setScene(scene_.get());
    Vec3 hip = scene_->bounds().center();
    hip.z = scene_->bounds().maximum.z + 10.0 * kStep;
    for (int tick = 0; tick < kMostTicks && !state_.contact; ++tick)
    {
      state_ = proxy.step(hip, 0.001);
      hip.z -= kStep;
    }
  }
  const ProxyState& state() const { return state_; }

private:
  HapticSceneInput inputOf(vtkPolyData* means) const
  {
    HapticSceneInput input;
    input.points.resize(std::size_t(means->GetNumberOfPoints()));
    for (std::size_t i = 0; i < input.points.size(); ++i)
    {
      means->GetPoint(vtkIdType(i), &input.points[i].x);
    }
    vtkDataArray* counts = means->GetPointData()->GetArray("VoxelPointCount");
    for (vtkIdType i = 0; i < counts->GetNumberOfTuples(); ++i)
    {
      input.counts.push_back(counts->GetComponent(i, 0));
    }
    if (radii_ == Radii::All)
    {
      auto* array = vtkDoubleArray::SafeDownCast(means->GetPointData()->GetArray("ProxyRadius"));
      input.proxyRadii.assign(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
    }
    if (radii_ == Radii::Needed)
    {
      input.bandwidth = filter_->GetSettings();
    }
    input.cellSize = kEdge / kDimension;
    return input;
  }

  Radii radii_;
  vtkSmartPointer<vtkVoxelMeanResampler> resampler_;
  vtkSmartPointer<vtkKernelBandwidthFilter> filter_;
  std::shared_ptr<const HapticScene> scene_;
  ProxyState state_;
};

} // namespace

ReportPart studyTouch(StudyContext& context)
{
  const NamedCloud cloud = shapeCloud(Shape::Idol, context.options.latticePoints);
  context.progress(fmt::format("first touch of {} points", cloud.size()));
  ReportPart part;
  part.title = "From the cloud to the first touch";
  part.text = fmt::format("{} points of the statue in memory, {} threads: mean resampling into {}^3 voxels, "
                          "radii, the scene, and the "
                          "ticks of the proxy down to the first contact. A scene needs the radii at its "
                          "nodes only, a few in a hundred of "
                          "the points; it is the same, bit for bit, as with the radii of all points.",
    grouped(cloud.size()), context.mostThreads(), kDimension);
  part.table.header = { "radii", "median ms", "quartiles ms", "x needed", "proxy radius mm", "answer" };
  const std::pair<const char*, Radii> settings[] = { { "those the scene needs", Radii::Needed },
    { "of all points", Radii::All }, { "no rule: 2.8 spacings", Radii::None } };
  std::vector<Touch> touches;
  for (const auto& setting : settings)
  {
    touches.emplace_back(cloud, setting.second);
  }
  std::vector<Contestant> contestants;
  for (Touch& touch : touches)
  {
    Contestant contestant;
    contestant.before = [points = cloud.polyData] { points->Modified(); };
    contestant.run = [&touch] { touch.run(); };
    contestants.push_back(std::move(contestant));
  }
  const std::vector<Lap> laps = timed(contestants, context.mostThreads(), context, 0.7);
  for (std::size_t i = 0; i < touches.size(); ++i)
  {
    const ProxyState& state = touches[i].state();
    const Quartiles seconds = quartiles(laps[i].seconds);
    const Quartiles times = pairedRatios(laps[i].seconds, laps[0].seconds);
    const bool sameAsNeeded = state.contact && state.radius == touches[0].state().radius;
    const bool right = settings[i].second == Radii::None ? state.contact : sameAsNeeded;
    context.allRight = context.allRight && right;
    part.table.rows.push_back({ settings[i].first, milliseconds(seconds.median), quartilesText(seconds),
      brief(times.median), brief(1e3 * state.radius), right ? "right" : "wrong" });
    part.rows.push_back({ { "radii", settings[i].first }, { "points", cloud.size() },
      { "threads", context.mostThreads() }, { "median_seconds", seconds.median },
      { "times_needed", times.median }, { "proxy_radius", state.radius }, { "right", right } });
  }
  return part;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
