// The parts of the style: any device, in any order, for as long as they live. No window, no display.
#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProps.h"
#include "vtkHapticTouch.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "MadeClouds.h"
#include "Unit/Eventually.h"

#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

/// Nothing but the interface: where it is told to be.
class StrangersDevice : public HapticPort
{
public:
  Status read(double, HandState& state) noexcept override
  {
    state.position = { x, 0.0, z };
    state.buttons = buttons;
    return Status::Ok;
  }
  Status write(double, const Vec3& force) noexcept override
  {
    upward = force.z;
    return Status::Ok;
  }
  void moveTo(double newX, double newZ)
  {
    x = newX;
    z = newZ;
  }

  std::atomic<double> x{ 0.0 };
  std::atomic<double> z{ 0.02 };
  std::atomic<std::uint32_t> buttons{ 0 };
  std::atomic<double> upward{ 0.0 };
};

/// A style with a flat cloud at z = 0, seen along the z axis, and a servo loop on a stranger's device.
class StyleParts : public ::testing::Test
{
protected:
  StyleParts()
  {
    renderer->GetActiveCamera()->SetPosition(0, 0, 0.4);
    renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    renderer->GetActiveCamera()->SetViewUp(0, 1, 0);
    style->SetDefaultRenderer(renderer);
    resampler->SetInputData(flatCloud(-0.03, 0.03, 0.02));
    resampler->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    resampler->SetDimensions(100, 100, 100);
    bandwidth->SetInputConnection(resampler->GetOutputPort());
  }
  ~StyleParts() override
  {
    if (servo)
    {
      servo->stop();
    }
  }
  void setAll()
  {
    style->SetResampler(resampler);
    style->SetBandwidthFilter(bandwidth);
    style->SetServoLoop(servo.get());
    style->SetDevice(device.get());
  }
  void start()
  {
    ServoSettings settings;
    settings.realtimePriority = false;
    ASSERT_EQ(servo->start(*device, HapticParameters(), settings), Status::Ok);
    ASSERT_TRUE(eventually([&] { return servo->latest().tick > 2; }));
  }
  void moveTo(double x, double z)
  {
    device->moveTo(x, z);
    ASSERT_TRUE(eventually([&] { return servo->latest().state.hip == Vec3(x, 0.0, z); }));
  }
  void hold(std::uint32_t buttons)
  {
    device->buttons = buttons;
    ASSERT_TRUE(eventually([&] { return servo->latest().buttons == buttons; }));
  }
  /// Uses the style as a program that goes on does.
  void useStyle()
  {
    style->GetModel().translate({ 0.001, 0.0, 0.0 });
    style->GetHand().move({ 0.001, 0.0, 0.0 });
    style->GetHand().holdButton(0, true);
    EXPECT_TRUE(style->UpdateModel());
    for (int i = 0; i < 10; ++i)
    {
      style->Refresh();
    }
  }

  std::unique_ptr<StrangersDevice> device = std::make_unique<StrangersDevice>();
  std::unique_ptr<ServoLoop> servo = std::make_unique<ServoLoop>();
  vtkNew<vtkVoxelMeanResampler> resampler;
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  vtkNew<vtkRenderer> renderer;
  vtkSmartPointer<vtkInteractorStyleHaptic> style = vtkSmartPointer<vtkInteractorStyleHaptic>::New();
};

TEST_F(StyleParts, ShowTheChartOnceAForceIsFelt)
{
  vtkNew<vtkHapticChart> chart;
  chart->GetRenderer()->SetViewport(0.0, 0.0, 1.0, 0.25);
  style->SetChart(chart);
  style->SetCurrentRenderer(renderer);
  TouchDisplay& display = style->GetDisplay();
  display.hideChartUntilTouch();
  ServoSample sample;
  EXPECT_FALSE(display.showChartIfFelt({ sample }, false));
  EXPECT_FALSE(chart->GetVisibility());
  EXPECT_EQ(renderer->GetViewport()[1], 0.0);
  sample.state.force = { 0.0, 0.0, 1.0 };
  EXPECT_FALSE(display.showChartIfFelt({ sample }, true)) << "the picture shifts under no drag";
  EXPECT_TRUE(display.showChartIfFelt({}, false)) << "but after it";
  EXPECT_TRUE(chart->GetVisibility());
  EXPECT_EQ(renderer->GetViewport()[1], 0.25);
  display.setFigure(true);
  EXPECT_FALSE(chart->GetVisibility());
  display.setFigure(false);
  EXPECT_TRUE(chart->GetVisibility());
  display.setChartVisibility(false); // the user does not want it
  EXPECT_FALSE(display.showChartIfFelt({ sample }, false));
  EXPECT_FALSE(chart->GetVisibility());
  display.hideChartUntilTouch();
  display.setFigure(true);
  EXPECT_FALSE(display.showChartIfFelt({ sample }, false)) << "a figure has no chart";
  display.setFigure(false);
  EXPECT_TRUE(chart->GetVisibility()) << "it was felt";
}

} // namespace

TEST_F(StyleParts, LetAnyDeviceFeelTheModelAndHoldIt)
{
  vtkNew<vtkHapticProps> props;
  vtkNew<vtkHapticOverlay> overlay;
  style->SetProps(props);
  style->SetOverlay(overlay);
  style->GetStatus().setPanelVisibility(true);
  this->setAll();
  ASSERT_TRUE(style->UpdateModel());
  this->start();
  this->moveTo(0.0, 0.001);
  this->moveTo(0.0, -0.002);
  EXPECT_TRUE(eventually([&] { return device->upward > 1.5; })) << device->upward;
  style->Refresh();
  EXPECT_NEAR(props->GetHipActor()->GetUserMatrix()->GetElement(2, 3), -0.002, 1e-9);
  EXPECT_NE(overlay->GetPanel().find("device: without a name"), std::string::npos) << overlay->GetPanel();
  this->hold(1);
  this->moveTo(0.01, 0.018);
  style->Refresh();
  EXPECT_EQ(style->GetClutch().hold(), "translate-model-by-hand");
  EXPECT_NEAR(style->GetModelTransform()->GetMatrix()->GetElement(0, 3), 0.01, 1e-12);
  EXPECT_NEAR(style->GetModelTransform()->GetMatrix()->GetElement(2, 3), 0.02, 1e-12);
  EXPECT_TRUE(eventually([&] { return device->upward == 0.0; })) << "a hand that holds feels nothing";
  this->hold(0);
  ASSERT_TRUE(style->UpdateModel());
  style->Refresh();
  EXPECT_TRUE(eventually([&] { return device->upward > 1.5; })) << "the surface went with the hand";
}

TEST_F(StyleParts, MayBeSetInAnyOrder)
{
  this->start();
  this->moveTo(0.0, 0.001);
  int order[] = { 0, 1, 2, 3 };
  do
  {
    servo->publishScene(nullptr);
    ASSERT_TRUE(eventually([&] { return servo->latest().state.radius == 0.0; }));
    style = vtkSmartPointer<vtkInteractorStyleHaptic>::New();
    for (const int part : order)
    {
      part == 0     ? style->SetResampler(resampler)
        : part == 1 ? style->SetBandwidthFilter(bandwidth)
        : part == 2 ? style->SetServoLoop(servo.get())
                    : style->SetDevice(device.get());
    }
    EXPECT_TRUE(style->UpdateModel());
    EXPECT_TRUE(eventually([&] { return servo->latest().state.radius > 0.0; }));
  } while (std::next_permutation(std::begin(order), std::end(order)));
}

TEST_F(StyleParts, MayBeDestroyedBeforeTheStyle)
{
  SceneOptions options;
  options.refinesNearHand = true; // threads that look at the servo loop all the time
  style->GetScenes().setOptions(options);
  auto hand = std::make_unique<SimulatedDevice>();
  auto mouse = std::make_unique<SpaceMouse>();
  this->setAll();
  style->SetDevice(hand.get());
  style->SetSpaceMouse(mouse.get());
  ASSERT_TRUE(style->UpdateModel());
  this->start();
  this->moveTo(0.0, 0.001);
  this->hold(1);
  style->Refresh();
  ASSERT_TRUE(style->GetClutch().isHolding());
  hand.reset();
  mouse.reset();
  style->InvalidateModel();
  style->Refresh(); // a scene is being made
  servo.reset();
  device.reset();
  EXPECT_FALSE(style->GetHand().hasDevice());
  EXPECT_EQ(style->GetServoLoop(), nullptr);
  this->useStyle();
  EXPECT_FALSE(style->GetClutch().isHolding());
  EXPECT_TRUE(style->GetModel().undo());
}

TEST_F(StyleParts, OutliveTheStyleWhichLetsGoOfTheHand)
{
  this->setAll();
  ASSERT_TRUE(style->UpdateModel());
  this->start();
  this->moveTo(0.0, 0.001);
  this->moveTo(0.0, -0.002);
  ASSERT_TRUE(eventually([&] { return device->upward > 1.5; }));
  this->hold(1);
  style->Refresh();
  ASSERT_TRUE(eventually([&] { return device->upward == 0.0; }));
  style->InvalidateModel();
  style->Refresh();
  style = nullptr;
  EXPECT_TRUE(eventually([&] { return device->upward > 1.5; })) << "nobody would give the force back";
}

TEST_F(StyleParts, LetAHostAddACommandByOneCall)
{
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkHapticOverlay> overlay;
  interactor->SetInteractorStyle(style);
  style->SetOverlay(overlay);
  int grids = 0;
  style->GetCommands().add({ "grid", "j", "Show", "a grid on the floor", [&grids] { ++grids; } });
  const auto press = [&](const char* key)
  {
    interactor->SetKeyEventInformation(0, 0, 0, 0, key);
    interactor->InvokeEvent(vtkCommand::KeyPressEvent);
  };
  press("j");
  EXPECT_EQ(grids, 1);
  EXPECT_NE(overlay->GetHelp().find("J                                  a grid"), std::string::npos)
    << overlay->GetHelp();
  style->GetCommands().bind({ "grid=F4" });
  press("j");
  press("F4");
  EXPECT_EQ(grids, 2);
  EXPECT_NE(overlay->GetHelp().find("F4                                 a grid"), std::string::npos);
}

TEST_F(StyleParts, AreInTheHelpOnlyWhereTheyAreThere)
{
  const auto helpHas = [this](const char* words)
  { return style->GetCommands().help().find(words) != std::string::npos; };
  for (const char* words : { "sliders", "chart", "depth", "held: hand", "point under", "screenshot", "axes" })
  {
    EXPECT_FALSE(helpHas(words)) << words;
  }
  EXPECT_TRUE(helpHas("rotate the view"));
  this->setAll();
  EXPECT_TRUE(helpHas("held: hand rotates the model"));
  EXPECT_TRUE(helpHas("point under"));
  EXPECT_FALSE(helpHas("depth")) << "the mouse cannot move a stranger's device";
  SimulatedDevice hand;
  style->SetDevice(&hand);
  EXPECT_TRUE(helpHas("depth"));
}

TEST_F(StyleParts, NameTheKeyInForceInTheStatus)
{
  vtkNew<vtkHapticOverlay> overlay;
  style->SetOverlay(overlay);
  style->Refresh();
  EXPECT_NE(overlay->GetStatus().find("key 0 resets the model"), std::string::npos) << overlay->GetStatus();
  EXPECT_NE(overlay->GetStatus().find("H: help"), std::string::npos) << overlay->GetStatus();
  style->GetCommands().bind({ "reset-model=F8", "help=" });
  style->GetStatus().setNote("a note");
  style->Refresh();
  EXPECT_NE(overlay->GetStatus().find("key F8 resets the model"), std::string::npos) << overlay->GetStatus();
  EXPECT_EQ(overlay->GetStatus().find("help"), std::string::npos) << overlay->GetStatus();
}

TEST_F(StyleParts, SayWhyTheTouchCannotBegin)
{
  vtkNew<vtkHapticTouch> touch;
  EXPECT_FALSE(touch->Start(style));
  EXPECT_NE(touch->GetMessage().find("the style has no window"), std::string::npos) << touch->GetMessage();
  EXPECT_TRUE(style->GetHand().hasDevice());
  EXPECT_EQ(style->GetServoLoop(), &touch->GetServoLoop());
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetInteractorStyle(style);
  EXPECT_FALSE(touch->Start(style));
  EXPECT_NE(touch->GetMessage().find("no point lies in the workspace"), std::string::npos)
    << touch->GetMessage();
  resampler->SetVoxelSize(1e-12);
  style->SetResampler(resampler);
  EXPECT_FALSE(touch->Start(style));
  EXPECT_NE(touch->GetMessage().find("voxel size 1e-12"), std::string::npos) << touch->GetMessage();
  EXPECT_FALSE(touch->IsOn());
  style = nullptr; // the touch keeps it until it ends itself
}

/// The style's worker has filters of its own, in another thread: what they could not do is the style's to
/// say.
TEST_F(StyleParts, SayWhatTheFiltersCouldNotDo)
{
  this->setAll();
  std::string said;
  vtkNew<vtkCallbackCommand> listen;
  listen->SetClientData(&said);
  listen->SetCallback([](vtkObject*, unsigned long, void* to, void* text)
    { *static_cast<std::string*>(to) += static_cast<const char*>(text); });
  style->AddObserver(vtkCommand::ErrorEvent, listen);
  resampler->SetDimensions(0, 1, 1);
  style->InvalidateModel();
  EXPECT_FALSE(style->UpdateModel());
  EXPECT_NE(said.find("must be between 1 and 2097152"), std::string::npos) << said;
  said.clear();
  resampler->SetDimensions(100, 100, 100);
  bandwidth->SetNumberOfNeighbors(0);
  style->InvalidateModel();
  style->UpdateModel();
  EXPECT_NE(said.find("NumberOfNeighbors 0"), std::string::npos) << said;
  said.clear();
  bandwidth->SetNumberOfNeighbors(16);
  style->InvalidateModel();
  EXPECT_TRUE(style->UpdateModel());
  EXPECT_EQ(said, "");
}
