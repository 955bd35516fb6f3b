// Finer scenes near the hand, beside the scene of the whole cloud, where the model is.
#include "LocalSceneProvider.h"

#include "HapticSceneBuilder.h"
#include "vtkVoxelMeanResampler.h"

#include "MadeClouds.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <memory>

using namespace pointhaptics;

namespace
{

class LocalSceneProviderTest : public ::testing::Test
{
protected:
  LocalSceneProviderTest()
  {
    resampler_->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    resampler_->SetComputeCovariance(true);
    resampler_->SetInputData(cloud_);
    resampler_->Update();
    Status status = Status::Ok;
    whole_ = makeHapticScene(
      resampler_->GetOutput(), status, true, LocalBandwidthSettings(), &resampler_->GetSettings());
    provider_.setCloud(cloud_->GetPoints());
  }

  static Bounds handAt(const Vec3& place)
  {
    Bounds hand;
    hand.include(place);
    return hand;
  }
  /// Somewhere on the idol a finer scene is of use.
  std::shared_ptr<const HapticScene> finer(const AffineTransform& place)
  {
    std::shared_ptr<const HapticScene> finer;
    for (vtkIdType i = 0; i < cloud_->GetNumberOfPoints() && !finer; i += 500)
    {
      Vec3 point;
      cloud_->GetPoint(i, &point.x);
      hand_ = handAt(place.apply(point));
      finer = provider_.refine(hand_, whole_, place);
    }
    return finer;
  }

  vtkSmartPointer<vtkPolyData> cloud_ = trial::shapeCloud(Shape::Idol, 150000);
  vtkNew<vtkVoxelMeanResampler> resampler_;
  std::shared_ptr<const HapticScene> whole_;
  LocalSceneProvider provider_;
  Bounds hand_;
};

TEST_F(LocalSceneProviderTest, IndexesNoPointsForAHandThatFeelsNothing)
{
  EXPECT_EQ(provider_.refine(handAt({ 0.049, 0.049, 0.049 }), whole_, {}), nullptr);
  EXPECT_EQ(provider_.refine(Bounds(), whole_, {}), nullptr);
  EXPECT_FALSE(provider_.isIndexed());
  EXPECT_NE(this->finer({}), nullptr);
  EXPECT_TRUE(provider_.isIndexed());
}

TEST_F(LocalSceneProviderTest, OfAModelThatMovesIsWhereItIsNow)
{
  const AffineTransform place =
    AffineTransform::translation({ 0.002, 0.0, 0.0 }) * AffineTransform::scaling({ 1.2, 1.2, 1.2 });
  const auto scene = this->finer(place);
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->modelToLattice(), place);
  EXPECT_EQ(scene->globalCloudNumber(), whole_->cloudNumber());
  EXPECT_EQ(scene->fallback()->modelToWorkspace(), place);
  EXPECT_LT(scene->cellSize(), 1.2 * whole_->cellSize());
  EXPECT_TRUE(scene->covers(hand_.center()));
  EXPECT_EQ(provider_.refine(hand_, whole_, place), nullptr) << "the last one serves";
  EXPECT_NE(provider_.refine(hand_, whole_, place * AffineTransform::scaling({ 1.01, 1.01, 1.01 })), nullptr);
  const auto again = provider_.make(*scene->origin(), whole_);
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(again->numberOfPoints(), scene->numberOfPoints());
}

TEST_F(LocalSceneProviderTest, OfAModelThatIsStretchedIsNone)
{
  EXPECT_EQ(this->finer(AffineTransform::scaling({ 1.0, 1.0, 1.2 })), nullptr);
  EXPECT_FALSE(provider_.isIndexed());
}

} // namespace
