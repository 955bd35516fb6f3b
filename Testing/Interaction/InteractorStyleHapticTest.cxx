#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProps.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTransform.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

using namespace pointhaptics;

namespace
{

/// A square of 6 cm, points 1 mm apart, at z = 0.
vtkSmartPointer<vtkPolyData> makePlane()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = -30; i <= 30; ++i)
  {
    for (int j = -30; j <= 30; ++j)
    {
      points->InsertNextPoint(0.001 * i, 0.001 * j, 0.0);
    }
  }
  auto plane = vtkSmartPointer<vtkPolyData>::New();
  plane->SetPoints(points);
  return plane;
}

/// A window with the style and its pipeline; the camera looks down the z axis, y up.
class InteractorStyleHaptic : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const char* display = std::getenv("DISPLAY");
    if (!display || !*display)
    {
      GTEST_SKIP() << "no display (DISPLAY is not set); run the tests under xvfb-run";
    }
    resampler_->SetInputData(makePlane());
    resampler_->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    resampler_->SetDimensions(100, 100, 100);
    bandwidth_->SetInputConnection(resampler_->GetOutputPort());
    window_->SetOffScreenRendering(1);
    window_->SetSize(200, 200);
    window_->AddRenderer(renderer_);
    interactor_->SetRenderWindow(window_);
    renderer_->GetActiveCamera()->SetPosition(0, 0, 0.4);
    renderer_->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    renderer_->GetActiveCamera()->SetViewUp(0, 1, 0);
    style_->SetResampler(resampler_);
    style_->SetBandwidthFilter(bandwidth_);
    style_->SetDefaultRenderer(renderer_);
    interactor_->SetInteractorStyle(style_);
    this->count(vtkInteractorStyleHaptic::ModelChangedEvent, modelChanges_);
    this->count(vtkInteractorStyleHaptic::SceneChangedEvent, sceneChanges_);
    this->count(vtkInteractorStyleHaptic::FilesDroppedEvent, drops_);
    window_->Render();
    style_->UpdateModel();
    sceneChanges_ = 0;
  }
  void count(unsigned long event, int& counter)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&counter);
    command->SetCallback(
      [](vtkObject*, unsigned long, void* client, void*) { ++*static_cast<int*>(client); });
    style_->AddObserver(event, command);
  }
  void press(const std::string& symbol, bool shift = false)
  {
    interactor_->SetKeyEventInformation(0, shift, symbol.size() == 1 ? symbol[0] : 0, 0, symbol.c_str());
    interactor_->InvokeEvent(vtkCommand::KeyPressEvent);
    interactor_->InvokeEvent(vtkCommand::CharEvent);
  }
  void drag(unsigned long down, unsigned long up, int dx, int dy, bool control, bool shift)
  {
    interactor_->SetEventInformation(100, 100, control, shift);
    interactor_->InvokeEvent(down);
    interactor_->SetEventInformation(100 + dx, 100 + dy, control, shift);
    interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
    interactor_->InvokeEvent(up);
  }
  double element(int row, int column)
  {
    return style_->GetModelTransform()->GetMatrix()->GetElement(row, column);
  }
  bool modelIsIdentity() { return style_->GetModelTransform()->GetMatrix()->IsIdentity(); }

  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleHaptic> style_;
  int modelChanges_ = 0;
  int sceneChanges_ = 0;
  int drops_ = 0;
};

TEST_F(InteractorStyleHaptic, PublishesANewSceneAfterEachKeyThatMovesTheModel)
{
  for (const char* key : { "x", "X", "y", "Y", "z", "Z", "Left", "Right", "Up", "Down", "plus", "minus" })
  {
    const int models = modelChanges_;
    const int scenes = sceneChanges_;
    this->press(key);
    EXPECT_EQ(modelChanges_, models + 1) << key;
    EXPECT_TRUE(style_->IsModelChanged()) << key;
    EXPECT_TRUE(style_->UpdateModel()) << key;
    EXPECT_EQ(sceneChanges_, scenes + 1) << key;
    EXPECT_FALSE(style_->IsModelChanged()) << key;
  }
}

TEST_F(InteractorStyleHaptic, UndoesEachKeyWithItsOpposite)
{
  for (const auto& pair : { std::make_pair("x", "X"), std::make_pair("z", "Z"),
         std::make_pair("plus", "minus"), std::make_pair("Left", "Right"), std::make_pair("Up", "Down") })
  {
    this->press(pair.first);
    EXPECT_FALSE(this->modelIsIdentity()) << pair.first;
    this->press(pair.second);
    for (int row = 0; row < 4; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        EXPECT_NEAR(this->element(row, column), row == column ? 1.0 : 0.0, 1e-12) << pair.first;
      }
    }
  }
}

TEST_F(InteractorStyleHaptic, GoesBackToTheMatrixItWasGiven)
{
  vtkNew<vtkMatrix4x4> start;
  start->SetElement(0, 3, 0.01);
  style_->SetModelMatrix(start);
  this->press("plus");
  this->press("x");
  this->press("0");
  EXPECT_DOUBLE_EQ(this->element(0, 3), 0.01);
  EXPECT_DOUBLE_EQ(this->element(0, 0), 1.0);
}

TEST_F(InteractorStyleHaptic, TellsThatZoomGivesMoreVoxels)
{
  resampler_->SetDimensions(40, 40, 40);
  style_->ZoomModel(0.5);
  style_->UpdateModel();
  const vtkIdType before = bandwidth_->GetOutput()->GetNumberOfPoints();
  style_->ZoomModel(2.0);
  style_->UpdateModel();
  EXPECT_GT(bandwidth_->GetOutput()->GetNumberOfPoints(), before);
}

TEST_F(InteractorStyleHaptic, SaysThatTheModelHasLeftTheWorkspace)
{
  style_->ShiftModel({ 1.0, 0.0, 0.0 });
  EXPECT_FALSE(style_->UpdateModel());
  EXPECT_EQ(sceneChanges_, 1);
  style_->ResetModel();
  EXPECT_TRUE(style_->UpdateModel());
}

TEST_F(InteractorStyleHaptic, IgnoresNumbersThatAreNone)
{
  style_->ZoomModel(0.0);
  style_->ZoomModel(-1.0);
  style_->ZoomModel(NAN);
  style_->TurnModel(NAN, { 1, 0, 0 });
  style_->TurnModel(10, { 0, 0, 0 });
  style_->ShiftModel({ NAN, 0, 0 });
  EXPECT_TRUE(this->modelIsIdentity());
  EXPECT_EQ(modelChanges_, 0);
}

TEST_F(InteractorStyleHaptic, TurnsTheCameraOnAPlainDragAndTheModelWithShift)
{
  double before[3];
  renderer_->GetActiveCamera()->GetPosition(before);
  this->drag(vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent, 30, 0, false, true);
  EXPECT_FALSE(this->modelIsIdentity());
  EXPECT_DOUBLE_EQ(renderer_->GetActiveCamera()->GetPosition()[0], before[0]);
  style_->ResetModel();
  this->drag(vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent, 30, 0, false, false);
  EXPECT_TRUE(this->modelIsIdentity());
  EXPECT_NE(renderer_->GetActiveCamera()->GetPosition()[0], before[0]);
}

TEST_F(InteractorStyleHaptic, ShiftsTheModelWithTheMouse)
{
  this->drag(vtkCommand::MiddleButtonPressEvent, vtkCommand::MiddleButtonReleaseEvent, 20, 0, false, true);
  EXPECT_GT(this->element(0, 3), 0.0);
  EXPECT_NEAR(this->element(1, 3), 0.0, 1e-9);
  const double once = this->element(0, 3);
  this->drag(vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent, 20, 0, true, true);
  EXPECT_NEAR(this->element(0, 3), 2.0 * once, 1e-9);
}

TEST_F(InteractorStyleHaptic, ZoomsTheModelWithShiftAndWheel)
{
  interactor_->SetEventInformation(100, 100, 0, 1);
  interactor_->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
  EXPECT_GT(this->element(0, 0), 1.0);
  interactor_->InvokeEvent(vtkCommand::MouseWheelBackwardEvent);
  EXPECT_NEAR(this->element(0, 0), 1.0, 1e-12);
}

TEST_F(InteractorStyleHaptic, DrivesTheHandInTheViewPlaneAndInDepth)
{
  SimulatedDevice device;
  style_->SetDevice(&device);
  device.setTarget({ 0, 0, 0 });
  this->drag(vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent, 10, 0, true, false);
  EXPECT_GT(device.target().x, 0.0);
  EXPECT_NEAR(device.target().z, 0.0, 1e-9);
  this->press("Prior"); // away from the person, who looks along -z
  EXPECT_LT(device.target().z, 0.0);
  this->press("f");
  EXPECT_TRUE(style_->GetHandMode());
  interactor_->SetEventInformation(100, 140, 0, 0);
  interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
  EXPECT_GT(device.target().y, 0.01);
  style_->MoveHand({ 10, 10, 10 });
  EXPECT_DOUBLE_EQ(device.target().x, 0.05); // stays in the workspace
  style_->SetDevice(nullptr);
}

TEST_F(InteractorStyleHaptic, MovesThePropsFromTheTimer)
{
  SimulatedHandSettings settings;
  settings.yieldsToForce = false;
  settings.start = { 0.01, 0.0, 0.02 };
  SimulatedDevice device(settings);
  device.setTarget(settings.start);
  ASSERT_EQ(device.open(), Status::Ok);
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer_);
  ServoLoop servo;
  ServoSettings servoSettings;
  servoSettings.realtimePriority = false;
  ASSERT_EQ(servo.start(device, HapticParameters(), servoSettings), Status::Ok);
  style_->SetServoLoop(&servo);
  style_->SetDevice(&device);
  style_->SetProps(props);
  const auto waitFor = [&](auto&& condition)
  {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition() && std::chrono::steady_clock::now() < deadline)
    {
      interactor_->InvokeEvent(vtkCommand::TimerEvent);
      std::this_thread::yield();
    }
    return condition();
  };
  // A radius above 0 tells that the servo thread has the scene; before that a hand below the plane is in free
  // space.
  EXPECT_TRUE(
    waitFor([&] { return props->GetHipActor()->GetVisibility() != 0 && servo.latest().state.radius > 0.0; }));
  EXPECT_NEAR(props->GetHipActor()->GetUserMatrix()->GetElement(2, 3), 0.02, 1e-9);
  device.setTarget({ 0.01, 0.0, -0.002 });
  EXPECT_TRUE(waitFor([&] { return props->GetForceActor()->GetVisibility() != 0; }));
  EXPECT_GT(props->GetForceActor()->GetUserMatrix()->GetElement(2, 0), 0.0); // pushes up, out of the plane
  style_->SetServoLoop(nullptr);
  style_->SetDevice(nullptr);
  servo.stop();
}

TEST_F(InteractorStyleHaptic, ShowsHelpAndChartOnTheirKeys)
{
  vtkNew<vtkHapticOverlay> overlay;
  vtkNew<vtkHapticChart> chart;
  overlay->AddTo(renderer_);
  chart->GetRenderer()->SetViewport(0.0, 0.0, 1.0, 0.25);
  window_->AddRenderer(chart->GetRenderer());
  style_->SetOverlay(overlay);
  style_->SetChart(chart);
  this->press("h");
  EXPECT_TRUE(overlay->GetHelpVisibility());
  this->press("H");
  EXPECT_FALSE(overlay->GetHelpVisibility());
  this->press("c");
  EXPECT_FALSE(chart->GetVisibility());
  EXPECT_EQ(renderer_->GetViewport()[1], 0.0);
  this->press("c");
  EXPECT_TRUE(chart->GetVisibility());
  EXPECT_EQ(renderer_->GetViewport()[1], 0.25);
}

TEST_F(InteractorStyleHaptic, PassesDroppedFilesOn)
{
  vtkNew<vtkStringArray> files;
  files->InsertNextValue("cloud.ply");
  style_->OnDropFiles(files);
  EXPECT_EQ(drops_, 1);
}

TEST_F(InteractorStyleHaptic, WorksWithoutAnyPart)
{
  vtkNew<vtkInteractorStyleHaptic> bare;
  interactor_->SetInteractorStyle(bare);
  for (const char* key : { "x", "Left", "plus", "0", "f", "Prior", "h", "c", "s" })
  {
    this->press(key);
  }
  bare->Refresh();
  EXPECT_FALSE(bare->UpdateModel());
}

} // namespace
