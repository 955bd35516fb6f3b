#include "ScenePublisher.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

using namespace pointhaptics;

namespace
{

/// A square of 2 cm about the origin, put where the transform says.
HapticSceneInput squareAt(const AffineTransform& modelToWorkspace)
{
  HapticSceneInput input;
  input.cellSize = 0.001;
  input.corner = Vec3{ -0.05, -0.05, -0.05 };
  input.modelToWorkspace = modelToWorkspace;
  for (int i = -10; i <= 10; ++i)
  {
    for (int j = -10; j <= 10; ++j)
    {
      input.points.push_back(modelToWorkspace.apply({ 0.001 * i, 0.001 * j, 0.0 }));
    }
  }
  return input;
}

std::shared_ptr<const HapticScene> sceneAt(const AffineTransform& modelToWorkspace)
{
  Status status = Status::Ok;
  auto scene = HapticScene::create(squareAt(modelToWorkspace), status);
  EXPECT_EQ(status, Status::Ok);
  return scene;
}

AffineTransform shiftBy(double z)
{
  return AffineTransform::translation({ 0.0, 0.0, z });
}

class ScenePublisherTest : public ::testing::Test
{
protected:
  ScenePublisherTest()
  {
    publisher_.setSink(
      [this](std::shared_ptr<const HapticScene> scene) { felt_.push_back(std::move(scene)); });
  }

  /// As of one request after the other.
  void publish(std::shared_ptr<const HapticScene> scene, std::uint64_t cloud)
  {
    publisher_.publish(std::move(scene), cloud, ++requests_);
  }

  ScenePublisher publisher_;
  std::uint64_t requests_ = 0;
  std::vector<std::shared_ptr<const HapticScene>> felt_;
};

TEST_F(ScenePublisherTest, AMovedModelIsFeltThereBeforeItIsResampled)
{
  const auto first = sceneAt(shiftBy(0.0));
  this->publish(first, publisher_.cloud());
  publisher_.move(shiftBy(0.003));
  ASSERT_EQ(felt_.size(), 2u);
  EXPECT_EQ(felt_[0], first);
  EXPECT_EQ(felt_[1]->modelToWorkspace(), shiftBy(0.003));
  EXPECT_EQ(felt_[1]->cloudNumber(), first->cloudNumber());
}

TEST_F(ScenePublisherTest, ASceneMadeForAnEarlierPlaceIsFeltWhereTheModelIs)
{
  this->publish(sceneAt(shiftBy(0.0)), publisher_.cloud());
  publisher_.move(shiftBy(0.001));
  const auto late = sceneAt(shiftBy(0.001));
  publisher_.move(shiftBy(0.002));
  this->publish(late, publisher_.cloud());
  ASSERT_EQ(felt_.size(), 4u);
  EXPECT_EQ(felt_[3]->cloudNumber(), late->cloudNumber());
  EXPECT_EQ(felt_[3]->modelToWorkspace(), shiftBy(0.002));
  const auto inTime = sceneAt(shiftBy(0.002));
  this->publish(inTime, publisher_.cloud());
  EXPECT_EQ(felt_.back(), inTime);
}

TEST_F(ScenePublisherTest, AStretchedModelWaitsForItsResampling)
{
  const auto first = sceneAt(shiftBy(0.0));
  this->publish(first, publisher_.cloud());
  const AffineTransform stretched = AffineTransform::scaling({ 1.0, 1.0, 2.0 });
  publisher_.move(stretched);
  EXPECT_EQ(felt_.size(), 1u);
  const auto there = sceneAt(stretched);
  this->publish(there, publisher_.cloud());
  EXPECT_EQ(felt_.back(), there);
  // Made for where the model was; it cannot be moved, and something is better than nothing.
  this->publish(first, publisher_.cloud());
  EXPECT_EQ(felt_.back(), first);
}

TEST_F(ScenePublisherTest, NothingToFeelIsPublishedToo)
{
  this->publish(sceneAt(shiftBy(0.0)), publisher_.cloud());
  this->publish(nullptr, publisher_.cloud());
  ASSERT_EQ(felt_.size(), 2u);
  EXPECT_EQ(felt_[1], nullptr);
  publisher_.move(shiftBy(0.001));
  EXPECT_EQ(felt_.size(), 2u);
}

TEST_F(ScenePublisherTest, ACloudThatIsGoneIsNeitherMovedNorPublished)
{
  const std::uint64_t old = publisher_.cloud();
  this->publish(sceneAt(shiftBy(0.0)), old);
  publisher_.startCloud();
  publisher_.move(shiftBy(0.001));
  this->publish(sceneAt(shiftBy(0.001)), old);
  EXPECT_EQ(felt_.size(), 1u);
  this->publish(sceneAt(shiftBy(0.001)), publisher_.cloud());
  EXPECT_EQ(felt_.size(), 2u);
}

TEST_F(ScenePublisherTest, AFinerSceneIsFeltAfterTheGlobalOneBesideIt)
{
  const std::uint64_t cloud = publisher_.cloud();
  const auto whole = sceneAt(shiftBy(0.0));
  publisher_.publish(whole, cloud, 1);
  HapticSceneInput input = squareAt(shiftBy(0.0));
  input.local.emplace();
  input.local->covered = { { -0.003, -0.003, -0.003 }, { 0.003, 0.003, 0.003 } };
  input.local->global = whole;
  Status status = Status::Ok;
  const auto part = HapticScene::create(std::move(input), status);
  publisher_.publish(part, cloud, 1);
  EXPECT_EQ(felt_.back(), part);
  // Both go where the model goes.
  publisher_.move(shiftBy(0.004));
  EXPECT_EQ(felt_.back()->cloudNumber(), part->cloudNumber());
  EXPECT_EQ(felt_.back()->modelToWorkspace(), shiftBy(0.004));
  EXPECT_EQ(felt_.back()->fallback()->modelToWorkspace(), shiftBy(0.004));
  publisher_.publish(part, cloud, 1);
  EXPECT_EQ(felt_.back()->modelToWorkspace(), shiftBy(0.004));
  const auto later = sceneAt(shiftBy(0.004));
  publisher_.publish(later, cloud, 2);
  EXPECT_EQ(felt_.back(), later);
  publisher_.publish(part, cloud, 1);
  EXPECT_EQ(felt_.back(), later) << "overtaken";
}

} // namespace
