#include "HapticViewerFixture.h"

#include "../Unit/SkipWithoutDisplay.h"
#include "CommandRegistry.h"
#include "vtkHapticOverlay.h"
#include "vtkInteractorStyleHaptic.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace pointhaptics;

namespace
{

TEST_F(HapticViewerTest, TakesTheUnitThatTheCloudSaysUnlessTheHostHasChosenOne)
{
  const vtkSmartPointer<vtkPolyData> sphere = makeSphere();
  vtkNew<vtkStringArray> unit;
  unit->SetName("LengthUnit");
  unit->InsertNextValue("foot");
  sphere->GetFieldData()->AddArray(unit);
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(sphere, "sphere")) << viewer.message();
  EXPECT_EQ(viewer.scaleNote(), "1 : 6.77; 1 mm in the hand is 6.8 mm");
  options_.unit = "m";
  options_.unitIsChosen = true;
  HapticViewer chosen(options_, observer_);
  ASSERT_TRUE(chosen.open(sphere, "sphere")) << chosen.message();
  EXPECT_EQ(chosen.scaleNote(), "1 : 22.2; 1 mm in the hand is 22 mm");
}

TEST_F(HapticViewerTest, ShowsPointsOfItsHostAndLeavesThemAsTheyAre)
{
  const vtkSmartPointer<vtkPolyData> sphere = makeSphere();
  HapticViewer viewer(options_, observer_);
  EXPECT_EQ(viewer.means(), nullptr);
  ASSERT_TRUE(viewer.open(sphere, "sphere")) << viewer.message();
  EXPECT_EQ(viewer.numberOfPoints(), kPoints);
  EXPECT_EQ(viewer.scaleNote(), "1 : 22.2; 1 mm in the hand is 22 mm");
  ASSERT_NE(viewer.means(), nullptr);
  EXPECT_GT(viewer.means()->GetNumberOfPoints(), kPoints / 2);
  EXPECT_EQ(sphere->GetPointData()->GetNumberOfArrays(), 0);
  // Nothing is printed or said of what goes well.
  EXPECT_TRUE(warnings_.empty());
  EXPECT_TRUE(notes_.empty());
}

TEST_F(HapticViewerTest, TakesTheLatticeFromItsOptions)
{
  options_.fitsWorkspace = false;
  options_.transform = AffineTransform::scaling({ 0.01, 0.01, 0.01 });
  options_.voxels.lattice.workspace = { { -0.02, -0.02, 0.0 }, { 0.02, 0.02, 0.02 } };
  options_.voxels.lattice.automaticWorkspace = false;
  options_.voxels.lattice.voxelSize = 0.002;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  double bounds[6];
  viewer.means()->GetBounds(bounds);
  EXPECT_GE(bounds[4], 0.0); // the upper half
  EXPECT_NEAR(bounds[5], 0.01, 2e-4);
  EXPECT_LT(viewer.means()->GetNumberOfPoints(), 400);
}

TEST_F(HapticViewerTest, SaysWhyNothingCanBeShown)
{
  HapticViewer viewer(options_, observer_);
  EXPECT_FALSE(viewer.renderToFile(this->path("early.png")));
  EXPECT_EQ(viewer.message(), "no cloud is open; open one first");
  EXPECT_FALSE(viewer.run());
  EXPECT_FALSE(viewer.feelPath());
  EXPECT_TRUE(viewer.stop()); // nothing runs
  EXPECT_FALSE(viewer.open(std::vector<std::string>()));
  EXPECT_EQ(viewer.message(), "no file is named; give one");
  EXPECT_FALSE(viewer.open(nullptr, "mine"));
  EXPECT_EQ(viewer.message(), "mine: holds no points; give a cloud with at least one");
  EXPECT_FALSE(viewer.open({ this->path("missing.ply") }));
  EXPECT_NE(viewer.message().find("missing.ply"), std::string::npos) << viewer.message();
  EXPECT_FALSE(viewer.isCancelled());
}

TEST_F(HapticViewerTest, NamesWhatLeavesTheCloudOutOfTheWorkspaceInTheHostsWords)
{
  options_.fitsWorkspace = false;
  options_.voxels.lattice.workspace = { { 5.0, 5.0, 5.0 }, { 6.0, 6.0, 6.0 } };
  options_.voxels.lattice.automaticWorkspace = false;
  options_.names.placement = "the box in the dialog";
  HapticViewer viewer(options_, observer_);
  EXPECT_FALSE(viewer.open(makeSphere()));
  EXPECT_NE(viewer.message().find("leave out the box in the dialog to fit"), std::string::npos)
    << viewer.message();
}

TEST_F(HapticViewerTest, SkipsFilesThatCannotBeReadWithAWarning)
{
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open({ this->path("missing.ply"), this->writeCloud("plane.csv", 500) }))
    << viewer.message();
  EXPECT_EQ(viewer.numberOfPoints(), 500);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_EQ(warnings_[0].rfind("skipped: ", 0), 0u) << warnings_[0];
}

TEST_F(HapticViewerTest, EndsReadingWhenItsHostSaysStop)
{
  observer_.shouldStop = [] { return true; };
  HapticViewer viewer(options_, observer_);
  EXPECT_FALSE(viewer.open({ this->writeCloud("large.csv", 400000) }));
  EXPECT_TRUE(viewer.isCancelled()) << viewer.message();
}

/// A light window that turns dark with the first picture would flash.
TEST_F(HapticViewerTest, TheGroundBehindTheBarIsThatOfThePicture)
{
  SKIP_WITHOUT_DISPLAY();
  options_.showsReading = true;
  HapticViewer* waiting = nullptr;
  std::string ground = "none";
  observer_.shouldStop = [&]
  {
    vtkRenderer* bar = waiting->renderWindow()->GetRenderers()->GetFirstRenderer();
    ground = !bar ? "none" : bar->GetGradientBackground() || bar->GetBackground()[0] > 0.2 ? "light" : "dark";
    return bar != nullptr;
  };
  HapticViewer viewer(options_, observer_);
  waiting = &viewer;
  viewer.open({ this->writeCloud("large.csv", 1500000) });
  EXPECT_NE(ground, "light") << "none: it was read too fast for a window";
}

TEST_F(HapticViewerTest, WritesPicturesOffTheScreen)
{
  SKIP_WITHOUT_DISPLAY();
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("first.png"))) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("second.png"))) << viewer.message();
  EXPECT_GT(std::filesystem::file_size(this->path("first.png")), 2000u);
  EXPECT_EQ(std::filesystem::file_size(this->path("first.png")),
    std::filesystem::file_size(this->path("second.png")));
  EXPECT_EQ(notes_.size(), 2u);
  EXPECT_FALSE(viewer.renderToFile(this->path("no/folder.png")));
  EXPECT_NE(viewer.message().find("no/folder.png: cannot be written"), std::string::npos);
}

TEST_F(HapticViewerTest, ResamplesACloudOnceBeforeItsFirstPicture)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::Simulated;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open({ this->writeCloud("first.csv", 60000), this->writeCloud("second.csv", 50000) }))
    << viewer.message();
  EXPECT_EQ(viewer.numberOfResamplings(), 1u);
  ASSERT_TRUE(viewer.renderToFile(this->path("picture.png"))) << viewer.message();
  EXPECT_EQ(viewer.numberOfResamplings(), 1u);
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  EXPECT_EQ(viewer.numberOfResamplings(), 1u);

  const auto ticks = [&viewer](int count)
  {
    for (int i = 0; i < count; ++i)
    {
      int timer = 1;
      viewer.interactor()->InvokeEvent(vtkCommand::TimerEvent, &timer);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  };
  ticks(20); // also the hand's scenes make no more of them
  EXPECT_EQ(viewer.numberOfResamplings(), 1u);
  EXPECT_TRUE(viewer.style()->GetCommands().run("next-file"));
  for (int i = 0; i < 2000 && viewer.numberOfPoints() != 50000; ++i)
  {
    ticks(1);
  }
  ASSERT_EQ(viewer.numberOfPoints(), 50000);
  for (int i = 0; i < 2000 && viewer.style()->IsModelChanged(); ++i)
  {
    ticks(1); // it is resampled in the background
  }
  EXPECT_EQ(viewer.numberOfResamplings(), 2u);
  EXPECT_FALSE(viewer.style()->IsModelChanged());
  viewer.style()->GetModel().scale(0.9);
  EXPECT_TRUE(viewer.style()->UpdateModel());
  EXPECT_EQ(viewer.numberOfResamplings(), 3u);
  EXPECT_TRUE(viewer.stop());
}

TEST_F(HapticViewerTest, ANewCloudIsColoredAsIfItWereTheFirst)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::None;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open({ this->writeCloud("first.csv", 6000), this->writeCloud("second.csv", 5000) }))
    << viewer.message();
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  EXPECT_TRUE(viewer.style()->GetCommands().run("colors"));
  const std::string first = notes_.back();
  EXPECT_TRUE(viewer.style()->GetCommands().run("colors"));
  EXPECT_NE(notes_.back(), first);
  EXPECT_TRUE(viewer.style()->GetCommands().run("next-file"));
  for (int i = 0; i < 2000 && viewer.numberOfPoints() != 5000; ++i)
  {
    int timer = 1;
    viewer.interactor()->InvokeEvent(vtkCommand::TimerEvent, &timer);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_EQ(viewer.numberOfPoints(), 5000);
  EXPECT_TRUE(viewer.style()->GetCommands().run("colors"));
  EXPECT_EQ(notes_.back(), first);
  EXPECT_TRUE(viewer.stop());
}

TEST_F(HapticViewerTest, TheFirstPictureOfAWindowWaitsForNoMeans)
{
  SKIP_WITHOUT_DISPLAY();
  options_.showsReading = true;
  options_.device = HapticViewerDevice::Simulated;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  EXPECT_EQ(viewer.numberOfResamplings(), 0u);
  EXPECT_EQ(viewer.means()->GetNumberOfPoints(), 0);
  std::uint64_t atFirstPicture = 99;
  vtkNew<vtkCallbackCommand> drawn;
  struct Seen
  {
    HapticViewer& viewer;
    std::uint64_t& resamplings;
  } seen{ viewer, atFirstPicture };
  drawn->SetClientData(&seen);
  drawn->SetCallback(
    [](vtkObject*, unsigned long, void* client, void*)
    {
      auto& [of, resamplings] = *static_cast<Seen*>(client);
      resamplings = std::min(resamplings, of.numberOfResamplings());
    });
  viewer.renderWindow()->SetOffScreenRendering(1);
  const unsigned long tag = viewer.renderWindow()->AddObserver(vtkCommand::EndEvent, drawn);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  viewer.renderWindow()->RemoveObserver(tag);
  EXPECT_EQ(atFirstPicture, 0u);
  EXPECT_TRUE(viewer.style()->GetCommands().run("hand-mode")) << "before there is anything to feel";
  for (int i = 0; i < 2000 && viewer.style()->IsModelChanged(); ++i)
  {
    int timer = 1;
    viewer.interactor()->InvokeEvent(vtkCommand::TimerEvent, &timer);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(viewer.style()->IsModelChanged());
  EXPECT_FALSE(viewer.style()->GetScenes().isEmpty());
  EXPECT_EQ(viewer.numberOfResamplings(), 1u);
  EXPECT_GT(viewer.means()->GetNumberOfPoints(), 10000);
  EXPECT_TRUE(viewer.stop());
}

TEST_F(HapticViewerTest, TellsOfAPickedPointNothingThatWasMadeForThePicture)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::None;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  const int* size = viewer.renderWindow()->GetSize();
  viewer.interactor()->SetEventInformation(size[0] / 2, size[1] / 2 + size[1] / 8);
  EXPECT_TRUE(viewer.style()->GetCommands().run("pick"));
  const std::string told = viewer.style()->GetStatus().overlay()->GetDetail();
  EXPECT_NE(told.find("in the file"), std::string::npos) << told;
  EXPECT_EQ(told.find("Splat"), std::string::npos) << told;
  EXPECT_TRUE(viewer.stop());
}

TEST_F(HapticViewerTest, TheWindowSaysWhatTheFirstFileLacks)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::None;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open({ this->path("missing.ply"), this->writeCloud("plane.csv", 500) }))
    << viewer.message();
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  viewer.style()->GetStatus().update(nullptr, false);
  const std::string told = viewer.style()->GetStatus().overlay()->GetStatus();
  EXPECT_NE(told.find("skipped: "), std::string::npos) << told;
  EXPECT_TRUE(viewer.stop());
}

TEST_F(HapticViewerTest, WhatIsRecordedOrShowsMeansIsResampledBeforeTheFirstPicture)
{
  options_.showsReading = true;
  options_.felt = true;
  HapticViewer felt(options_, observer_);
  ASSERT_TRUE(felt.open(makeSphere())) << felt.message();
  EXPECT_GT(felt.means()->GetNumberOfPoints(), 10000);
  options_.felt = false;
  options_.record = this->path("touch.csv");
  HapticViewer recorded(options_, observer_);
  ASSERT_TRUE(recorded.open(makeSphere())) << recorded.message();
  EXPECT_GT(recorded.means()->GetNumberOfPoints(), 10000);
}

TEST_F(HapticViewerTest, APictureThatShowsNoMeansMakesNone)
{
  SKIP_WITHOUT_DISPLAY();
  options_.makesMeans = false;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("points.png"))) << viewer.message();
  EXPECT_EQ(viewer.numberOfResamplings(), 0u);
  options_.colorBy = "proxyradius";
  HapticViewer radii(options_, observer_);
  ASSERT_TRUE(radii.open(makeSphere())) << radii.message();
  EXPECT_GT(radii.numberOfResamplings(), 0u);
}

TEST_F(HapticViewerTest, LooksAtFinerVoxelsOnlyWhereTheUsualOnesTellLittle)
{
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open({ this->writeCloud("few.csv", 900) })) << viewer.message();
  EXPECT_EQ(viewer.numberOfResamplings(), 2u);
}

TEST_F(HapticViewerTest, RunsInTheEventLoopOfItsHost)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::Simulated;
  options_.trace = this->path("trace.csv");
  HapticViewerState last;
  observer_.rememberState = [&last](const HapticViewerState& state) { last = state; };
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  viewer.style()->GetModel().scale(2.0);
  for (int i = 0; i < 3; ++i)
  {
    int timer = 1;
    viewer.interactor()->InvokeEvent(vtkCommand::TimerEvent, &timer);
  }
  ASSERT_TRUE(viewer.renderToFile(this->path("window.png"))) << viewer.message();
  ASSERT_TRUE(viewer.stop()) << viewer.message();
  EXPECT_TRUE(viewer.stop()); // again
  EXPECT_NEAR(last.modelToWorkspace[0], 0.09, 1e-5);
  EXPECT_EQ(last.width, 160);
  EXPECT_TRUE(std::filesystem::exists(this->path("window.png")));
  EXPECT_TRUE(std::filesystem::exists(this->path("trace.csv")));
}

/// The octree of a cloud optimised file: 200 points of the coarsest level, 1000 in all.
constexpr const char* kOctree = POINTHAPTICS_DATA "/Fuzz/Copc/octree.copc.laz";

/// The colours of the points that are drawn by height, by their places in the file.
std::map<std::array<double, 3>, std::array<double, 3>> colorsByPlace(HapticViewer& viewer)
{
  std::map<std::array<double, 3>, std::array<double, 3>> colors;
  vtkActorCollection* actors = viewer.renderer()->GetActors();
  actors->InitTraversal();
  while (vtkActor* actor = actors->GetNextActor())
  {
    auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
    vtkPolyData* points = actor->GetVisibility() && mapper ? mapper->GetInput() : nullptr;
    vtkDataArray* heights = points ? points->GetPointData()->GetArray("Height") : nullptr;
    for (vtkIdType i = 0; heights && i < points->GetNumberOfPoints(); ++i)
    {
      std::array<double, 3> place{};
      points->GetPoint(i, place.data());
      mapper->GetLookupTable()->GetColor(heights->GetComponent(i, 0), colors[place].data());
    }
  }
  return colors;
}

TEST_F(HapticViewerTest, ShowsACoarseLevelAtOnceAndThenAllPointsWhereTheyWere)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::None;
  options_.showsReading = true;
  options_.coarsePoints = 300;
  options_.colorBy = "Height";
  HapticViewerState state;
  observer_.writeState = [&state](const HapticViewerState& now, const std::string&, std::string&)
  {
    state = now;
    return true;
  };
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open({ std::string(kOctree) })) << viewer.message();
  EXPECT_EQ(viewer.numberOfPoints(), 200);
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  EXPECT_TRUE(viewer.style()->GetCommands().run("write-settings"));
  const HapticViewerState coarse = state;
  const auto coarseColors = colorsByPlace(viewer);
  EXPECT_EQ(coarseColors.size(), 200u);
  EXPECT_TRUE(viewer.style()->GetCommands().run("turn-up")); // instead of all points,
  EXPECT_TRUE(viewer.style()->GetCommands().run("leave"));   // which come where that is given up
  for (int i = 0; i < 4000 && viewer.numberOfPoints() != 1000; ++i)
  {
    int timer = 1;
    viewer.interactor()->InvokeEvent(vtkCommand::TimerEvent, &timer);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_EQ(viewer.numberOfPoints(), 1000);
  for (int i = 0; i < 2000 && viewer.style()->IsModelChanged(); ++i)
  {
    int timer = 1;
    viewer.interactor()->InvokeEvent(vtkCommand::TimerEvent, &timer);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(notes_.back(), "octree.copc.laz: all 1000 points");
  EXPECT_TRUE(viewer.style()->GetCommands().run("write-settings"));
  for (std::size_t i = 0; i < state.camera.size(); ++i)
  {
    // The position comes from focal point, direction and distance: with their rounding.
    EXPECT_NEAR(state.camera[i], coarse.camera[i], 1e-15) << i;
  }
  EXPECT_EQ(state.modelToWorkspace, coarse.modelToWorkspace);
  EXPECT_FALSE(viewer.style()->IsModelChanged()) << "it was resampled where it is";
  EXPECT_EQ(state.workspace, coarse.workspace);
  const auto colors = colorsByPlace(viewer);
  EXPECT_EQ(colors.size(), 1000u);
  for (const auto& [place, color] : coarseColors)
  {
    ASSERT_EQ(colors.count(place), 1u);
    EXPECT_EQ(colors.at(place), color);
  }
  EXPECT_TRUE(viewer.stop());
}

TEST_F(HapticViewerTest, ReadsAllAtOnceWhereNoWindowWaits)
{
  options_.coarsePoints = 300;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open({ std::string(kOctree) })) << viewer.message();
  EXPECT_EQ(viewer.numberOfPoints(), 1000);
}

TEST_F(HapticViewerTest, LetsAHostAddAKeyAndKeepTheStyleForLonger)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::Simulated;
  options_.bindings = { "axes=F5" };
  auto viewer = std::make_unique<HapticViewer>(options_, observer_);
  ASSERT_TRUE(viewer->open(makeSphere())) << viewer->message();
  viewer->renderWindow()->SetOffScreenRendering(1);
  const vtkSmartPointer<vtkInteractorStyleHaptic> style = viewer->style();
  CommandRegistry& commands = style->GetCommands();
  int grids = 0;
  commands.add({ "grid", "j", "Show", "a grid on the floor", [&grids] { ++grids; } });
  ASSERT_TRUE(viewer->start()) << viewer->message();
  EXPECT_EQ(commands.label("axes"), "F5");
  EXPECT_NE(commands.help().find("a grid on the floor"), std::string::npos);
  EXPECT_NE(commands.help().find("axes and bounds"), std::string::npos);
  EXPECT_EQ(commands.help().find("next, previous file"), std::string::npos) << "there is one cloud";
  EXPECT_EQ(commands.help().find("write the settings"), std::string::npos) << "the host keeps none";
  EXPECT_NE(HapticViewer::commands().help().find("write the settings"), std::string::npos);
  // The meaning of a key does not depend on the order of registration.
  EXPECT_EQ(HapticViewer::commands().conflicts(), std::vector<std::string>());
  viewer.reset();
  EXPECT_TRUE(commands.run("axes")) << "without effect";
  EXPECT_TRUE(commands.run("grid"));
  EXPECT_EQ(grids, 1);
  EXPECT_EQ(commands.help().find("axes and bounds"), std::string::npos);
  style->GetModel().scale(0.9);
  style->Refresh();
}

TEST_F(HapticViewerTest, TheCameraStaysBeforeTheSurfaceThatIsSeen)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::None;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  double box[6];
  viewer.means()->GetBounds(box);
  for (int click = 0; click < 20; ++click)
  {
    viewer.interactor()->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
  }
  viewer.interactor()->SetEventInformation(100, 10);
  viewer.interactor()->InvokeEvent(vtkCommand::RightButtonPressEvent);
  for (int y = 20; y < 200; y += 20)
  {
    viewer.interactor()->SetEventInformation(100, y);
    viewer.interactor()->InvokeEvent(vtkCommand::MouseMoveEvent);
  }
  viewer.interactor()->InvokeEvent(vtkCommand::RightButtonReleaseEvent);
  double from[3];
  viewer.renderer()->GetActiveCamera()->GetPosition(from);
  const double away = std::hypot(
    from[0] - 0.5 * (box[0] + box[1]), from[1] - 0.5 * (box[2] + box[3]), from[2] - 0.5 * (box[4] + box[5]));
  EXPECT_GT(away, 0.49 * (box[1] - box[0])) << "inside of the sphere";
}

} // namespace
