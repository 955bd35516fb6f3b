#include "SceneWorker.h"
#include "ScenePublisher.h"

#include "MadeClouds.h"
#include "SurfaceArrays.h"
#include "Unit/Eventually.h"

#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkMatrix4x4.h>
#include <vtkMatrixToLinearTransform.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

using namespace pointhaptics;

namespace
{

/// A wavy square of 6 cm, points so far apart.
vtkSmartPointer<vtkPolyData> makeCloud(double spacing = 0.0005)
{
  std::vector<Vec3> points;
  const int half = int(std::lround(0.03 / spacing));
  for (int i = -half; i <= half; ++i)
  {
    for (int j = -half; j <= half; ++j)
    {
      points.emplace_back(spacing * i, spacing * j, 0.002 * std::sin(200.0 * spacing * i));
    }
  }
  return trial::cloudOf(points);
}

/// The filters of a program, with the scenes that were published.
class SceneWorkerTest : public ::testing::Test
{
protected:
  SceneWorkerTest()
  {
    resampler_->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    resampler_->SetDimensions(80, 80, 80);
    resampler_->ComputeCovarianceOn();
    bandwidth_->SetRadiusScale(5.0);
    bandwidth_->ComputeDensityOn();
    worker_.setCloud(makeCloud());
  }

  SceneRequest shifted(double z)
  {
    SceneRequest request = SceneRequest::of(resampler_, bandwidth_);
    request.recipe.modelToWorkspace.m[2][3] = z;
    request.publish = [this](std::shared_ptr<const HapticScene> scene, std::uint64_t)
    {
      newest_ = std::move(scene); // the worker's until wait()
      ++published_;
    };
    return request;
  }

  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  std::shared_ptr<const HapticScene> newest_;
  std::atomic<int> published_{ 0 };
  SceneWorker worker_;
};

TEST_F(SceneWorkerTest, MakesWhatTheFiltersWouldMake)
{
  worker_.request(this->shifted(0.003));
  worker_.wait();
  BuiltScene built;
  ASSERT_TRUE(worker_.take(built));
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(2, 3, 0.003);
  vtkNew<vtkMatrixToLinearTransform> transform;
  transform->SetInput(matrix);
  resampler_->SetInputData(makeCloud());
  resampler_->SetTransform(transform);
  bandwidth_->SetInputConnection(resampler_->GetOutputPort());
  bandwidth_->Update();
  vtkPolyData* expected = bandwidth_->GetOutput();
  ASSERT_EQ(built.means->GetNumberOfPoints(), expected->GetNumberOfPoints());
  EXPECT_EQ(built.numberOfPoints, 121 * 121);
  for (const char* name : { "VoxelPointCount", "VoxelCovariance", "Bandwidth", "ProxyRadius", "Density" })
  {
    vtkDataArray* array = built.means->GetPointData()->GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    EXPECT_EQ(array->GetComponent(17, 0), expected->GetPointData()->GetArray(name)->GetComponent(17, 0))
      << name;
  }
  ASSERT_NE(newest_, nullptr);
  EXPECT_EQ(newest_->numberOfPoints(), std::size_t(expected->GetNumberOfPoints()));
  EXPECT_FALSE(worker_.take(built));
}

TEST_F(SceneWorkerTest, LetsGoOfThePictureBeforeItCanBeTaken)
{
  for (int i = 0; i < 100; ++i)
  {
    worker_.request(this->shifted(1e-5 * i));
    BuiltScene built;
    while (!worker_.take(built))
    {
    }
    // No reference stays behind in the worker's thread, not for a moment.
    ASSERT_EQ(built.means->GetReferenceCount(), 1) << "of build " << i;
  }
}

TEST_F(SceneWorkerTest, KeepsNoReferenceToTheCloudButToItsArrays)
{
  const vtkSmartPointer<vtkPolyData> cloud = makeCloud();
  const int references = cloud->GetPoints()->GetReferenceCount();
  worker_.setCloud(cloud);
  worker_.request(this->shifted(0.003));
  worker_.wait();
  EXPECT_EQ(cloud->GetReferenceCount(), 1);
  EXPECT_GT(cloud->GetPoints()->GetReferenceCount(), references);
  worker_.setCloud(nullptr);
  worker_.request(this->shifted(0.003));
  worker_.wait();
  EXPECT_EQ(cloud->GetPoints()->GetReferenceCount(), references);
}

TEST_F(SceneWorkerTest, AddsResidualsAndNormalsToThePictureOnRequest)
{
  for (const bool wanted : { false, true })
  {
    SceneRequest request = this->shifted(0.003);
    request.hasResiduals = wanted;
    request.hasNormals = wanted;
    worker_.request(std::move(request));
    worker_.wait();
    BuiltScene built;
    ASSERT_TRUE(worker_.take(built));
    vtkPointData* data = built.means->GetPointData();
    EXPECT_EQ(data->HasArray(kResidualArrayName) != 0, wanted);
    EXPECT_EQ(data->HasArray(kSurfaceNormalArrayName) != 0, wanted);
    EXPECT_NE(data->GetArray("Bandwidth"), nullptr);
  }
}

TEST_F(SceneWorkerTest, PublishesAllScenesWhileResidualsAreWanted)
{
  for (int i = 1; i <= 20; ++i)
  {
    SceneRequest request = this->shifted(1e-4 * i);
    request.hasResiduals = true;
    worker_.request(std::move(request));
  }
  worker_.wait();
  BuiltScene built;
  ASSERT_TRUE(worker_.take(built));
  EXPECT_EQ(built.number, 20u);
  EXPECT_TRUE(built.means->GetPointData()->HasArray(kResidualArrayName));
  ASSERT_NE(newest_, nullptr);
  EXPECT_NEAR(newest_->modelToWorkspace().m[2][3], 0.002, 1e-15);
}

TEST_F(SceneWorkerTest, EndsWithTheNewestOfManyRequests)
{
  for (int i = 1; i <= 200; ++i)
  {
    worker_.request(this->shifted(1e-5 * i));
  }
  worker_.wait();
  BuiltScene built;
  ASSERT_TRUE(worker_.take(built));
  EXPECT_EQ(built.number, 200u);
  EXPECT_EQ(built.modelToWorkspace.m[2][3], 1e-5 * 200);
  ASSERT_NE(newest_, nullptr);
  EXPECT_EQ(newest_->modelToWorkspace().m[2][3], 1e-5 * 200);
  EXPECT_LT(published_, 200); // those that were overtaken are not built
}

TEST_F(SceneWorkerTest, KeepsTheSettingsThatTheRequestWasMadeWith)
{
  SceneRequest request = this->shifted(0.0);
  resampler_->SetDimensions(10, 10, 10);
  bandwidth_->SetComputeBandwidth(false);
  worker_.request(std::move(request));
  worker_.wait();
  BuiltScene built;
  ASSERT_TRUE(worker_.take(built));
  EXPECT_GT(built.means->GetNumberOfPoints(), 1000);
  EXPECT_NE(built.means->GetPointData()->GetArray("Bandwidth"), nullptr);
  worker_.request(this->shifted(0.0));
  worker_.wait();
  ASSERT_TRUE(worker_.take(built));
  EXPECT_LT(built.means->GetNumberOfPoints(), 200);
  EXPECT_EQ(built.means->GetPointData()->GetArray("Bandwidth"), nullptr);
}

TEST_F(SceneWorkerTest, PublishesThatNothingIsLeftInTheWorkspace)
{
  worker_.request(this->shifted(0.0));
  worker_.wait();
  ASSERT_NE(newest_, nullptr);
  worker_.request(this->shifted(1.0));
  worker_.wait();
  BuiltScene built;
  ASSERT_TRUE(worker_.take(built));
  EXPECT_TRUE(built.empty);
  EXPECT_EQ(built.status, Status::Empty);
  EXPECT_EQ(newest_, nullptr);
  worker_.setCloud(nullptr);
  worker_.request(this->shifted(0.0));
  worker_.wait();
  ASSERT_TRUE(worker_.take(built));
  EXPECT_TRUE(built.empty);
  EXPECT_EQ(built.means->GetNumberOfPoints(), 0);
}

TEST_F(SceneWorkerTest, ForgetsWhatIsCancelled)
{
  worker_.request(this->shifted(0.0));
  worker_.cancel();
  EXPECT_FALSE(worker_.busy());
  BuiltScene built;
  EXPECT_FALSE(worker_.take(built));
}

TEST_F(SceneWorkerTest, AdoptsWhatWasMadeElsewhere)
{
  worker_.request(this->shifted(0.001));
  worker_.wait();
  const std::shared_ptr<const HapticScene> made = std::move(newest_);
  ASSERT_NE(made, nullptr);
  SceneWorker other;
  other.setCloud(makeCloud());
  EXPECT_EQ(other.adopt(this->shifted(0.001), made), 1u);
  EXPECT_EQ(newest_, made); // at once
  EXPECT_FALSE(other.busy());
  BuiltScene built;
  EXPECT_FALSE(other.take(built));
  EXPECT_EQ(other.numberOfBuilds(), 0u);
  EXPECT_EQ(other.request(this->shifted(0.002)), 2u);
  other.wait();
  ASSERT_TRUE(other.take(built));
  EXPECT_EQ(built.number, 2u);
  EXPECT_EQ(other.numberOfBuilds(), 1u);
}

TEST_F(SceneWorkerTest, DropsWhatIsInFlightForWhatItAdopts)
{
  for (int i = 0; i < 20; ++i)
  {
    const std::uint64_t built = worker_.request(this->shifted(0.0001 * i));
    std::this_thread::sleep_for(std::chrono::microseconds(200 * i));
    worker_.setCloud(makeCloud(0.001));
    EXPECT_EQ(worker_.adopt(this->shifted(0.0), nullptr), built + 1);
    worker_.wait();
    BuiltScene taken;
    EXPECT_FALSE(worker_.take(taken));
  }
}

/// Keeps the scenes that any thread publishes.
struct Published
{
  void operator()(std::shared_ptr<const HapticScene> scene)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    newest = std::move(scene);
    changed.notify_all();
  }
  /// The newest scene, as soon as that is a finer one that covers @p place; null: none came for a minute.
  std::shared_ptr<const HapticScene> finerAt(const Vec3& place)
  {
    std::unique_lock<std::mutex> lock(mutex);
    const auto isThere = [&]
    {
      return newest && newest->fallback() && newest->cellSize() < newest->fallback()->cellSize() &&
        newest->covers(newest->toLattice(place));
    };
    return changed.wait_for(lock, std::chrono::minutes(1), isThere) ? newest : nullptr;
  }
  std::mutex mutex;
  std::condition_variable changed;
  std::shared_ptr<const HapticScene> newest;
};

class RefiningWorkerTest : public SceneWorkerTest
{
protected:
  RefiningWorkerTest()
  {
    worker_.setCloud(makeCloud(0.0002));
    publisher_.setSink([this](std::shared_ptr<const HapticScene> scene) { published_(std::move(scene)); });
  }
  ~RefiningWorkerTest() override { worker_.cancel(); }

  std::uint64_t request(double z, bool refines)
  {
    SceneRequest request = this->shifted(z);
    request.refinesNearHand = refines;
    request.hand = [this]
    {
      ++looks_;
      Bounds bounds;
      bounds.include({ handX_, 0.0, 0.0 });
      return bounds;
    };
    request.publish = [this](std::shared_ptr<const HapticScene> scene, std::uint64_t number)
    {
      if (scene && scene->fallback())
      {
        const std::lock_guard<std::mutex> lock(published_.mutex);
        finer_.emplace_back(number, scene->modelToLattice().m[2][3]);
      }
      publisher_.publish(std::move(scene), publisher_.cloud(), number);
    };
    AffineTransform place;
    place.m[2][3] = z;
    publisher_.move(place);
    return worker_.request(std::move(request));
  }

  std::atomic<double> handX_{ 0.0 };
  std::atomic<int> looks_{ 0 };
  /// Number and height of each finer scene as it was made.
  std::vector<std::pair<std::uint64_t, double>> finer_;
  Published published_;
  ScenePublisher publisher_;
};

// Also to be run under the thread sanitizer.
TEST_F(RefiningWorkerTest, PublishesFinerScenesOfWhereTheHandComes)
{
  this->request(0.0, true);
  const std::shared_ptr<const HapticScene> first = published_.finerAt({});
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->globalCloudNumber(), first->fallback()->cloudNumber());
  for (const double x : { 0.004, 0.008, 0.012, 0.002 })
  {
    handX_ = x;
    EXPECT_NE(published_.finerAt({ x, 0.0, 0.0 }), nullptr) << x;
  }
  // A model that moves and rests is refined again, where it is now.
  for (int i = 1; i <= 5; ++i)
  {
    this->request(1e-4 * i, true);
  }
  worker_.wait();
  const std::shared_ptr<const HapticScene> moved = published_.finerAt({ 0.002, 0.0, 0.0 });
  ASSERT_NE(moved, nullptr);
  EXPECT_NE(moved->globalCloudNumber(), first->globalCloudNumber());
  EXPECT_EQ(moved->modelToWorkspace().m[2][3], 5e-4);
}

TEST_F(RefiningWorkerTest, MakesNoFinerSceneWhereNobodyAsksForOne)
{
  this->request(0.0, false);
  worker_.wait();
  const int looks = looks_;
  std::this_thread::sleep_for(std::chrono::milliseconds(50)); // it would come sooner
  EXPECT_EQ(looks_, looks);
  const std::lock_guard<std::mutex> lock(published_.mutex);
  ASSERT_NE(published_.newest, nullptr);
  EXPECT_EQ(published_.newest->fallback(), nullptr);
}

TEST_F(RefiningWorkerTest, LooksAtNoHandAfterItIsCancelled)
{
  this->request(0.0, true);
  ASSERT_NE(published_.finerAt({}), nullptr);
  worker_.cancel();
  const int looks = looks_;
  handX_ = 0.01;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(looks_, looks);
  this->request(0.0, true);
  EXPECT_NE(published_.finerAt({ 0.01, 0.0, 0.0 }), nullptr);
}

TEST_F(RefiningWorkerTest, LooksSeldomAtAHandThatRests)
{
  this->request(0.0, true);
  ASSERT_NE(published_.finerAt({}), nullptr);
  const int first = looks_;
  ASSERT_TRUE(trial::eventually([&] { return looks_ > first + 150; }));
  const int rested = looks_;
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_LT(looks_ - rested, 50) << "it would be 100";
  handX_ = 0.008;
  EXPECT_NE(published_.finerAt({ 0.008, 0.0, 0.0 }), nullptr);
}

// The model moves: finer scenes come of where it is, beside the scene of where it was.
TEST_F(RefiningWorkerTest, RefinesAMovedModelBeforeTheWholeCloudIsThere)
{
  worker_.setCloud(makeCloud(0.0001));
  const std::uint64_t first = this->request(0.0, true);
  ASSERT_NE(published_.finerAt({}), nullptr);
  bool isEarly = false;
  for (int i = 1; i <= 20 && !isEarly; ++i)
  {
    const std::uint64_t number = this->request(1e-4 * i, true);
    worker_.wait();
    const std::lock_guard<std::mutex> lock(published_.mutex);
    isEarly = std::any_of(finer_.begin(), finer_.end(),
      [&](const auto& each) { return each.first < number && each.second == 1e-4 * i; });
  }
  EXPECT_TRUE(isEarly) << "requests since " << first;
}

/// A hand that stays where it is.
class StillPort : public HapticPort
{
public:
  Status read(double, HandState& state) noexcept override
  {
    state.position = { 0.0, 0.0, 0.003 };
    return Status::Ok;
  }
  Status write(double, const Vec3&) noexcept override { return Status::Ok; }
};

// Also to be run under the thread sanitizer.
TEST_F(SceneWorkerTest, PublishesWhileTheServoLoopFeelsAndTheWindowLooks)
{
  StillPort port;
  ServoLoop loop;
  ServoSettings settings;
  settings.realtimePriority = false;
  ASSERT_EQ(loop.start(port, {}, settings), Status::Ok);
  std::vector<ServoSample> samples;
  worker_.setCloud(makeCloud(0.0002));
  ScenePublisher publisher;
  publisher.setSink(
    [&loop](std::shared_ptr<const HapticScene> scene) { loop.publishScene(std::move(scene)); });
  std::atomic<int> parts{ 0 };
  int shown = 0;
  double sum = 0.0;
  for (int i = 0; i < 24; ++i)
  {
    SceneRequest request = this->shifted(1e-4 * (i % 7));
    request.refinesNearHand = true;
    request.hand = [&loop]
    {
      Bounds bounds;
      bounds.include(loop.latest().state.hip);
      return bounds;
    };
    request.publish = [&](std::shared_ptr<const HapticScene> scene, std::uint64_t number)
    {
      parts += scene && scene->fallback();
      publisher.publish(std::move(scene), publisher.cloud(), number);
    };
    worker_.request(std::move(request));
    if (i % 3 == 0)
    {
      worker_.wait();
    }
    loop.takeTrace(samples);
    BuiltScene built;
    if (worker_.take(built))
    {
      ++shown;
      sum += built.means->GetPointData()->GetArray("Bandwidth")->GetRange()[1];
      sum += built.means->GetBounds()[5];
    }
  }
  worker_.wait();
  worker_.cancel(); // the loop and the publisher go first
  while (loop.latest().scenes == 0)
  {
    loop.takeTrace(samples);
  }
  loop.stop();
  EXPECT_GE(shown, 8);
  EXPECT_GE(parts, 1);
  EXPECT_GT(sum, 0.0);
}

/// 0.3 mm voxels hold many points each of a plane of 1 cm; the dimensions of finer ones are said.
TEST_F(SceneWorkerTest, FindsAFinerLatticeWhereTheUsualOneLosesMostOfTheCloud)
{
  std::vector<Vec3> points;
  for (int i = 0; i < 40000; ++i)
  {
    points.emplace_back(5e-5 * double(i % 200), 5e-5 * double(i / 200), 0.0); // NOLINT
  }
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
  SceneRequest request = SceneRequest::of(resampler, nullptr);
  SceneWorker worker;
  worker.setCloud(trial::cloudOf(points, VTK_FLOAT));
  for (const bool finds : { false, true })
  {
    request.findsLattice = finds;
    worker.request(request);
    worker.wait();
    BuiltScene built;
    ASSERT_TRUE(worker.take(built));
    EXPECT_EQ(built.latticeDimension, finds ? 1200 : 0);
    EXPECT_EQ(built.means->GetNumberOfPoints() > 10000, finds);
  }
}

TEST_F(SceneWorkerTest, GivesNoMeansOfACloudThatIsGone)
{
  worker_.request(this->shifted(0.0));
  worker_.wait();
  worker_.setCloud(makeCloud());
  BuiltScene built;
  EXPECT_FALSE(worker_.take(built));
  const std::uint64_t number = worker_.request(this->shifted(0.0));
  worker_.wait();
  ASSERT_TRUE(worker_.take(built));
  EXPECT_EQ(built.number, number);
}

} // namespace
