#include "LevelOfDetail.h"
#include "CloudAppearance.h"
#include "vtkDepthShadingPass.h"
#include "vtkSplatMapper.h"

#include "OffscreenWindow.h"
#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkSequencePass.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

using namespace pointhaptics;

namespace
{

constexpr int kPoints = 120000;
constexpr int kSize = 200;

/// A sphere of 4 cm about the origin, on a spiral.
vtkSmartPointer<vtkPolyData> makeSphere()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(kPoints);
  for (int i = 0; i < kPoints; ++i)
  {
    const double z = 1.0 - 2.0 * (i + 0.5) / kPoints;
    const double r = std::sqrt(1.0 - z * z);
    points->InsertNextPoint(0.04 * r * std::cos(2.4 * i), 0.04 * r * std::sin(2.4 * i), 0.04 * z);
    vertices->InsertCellPoint(i);
  }
  auto sphere = vtkSmartPointer<vtkPolyData>::New();
  sphere->SetPoints(points);
  sphere->SetVerts(vertices);
  addHeightArray(sphere, { 0, 1, 0 });
  return sphere;
}

/// A window that shows a cloud, with the detail that belongs to it; time passes as the test says.
class LevelOfDetailTest
  : public ::testing::Test
  , protected OffscreenWindow
{
protected:
  LevelOfDetailTest()
    : OffscreenWindow(kSize, kSize)
  {
  }
  void SetUp() override
  {
    SKIP_WITHOUT_DISPLAY();
    cloud_ = makeSphere();
    mapper_->SetInputData(cloud_);
    mapper_->Settings().fixedPixels = 3.0;
    actor_->SetMapper(mapper_);
    applyCloudAppearance(cloud_, mapper_, actor_);
    renderer->AddActor(actor_);
    applyBackground(renderer);
    applyDepthShading(renderer);
    renderer->ResetCameraClippingRange();
    detail_.setEnabled(true);
    begin_->SetClientData(this);
    begin_->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*)
      {
        auto* test = static_cast<LevelOfDetailTest*>(self);
        test->detail_.beginFrame(test->now_);
      });
    renderer->AddObserver(vtkCommand::StartEvent, begin_);
  }

  void TearDown() override { renderer->RemoveObserver(begin_); }

  void render(double later)
  {
    now_ += later;
    window->Render();
  }

  vtkSmartPointer<vtkSplatMapper> drawSplats()
  {
    auto splats = vtkSmartPointer<vtkSplatMapper>::New();
    splats->SetInputData(cloud_);
    actor_->SetMapper(splats);
    applyCloudAppearance(cloud_, splats, actor_);
    return splats;
  }

  void renderUntilFine()
  {
    for (int i = 0; i < 20 && !detail_.isFinest(); ++i)
    {
      this->render(1.0);
    }
  }

  double now_ = 100.0;
  vtkSmartPointer<vtkPolyData> cloud_;
  vtkNew<vtkSplatMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkCallbackCommand> begin_;
  LevelOfDetail detail_{ renderer, actor_ };
};

TEST_F(LevelOfDetailTest, MovesWithFewPointsAndRestsWithThePictureOfAllPoints)
{
  detail_.setEnabled(false);
  this->render(0.0);
  const std::vector<unsigned char> whole = this->pixels();
  detail_.setEnabled(true);
  this->render(0.01);
  EXPECT_TRUE(detail_.isMoving());
  EXPECT_LT(detail_.drawnPoints(), kPoints / 2);
  EXPECT_GE(detail_.drawnPoints(), FrameBudget::kFewestPoints);
  const double distance = renderer->GetActiveCamera()->GetDistance();
  const double radius = 0.04 / distance / std::tan(vtkMath::RadiansFromDegrees(15.0)) * kSize / 2;
  const double surface = 4.0 * vtkMath::Pi() * radius * radius; // pixels
  EXPECT_GT(detail_.fragments(), 2.0 * surface) << "discs that close";
  EXPECT_LT(detail_.fragments(), 16.0 * surface);
  EXPECT_NE(this->pixels(), whole);
  EXPECT_FALSE(detail_.refinementDue(now_));
  EXPECT_TRUE(detail_.refinementDue(now_ + 2.0 * LevelOfDetail::kRestSeconds));
  std::int64_t last = detail_.drawnPoints();
  while (detail_.refinementDue(now_ + 1.0))
  {
    this->render(1.0);
    ASSERT_GT(detail_.drawnPoints(), last);
    last = detail_.drawnPoints();
  }
  EXPECT_TRUE(detail_.showsAll());
  EXPECT_EQ(this->pixels(), whole);
}

TEST_F(LevelOfDetailTest, KeepsAtMostAQuarterOfThePointsBesideTheCloudOnItsWayToAll)
{
  this->render(0.01);
  EXPECT_EQ(detail_.keptPoints(), detail_.drawnPoints());
  this->renderUntilFine();
  EXPECT_EQ(detail_.drawnPoints(), kPoints);
  EXPECT_GT(detail_.keptPoints(), 0);
  EXPECT_LE(detail_.keptPoints(), kPoints / 4);
}

TEST_F(LevelOfDetailTest, TheCoarsePictureCoversWhatTheWholeOneDoes)
{
  detail_.setEnabled(false);
  actor_->VisibilityOff();
  this->render(0.0);
  const std::vector<unsigned char> nothing = this->pixels();
  actor_->VisibilityOn();
  this->render(0.0);
  const std::vector<unsigned char> whole = this->pixels();
  detail_.setEnabled(true);
  this->render(0.01);
  ASSERT_FALSE(detail_.showsAll());
  const std::vector<unsigned char> coarse = this->pixels();
  int covered = 0;
  int missed = 0;
  for (std::size_t i = 0; i < whole.size(); i += 3)
  {
    const bool isCloud = whole[i] != nothing[i] || whole[i + 1] != nothing[i + 1];
    const bool isCoarse = coarse[i] != nothing[i] || coarse[i + 1] != nothing[i + 1];
    covered += isCloud;
    missed += isCloud && !isCoarse;
  }
  EXPECT_GT(covered, 3000);
  EXPECT_LE(missed, covered / 100);
}

TEST_F(LevelOfDetailTest, KeepsItsDetailWhereNothingButTextChanges)
{
  this->render(0.0);
  this->renderUntilFine();
  ASSERT_TRUE(detail_.showsAll());
  this->render(0.01);
  EXPECT_TRUE(detail_.showsAll());
  EXPECT_FALSE(detail_.refinementDue(now_ + 10.0));
}

TEST_F(LevelOfDetailTest, CameraCloudModelAndOtherActorsAreMotion)
{
  vtkNew<vtkActor> proxy;
  renderer->AddActor(proxy);
  this->render(0.0);
  const std::vector<std::pair<const char*, std::function<void()>>> motions = {
    { "camera", [this] { renderer->GetActiveCamera()->Azimuth(3); } },
    { "model", [this] { actor_->SetPosition(0.001, 0, 0); } },
    { "cloud", [this] { cloud_->Modified(); } },
    { "proxy", [&proxy] { proxy->SetPosition(0, 0, 0.01); } },
  };
  for (const auto& [name, move] : motions)
  {
    this->renderUntilFine();
    ASSERT_TRUE(detail_.showsAll()) << name;
    move();
    this->render(1.0);
    EXPECT_FALSE(detail_.showsAll()) << name;
  }
}

TEST_F(LevelOfDetailTest, ShowsAllForAPictureThatIsKept)
{
  this->render(0.0);
  ASSERT_FALSE(detail_.showsAll());
  renderer->GetActiveCamera()->Azimuth(3);
  detail_.showFinestOnce();
  this->render(0.01);
  EXPECT_TRUE(detail_.showsAll());
}

TEST_F(LevelOfDetailTest, DepthShadingLeavesTheBackgroundAsItIs)
{
  detail_.setEnabled(false);
  renderer->GradientBackgroundOff();
  renderer->SetBackground(1.0, 1.0, 1.0);
  mapper_->ScalarVisibilityOff();
  actor_->GetProperty()->SetColor(0.5, 0.5, 0.5);
  this->render(0.0);
  const std::vector<unsigned char> shaded = this->pixels();
  renderer->SetPass(nullptr);
  this->render(0.0);
  const std::vector<unsigned char> plain = this->pixels();
  int darker = 0;
  for (std::size_t i = 0; i < plain.size(); i += 3)
  {
    if (plain[i] == 255)
    {
      ASSERT_EQ(shaded[i], 255) << "pixel " << i / 3;
    }
    else
    {
      EXPECT_LE(int(shaded[i]), int(plain[i])) << "pixel " << i / 3;
      darker += shaded[i] < plain[i];
    }
  }
  EXPECT_GT(darker, 300); // the rim of the sphere falls away from the eye
}

TEST_F(LevelOfDetailTest, DrawsTheCloudAnewOnlyWhereMoreThanTextChanged)
{
  detail_.setEnabled(false);
  auto* passes = vtkSequencePass::SafeDownCast(renderer->GetPass())->GetPasses();
  auto* shading = vtkDepthShadingPass::SafeDownCast(passes->GetItemAsObject(0));
  ASSERT_NE(shading, nullptr);
  vtkNew<vtkTextActor> text;
  text->SetInput("text");
  text->GetTextProperty()->SetColor(0, 0, 0);
  text->SetPosition(90, 90);
  vtkNew<vtkActor> proxy;
  vtkNew<vtkPolyDataMapper> sphere;
  sphere->SetInputData(cloud_);
  proxy->SetMapper(sphere);
  vtkNew<vtkMatrix4x4> place;
  proxy->SetUserMatrix(place);
  renderer->AddActor(proxy);
  this->render(0.0);
  this->render(0.0); // the first one makes a light
  const std::vector<unsigned char> first = this->pixels();
  const auto drawn = shading->GetNumberOfPictures();
  this->render(0.0); // keeps what it has shaded
  this->render(0.0);
  EXPECT_EQ(this->pixels(), first);
  renderer->AddActor2D(text);
  this->render(0.0);
  EXPECT_NE(this->pixels(), first);
  renderer->RemoveActor2D(text);
  this->render(0.0);
  EXPECT_EQ(this->pixels(), first);
  EXPECT_EQ(shading->GetNumberOfPictures(), drawn);
  const std::vector<std::pair<const char*, std::function<void()>>> changes = {
    { "camera", [this] { renderer->GetActiveCamera()->Azimuth(3); } },
    { "matrix in place", [&place] { place->SetElement(0, 3, 0.01); } },
    { "colour", [&proxy] { proxy->GetProperty()->SetColor(1, 0, 0); } },
    { "visibility", [&proxy] { proxy->VisibilityOff(); } },
    { "strength", [shading] { shading->SetStrength(3.0); } },
    { "background", [this] { renderer->SetBackground(1, 0, 0); } },
    { "size", [this] { window->SetSize(kSize + 10, kSize); } },
  };
  for (const auto& [name, change] : changes)
  {
    this->render(0.0);
    this->render(0.0);
    const std::vector<unsigned char> before = this->pixels();
    change();
    this->render(0.0);
    EXPECT_NE(this->pixels(), before) << name;
  }
}

TEST_F(LevelOfDetailTest, LeavesOutWhatIsOutOfViewWithoutChangingThePicture)
{
  vtkNew<vtkFloatArray> lengths;
  lengths->SetName("Bandwidth");
  lengths->SetNumberOfValues(kPoints);
  lengths->FillValue(0.0003f);
  cloud_->GetPointData()->AddArray(lengths);
  const vtkSmartPointer<vtkSplatMapper> splats = this->drawSplats();
  this->render(0.01);
  ASSERT_FALSE(detail_.showsAll());
  EXPECT_EQ(detail_.visiblePoints(), detail_.drawnPoints());
  // Near the upper part of the sphere.
  renderer->GetActiveCamera()->SetPosition(0.0, 0.03, 0.12);
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.035, 0.0);
  renderer->GetActiveCamera()->SetViewAngle(15.0);
  renderer->ResetCameraClippingRange();
  this->render(0.01);
  ASSERT_FALSE(detail_.showsAll());
  EXPECT_LT(double(detail_.visiblePoints()), 0.65 * double(detail_.drawnPoints()));
  EXPECT_GT(detail_.visiblePoints(), 100);
  const std::vector<unsigned char> few = this->pixels();
  vtkActorCollection* actors = renderer->GetActors();
  vtkCollectionSimpleIterator cookie;
  actors->InitTraversal(cookie);
  while (vtkActor* actor = actors->GetNextActor(cookie))
  {
    if (auto* mapper = vtkSplatMapper::SafeDownCast(actor->GetMapper()))
    {
      mapper->SetRanges({});
    }
  }
  renderer->RemoveObserver(begin_);
  this->render(0.0);
  EXPECT_EQ(this->pixels(), few);
}

/// The points of @p cloud in the order of voxel means: x fastest, z slowest.
void sortAsMeans(vtkPolyData* cloud)
{
  std::vector<std::array<double, 3>> places(std::size_t(cloud->GetNumberOfPoints()));
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    cloud->GetPoint(vtkIdType(i), places[i].data());
  }
  const auto cell = [](double c) { return std::floor(c / 0.0004); };
  std::sort(places.begin(), places.end(),
    [&](const auto& a, const auto& b)
    {
      return std::array<double, 3>{ cell(a[2]), cell(a[1]), a[0] } <
        std::array<double, 3>{ cell(b[2]), cell(b[1]), b[0] };
    });
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    cloud->GetPoints()->SetPoint(vtkIdType(i), places[i].data());
  }
  cloud->GetPoints()->Modified();
  addHeightArray(cloud, { 0, 1, 0 });
}

/// Pixels that differ visibly, and those of them that have no other colour like theirs next to them.
struct Difference
{
  int visible = 0;
  int lasting = 0;
};

Difference differenceOf(const std::vector<unsigned char>& one, const std::vector<unsigned char>& other)
{
  constexpr int kVisible = 16;
  const auto differ = [&](int x, int y, int atX, int atY)
  {
    int most = 0;
    for (int c = 0; c < 3; ++c)
    {
      most = std::max(most,
        std::abs(int(one[std::size_t(3 * (y * kSize + x) + c)]) -
          int(other[std::size_t(3 * (atY * kSize + atX) + c)])));
    }
    return most >= kVisible;
  };
  Difference difference;
  for (int y = 1; y < kSize - 1; ++y)
  {
    for (int x = 1; x < kSize - 1; ++x)
    {
      if (!differ(x, y, x, y))
      {
        continue;
      }
      ++difference.visible;
      bool isNear = false;
      for (int at = 0; at < 9; ++at)
      {
        isNear = isNear || !differ(x, y, x + at % 3 - 1, y + at / 3 - 1);
      }
      difference.lasting += isNear ? 0 : 1;
    }
  }
  return difference;
}

TEST_F(LevelOfDetailTest, LeavesOutOfThePictureAtRestWhatIsOutOfViewWithoutChangingAPixel)
{
  vtkNew<vtkFloatArray> lengths;
  lengths->SetName("Bandwidth");
  lengths->SetNumberOfValues(kPoints);
  for (int i = 0; i < kPoints; ++i)
  {
    lengths->SetValue(i, i % 100 == 0 ? 0.0008f : 0.0003f);
  }
  cloud_->GetPointData()->AddArray(lengths);
  sortAsMeans(cloud_);
  const vtkSmartPointer<vtkSplatMapper> splats = this->drawSplats();
  vtkCamera* camera = renderer->GetActiveCamera();
  for (const bool parallel : { false, true })
  {
    for (const double pixels : { 0.0, 9.0 })
    {
      splats->Settings().fixedPixels = pixels;
      splats->Modified();
      camera->SetParallelProjection(parallel);
      camera->SetParallelScale(0.012);
      camera->SetPosition(0.12, 0.03, 0.02);
      camera->SetFocalPoint(0.03, 0.02, 0.01);
      camera->SetViewAngle(12.0);
      renderer->ResetCameraClippingRange();
      this->render(0.01);
      this->renderUntilFine();
      EXPECT_EQ(detail_.drawnPoints(), kPoints);
      EXPECT_LT(detail_.visiblePoints(), kPoints / 2);
      EXPECT_GT(detail_.visiblePoints(), 1000);
      const std::vector<unsigned char> some = this->pixels();
      detail_.setEnabled(false);
      this->render(0.0);
      EXPECT_EQ(detail_.visiblePoints(), kPoints);
      EXPECT_TRUE(this->pixels() == some) << parallel << pixels;
      detail_.setEnabled(true);
    }
  }
  // Nothing in view is nothing, not all.
  camera->SetFocalPoint(0.0, 1.0, 0.12);
  camera->SetPosition(0.0, 0.5, 0.12);
  camera->SetViewUp(1, 0, 0);
  this->render(0.01);
  this->renderUntilFine();
  EXPECT_EQ(detail_.visiblePoints(), 0);
  EXPECT_FALSE(splats->GetRanges().empty());
}

TEST_F(LevelOfDetailTest, DrawsPointsInAnotherOrderThanTheirOwnAll)
{
  vtkNew<vtkCellArray> backwards;
  for (vtkIdType i = kPoints - 1; i >= 0; --i)
  {
    backwards->InsertNextCell(1, &i);
  }
  cloud_->SetVerts(backwards);
  const vtkSmartPointer<vtkSplatMapper> splats = this->drawSplats();
  renderer->GetActiveCamera()->SetViewAngle(5.0);
  this->render(0.01);
  this->renderUntilFine();
  EXPECT_EQ(detail_.visiblePoints(), kPoints);
}

TEST_F(LevelOfDetailTest, LeavesOutWhatIsBelowAPixelFromAfar)
{
  vtkNew<vtkFloatArray> lengths;
  lengths->SetName("Bandwidth");
  lengths->SetNumberOfValues(kPoints);
  lengths->FillValue(0.0003f); // 0.43 mm apart
  cloud_->GetPointData()->AddArray(lengths);
  const vtkSmartPointer<vtkSplatMapper> splats = this->drawSplats();
  setDepthStrength(renderer, 0.0); // larger discs that face the viewer have higher steps
  vtkCamera* camera = renderer->GetActiveCamera();
  std::int64_t last = kPoints + 1;
  for (const bool parallel : { false, true })
  {
    for (const double distance : { 0.3, 0.6, 2.0 })
    {
      camera->SetParallelProjection(parallel);
      camera->SetParallelScale(distance * std::tan(vtkMath::RadiansFromDegrees(15.0)));
      camera->SetPosition(0, 0, distance);
      renderer->ResetCameraClippingRange();
      this->render(0.01);
      this->renderUntilFine();
      EXPECT_TRUE(detail_.showsAll());
      EXPECT_FALSE(detail_.refinementDue(now_ + 10.0));
      const std::int64_t drawn = detail_.drawnPoints();
      const std::vector<unsigned char> part = this->pixels();
      detail_.showFinestOnce();
      this->render(0.01);
      EXPECT_EQ(detail_.drawnPoints(), drawn) << "a picture that is kept needs no more";
      detail_.setEnabled(false);
      this->render(0.01);
      EXPECT_EQ(detail_.drawnPoints(), kPoints);
      detail_.setEnabled(true);
      const double radius = 0.04 / distance / std::tan(vtkMath::RadiansFromDegrees(15.0)) * kSize / 2;
      const Difference difference = differenceOf(part, this->pixels());
      const double covered = vtkMath::Pi() * radius * radius;
      EXPECT_LT(drawn, parallel ? kPoints : last);
      EXPECT_LT(difference.visible, 0.05 * covered + 4.0);
      EXPECT_EQ(difference.lasting, 0) << "a colour that was not next to it before";
      last = drawn;
    }
    last = kPoints + 1;
  }
}

TEST_F(LevelOfDetailTest, LeavesOutWhatTheWorkspaceClips)
{
  const vtkSmartPointer<vtkSplatMapper> splats = this->drawSplats();
  Bounds box;
  box.include({ -1.0, -1.0, -1.0 });
  box.include({ 0.0, 1.0, 1.0 });
  detail_.setWorkspace(box);
  this->render(0.01);
  ASSERT_FALSE(detail_.showsAll());
  // Half of the sphere, and the bricks on the border.
  EXPECT_LT(double(detail_.visiblePoints()), 0.75 * double(detail_.drawnPoints()));
  EXPECT_GT(double(detail_.visiblePoints()), 0.5 * double(detail_.drawnPoints()));
}

TEST_F(LevelOfDetailTest, AFrameThatIsGivenUpIsDrawnAgain)
{
  this->drawSplats();
  this->render(0.0);
  this->renderUntilFine();
  ASSERT_TRUE(detail_.showsAll());
  const std::vector<unsigned char> whole = this->pixels();
  cloud_->Modified();
  this->render(0.01); // few points
  EXPECT_FALSE(detail_.restingFrame());
  vtkNew<vtkCallbackCommand> giveUp;
  giveUp->SetClientData(window);
  giveUp->SetCallback([](vtkObject*, unsigned long, void* shown, void*)
    { static_cast<vtkRenderWindow*>(shown)->SetAbortRender(1); });
  const std::int64_t drawn = detail_.drawnPoints();
  const unsigned long atStart = renderer->AddObserver(vtkCommand::StartEvent, giveUp);
  this->render(1.0);
  EXPECT_EQ(detail_.drawnPoints(), drawn);
  EXPECT_TRUE(detail_.refinementDue(now_));
  EXPECT_TRUE(detail_.restingFrame());
  renderer->RemoveObserver(atStart);
  this->renderUntilFine();
  EXPECT_EQ(this->pixels(), whole);
  EXPECT_TRUE(detail_.isFinest());
  EXPECT_FALSE(detail_.refinementDue(now_));
}

TEST_F(LevelOfDetailTest, TakesAnOrderThatWasMadeElsewhere)
{
  this->render(0.01);
  const std::vector<unsigned char> own = this->pixels();
  ProgressiveOrder upwards; // the points begin at the pole
  upwards.indices.resize(kPoints);
  std::iota(upwards.indices.begin(), upwards.indices.end(), 0u);
  upwards.steps = { { kPoints / 4, 0.001 }, { kPoints, 0.0 } };
  detail_.setOrder(std::make_shared<const ProgressiveOrder>(upwards));
  cloud_->Modified();
  this->render(0.01);
  EXPECT_NE(this->pixels(), own);
}

TEST_F(LevelOfDetailTest, OtherColoursOfACloudAtRestKeepItsSplats)
{
  this->drawSplats();
  this->render(0.0);
  this->renderUntilFine();
  cloud_->Modified();
  detail_.recolor();
  this->render(1.0);
  EXPECT_TRUE(detail_.isFinest());
  vtkNew<vtkActor> unseen;
  unseen->VisibilityOff();
  renderer->AddActor(unseen);
  this->render(1.0);
  EXPECT_TRUE(detail_.isFinest());
}

} // namespace
