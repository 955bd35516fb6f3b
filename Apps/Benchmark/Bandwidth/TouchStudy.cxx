#include "Benchmark/Bandwidth/Clouds.h"
#include "Benchmark/Bandwidth/Studies.h"

#include "SceneWorker.h"
#include "SmpExecutor.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Haptics/HapticScene.h"
#include "Haptics/Proxy.h"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <condition_variable>
#include <functional>
#include <mutex>
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
/// Part by which radii may differ from those of the whole cloud.
constexpr double kRadiiAgree = 1e-3;

enum class RadiiWanted
{
  All,    ///< An array for every mean, as a picture of the radii needs it.
  Needed, ///< Those the scene needs.
  None,   ///< No rule at all: 2.8 spacings.
};

/// Above the middle of @p cloud.
Vec3 startAbove(const Bounds& cloud)
{
  Vec3 hip = cloud.center();
  hip.z = cloud.maximum.z + 10.0 * kStep;
  return hip;
}

/// The first state in contact of a hand that goes down from @p hip.
ProxyState goDown(const HapticScene& scene, Vec3 hip)
{
  Proxy proxy;
  proxy.setScene(&scene);
  ProxyState state;
  for (int tick = 0; tick < kMostTicks && !state.contact; ++tick)
  {
    state = proxy.step(hip, 0.001);
    hip.z -= kStep;
  }
  return state;
}

/// From points in memory to the first tick in contact.
class Touch
{
public:
  Touch(const NamedCloud& cloud, RadiiWanted radii)
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
    filter_->SetComputeProxyRadius(radii == RadiiWanted::All);
  }
  void run()
  {
    filter_->Update();
    Status status = Status::Ok;
    scene_ = HapticScene::create(inputOf(filter_->GetOutput()), status, SmpExecutor());
    state_ = goDown(*scene_, startAbove(scene_->bounds()));
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
    if (radii_ == RadiiWanted::All)
    {
      auto* array = vtkDoubleArray::SafeDownCast(means->GetPointData()->GetArray("ProxyRadius"));
      input.proxyRadii.assign(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
    }
    if (radii_ == RadiiWanted::Needed)
    {
      input.bandwidth = filter_->GetSettings();
    }
    input.cellSize = kEdge / kDimension;
    return input;
  }

  RadiiWanted radii_;
  vtkSmartPointer<vtkVoxelMeanResampler> resampler_;
  vtkSmartPointer<vtkKernelBandwidthFilter> filter_;
  std::shared_ptr<const HapticScene> scene_;
  ProxyState state_;
};

/// The same through what makes the scenes of a window, which has the hand near the statue or does not know
/// where it is.
class WindowTouch
{
public:
  WindowTouch(const NamedCloud& cloud, bool knowsHand)
    : cloud_(cloud.polyData)
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    const double half = 0.5 * kEdge;
    resampler->SetWorkspaceBounds(-half, half, -half, half, -half, half);
    resampler->SetDimensions(kDimension, kDimension, kDimension);
    resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    resampler->ComputeCovarianceOn();
    vtkNew<vtkKernelBandwidthFilter> filter;
    request_ = SceneRequest::of(resampler, filter);
    double box[6];
    cloud_->GetBounds(box);
    Bounds bounds;
    bounds.include({ box[0], box[2], box[4] });
    bounds.include({ box[1], box[3], box[5] });
    start_ = startAbove(bounds);
    Bounds hand;
    hand.include(start_);
    if (knowsHand)
    {
      request_.hand = [hand] { return hand; };
    }
    request_.publish = [this](std::shared_ptr<const HapticScene> scene, std::uint64_t)
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      first_ = first_ ? first_ : std::move(scene);
      changed_.notify_all();
    };
  }
  /// Nothing of the last run goes on.
  void rest()
  {
    worker_.wait();
    const std::lock_guard<std::mutex> lock(mutex_);
    first_.reset();
  }
  void run()
  {
    worker_.setCloud(cloud_);
    worker_.request(request_);
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return first_ != nullptr; });
    state_ = goDown(*first_, start_);
  }
  const ProxyState& state() const { return state_; }

private:
  vtkSmartPointer<vtkPolyData> cloud_;
  SceneRequest request_;
  Vec3 start_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<const HapticScene> first_;
  ProxyState state_;
  SceneWorker worker_; ///< Last: it ends first.
};

/// What a row is of.
struct Way
{
  const char* name;
  std::function<void()> run;
  std::function<const ProxyState&()> state;
};

} // namespace

ReportPart studyTouch(StudyContext& context)
{
  const NamedCloud cloud = shapeCloud(Shape::Idol, context.options.latticePoints);
  context.progress(fmt::format("first touch of {} points", cloud.size()));
  ReportPart part;
  part.title = "From the cloud to the first touch";
  part.text = fmt::format("{} points of the statue in memory, {} threads: mean resampling into {}^3 voxels, "
                          "radii, the scene, and the ticks of the proxy down to the first contact. A scene "
                          "needs the radii at its nodes only, a few in a hundred of the points; it is the "
                          "same, bit for bit, as with the radii of all points. A window feels second moments "
                          "too; it makes what is near the hand first, and the whole cloud after that.",
    grouped(cloud.size()), context.mostThreads(), kDimension);
  part.table.header = { "radii", "median ms", "quartiles ms", "x needed", "proxy radius mm", "answer" };
  Touch needed(cloud, RadiiWanted::Needed);
  Touch all(cloud, RadiiWanted::All);
  Touch none(cloud, RadiiWanted::None);
  WindowTouch near(cloud, true);
  WindowTouch whole(cloud, false);
  const auto wayOf = [](const char* name, auto& touch)
  {
    return Way{ name, [&touch] { touch.run(); }, [&touch]() -> const ProxyState& { return touch.state(); } };
  };
  const std::vector<Way> ways{ wayOf("those the scene needs", needed), wayOf("of all points", all),
    wayOf("no rule: 2.8 spacings", none), wayOf("in a window, near the hand first", near),
    wayOf("in a window, the whole cloud", whole) };
  std::vector<Contestant> contestants;
  for (const Way& way : ways)
  {
    Contestant contestant;
    contestant.before = [&near, &whole, points = cloud.polyData]
    {
      points->Modified();
      near.rest(); // the whole cloud is made after the first touch
      whole.rest();
    };
    contestant.run = way.run;
    contestants.push_back(std::move(contestant));
  }
  const std::vector<Lap> laps = timed(contestants, context.mostThreads(), context, 0.7);
  for (std::size_t i = 0; i < ways.size(); ++i)
  {
    const ProxyState& state = ways[i].state();
    const Quartiles seconds = quartiles(laps[i].seconds);
    const Quartiles times = pairedRatios(laps[i].seconds, laps[0].seconds);
    // The last two are of another scene: with second moments.
    const double radius = ways[i < 2 ? 0 : i < 3 ? 2 : 4].state().radius;
    const bool right = state.contact && std::abs(state.radius - radius) <= kRadiiAgree * radius;
    context.allRight = context.allRight && right;
    part.table.rows.push_back({ ways[i].name, milliseconds(seconds.median), quartilesText(seconds),
      brief(times.median), brief(1e3 * state.radius), right ? "right" : "wrong" });
    part.rows.push_back({ { "radii", ways[i].name }, { "points", cloud.size() },
      { "threads", context.mostThreads() }, { "median_seconds", seconds.median },
      { "times_needed", times.median }, { "proxy_radius", state.radius }, { "right", right } });
  }
  return part;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
