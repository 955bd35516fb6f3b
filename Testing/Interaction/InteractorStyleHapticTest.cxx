#include "InteractorStyleFixture.h"

#include "PointPicking.h"
#include "SteadyHand.h"
#include "SurfaceArrays.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProps.h"

#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkInteractorObserver.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <cmath>
#include <string>

using namespace pointhaptics;

namespace
{

class InteractorStyleHaptic : public InteractorStyleFixture
{
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

TEST_F(InteractorStyleHaptic, ShowsTheOldMeansWhereTheModelIsUntilTheNewOnesCome)
{
  vtkNew<vtkActor> cloud;
  style_->SetCloudActor(cloud);
  const auto shift = [&cloud]
  {
    cloud->ComputeMatrix();
    return cloud->GetMatrix()->GetElement(0, 3);
  };
  style_->UpdateModel();
  EXPECT_EQ(shift(), 0.0);
  for (int step = 1; step <= 3; ++step)
  {
    style_->GetModel().translate({ 0.002, 0.0, 0.0 });
    EXPECT_NEAR(shift(), 0.002 * step, 1e-12) << step;
  }
  style_->UpdateModel();
  EXPECT_NEAR(shift(), 0.0, 1e-12); // the new means are there themselves
  style_->GetModel().translate({ 0.002, 0.0, 0.0 });
  EXPECT_NEAR(shift(), 0.002, 1e-12);
}

TEST_F(InteractorStyleHaptic, ComputesArraysOfTheFeltSurfaceOnRequest)
{
  vtkPointData* data = bandwidth_->GetOutput()->GetPointData();
  EXPECT_FALSE(data->HasArray(kResidualArrayName));
  SceneOptions options;
  options.computeResiduals = true;
  options.computeNormals = true;
  style_->GetScenes().setOptions(options);
  EXPECT_TRUE(style_->IsModelChanged());
  style_->UpdateModel();
  EXPECT_TRUE(data->HasArray(kResidualArrayName));
  EXPECT_TRUE(data->HasArray(kSurfaceNormalArrayName));
  style_->GetScenes().setOptions(options);
  EXPECT_FALSE(style_->IsModelChanged()) << "nothing is other than it was";
  options.computeResiduals = false;
  style_->GetScenes().setOptions(options);
  style_->UpdateModel();
  EXPECT_FALSE(data->HasArray(kResidualArrayName));
  EXPECT_TRUE(data->HasArray(kSurfaceNormalArrayName));
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
  style_->GetModel().scale(0.5);
  style_->UpdateModel();
  const vtkIdType before = bandwidth_->GetOutput()->GetNumberOfPoints();
  style_->GetModel().scale(2.0);
  style_->UpdateModel();
  EXPECT_GT(bandwidth_->GetOutput()->GetNumberOfPoints(), before);
}

TEST_F(InteractorStyleHaptic, SaysThatTheModelHasLeftTheWorkspace)
{
  style_->GetModel().translate({ 1.0, 0.0, 0.0 });
  EXPECT_FALSE(style_->UpdateModel());
  EXPECT_EQ(sceneChanges_, 1);
  style_->GetModel().reset();
  EXPECT_TRUE(style_->UpdateModel());
}

TEST_F(InteractorStyleHaptic, IgnoresNumbersThatAreNone)
{
  style_->GetModel().scale(0.0);
  style_->GetModel().scale(-1.0);
  style_->GetModel().scale(NAN);
  style_->GetModel().rotate(NAN, { 1, 0, 0 });
  style_->GetModel().rotate(10, { 0, 0, 0 });
  style_->GetModel().translate({ NAN, 0, 0 });
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
  style_->GetModel().reset();
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
  EXPECT_TRUE(style_->GetHand().followsMouse());
  interactor_->SetEventInformation(100, 140, 0, 0);
  interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
  EXPECT_GT(device.target().y, 0.01);
  style_->GetHand().move({ 10, 10, 10 });
  EXPECT_DOUBLE_EQ(device.target().x, 0.05); // stays in the workspace
  style_->SetDevice(nullptr);
}

TEST_F(InteractorStyleHaptic, MovesThePropsFromTheTimer)
{
  pointhaptics::trial::SteadyHand hand({ 0.01, 0.0, 0.02 });
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer_);
  hand.begin(style_);
  style_->SetProps(props);
  // A radius above 0 tells that the servo thread has the scene; before that a hand below the plane is in free
  // space.
  EXPECT_TRUE(this->eventually(
    [&] { return props->GetHipActor()->GetVisibility() != 0 && hand.servo.latest().state.radius > 0.0; }));
  EXPECT_NEAR(props->GetHipActor()->GetUserMatrix()->GetElement(2, 3), 0.02, 1e-9);
  hand.device.setTarget({ 0.01, 0.0, -0.002 });
  EXPECT_TRUE(this->eventually([&] { return props->GetForceActor()->GetVisibility() != 0; }));
  EXPECT_GT(props->GetForceActor()->GetUserMatrix()->GetElement(2, 0), 0.0); // pushes up, out of the plane
}

TEST_F(InteractorStyleHaptic, TakesBackTheLastMoveAsAWhole)
{
  this->press("x");
  const double turned = this->element(1, 1);
  interactor_->SetEventInformation(100, 100, 0, 1);
  interactor_->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  for (int x = 101; x < 130; ++x)
  {
    interactor_->SetEventInformation(x, 100, 0, 1);
    interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
  }
  interactor_->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
  EXPECT_GT(std::abs(this->element(0, 2)), 0.1);
  this->press("u");
  EXPECT_EQ(this->element(0, 2), 0.0);
  EXPECT_EQ(this->element(1, 1), turned);
  EXPECT_TRUE(style_->IsModelChanged());
  this->press("u");
  EXPECT_TRUE(this->modelIsIdentity());
  EXPECT_FALSE(style_->GetModel().undo());
}

TEST_F(InteractorStyleHaptic, TakesAResetBackButNotTheMatrixOfAnotherCloud)
{
  style_->GetModel().scale(2.0);
  style_->GetModel().reset();
  style_->GetModel().reset(); // changes nothing
  EXPECT_TRUE(style_->GetModel().undo());
  EXPECT_EQ(this->element(0, 0), 2.0);
  vtkNew<vtkMatrix4x4> other;
  style_->SetModelMatrix(other);
  EXPECT_FALSE(style_->GetModel().undo());
}

TEST_F(InteractorStyleHaptic, DoesOnAnotherKeyWhatItIsToldTo)
{
  vtkNew<vtkHapticOverlay> overlay;
  style_->SetOverlay(overlay);
  style_->GetCommands().bind("rotate-x", "F5");
  EXPECT_EQ(style_->GetCommands().bindings("rotate-x"), "F5");
  EXPECT_NE(overlay->GetHelp().find("F5"), std::string::npos);
  this->press("F5");
  EXPECT_FALSE(this->modelIsIdentity());
  this->press("u");
  style_->GetCommands().bind("rotate-model-drag", "left");
  this->drag(vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent, 30, 0, false, false);
  EXPECT_FALSE(this->modelIsIdentity());
}

TEST_F(InteractorStyleHaptic, PicksTheMeanUnderTheMouseAlsoInAPartOfTheWindow)
{
  vtkNew<vtkHapticOverlay> overlay;
  style_->SetOverlay(overlay);
  renderer_->SetViewport(0.0, 0.25, 1.0, 1.0);
  window_->Render();
  vtkPolyData* cloud = bandwidth_->GetOutput();
  const vtkIdType wanted = cloud->FindPoint(0.012, -0.007, 0.0);
  double p[3];
  cloud->GetPoint(wanted, p);
  double display[3];
  vtkInteractorObserver::ComputeWorldToDisplay(renderer_, p[0], p[1], p[2], display);
  PickedPoint picked;
  ASSERT_TRUE(pickPoint(cloud, renderer_, display[0], display[1], 0.5, picked));
  EXPECT_EQ(picked.index, wanted);
  EXPECT_NEAR(picked.inCloud->x, p[0], 1e-12);
  EXPECT_EQ(picked.voxel->x, std::floor((p[0] + 0.05) / 0.001));
  interactor_->SetEventInformation(int(display[0]), int(display[1]), 0, 0);
  interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
  this->press("p");
  EXPECT_NE(overlay->GetDetail().find("bandwidth"), std::string::npos) << overlay->GetDetail();
  EXPECT_NEAR(picked.voxelBounds->minimum.x, -0.05 + 0.001 * picked.voxel->x, 1e-12);
  EXPECT_NEAR(picked.voxelBounds->extent().y, 0.001, 1e-12);
  EXPECT_FALSE(style_->GetPicker().pickAt(1, 199));
  EXPECT_EQ(overlay->GetDetail(), "");
  EXPECT_TRUE(style_->GetPicker().pickAt(int(display[0]), int(display[1])));
  this->press("x");
  EXPECT_EQ(overlay->GetDetail(), "") << "another place has another voxel";
}

TEST_F(InteractorStyleHaptic, MeasuresAtThePickedPointWhatTheFilterComputesForAll)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputConnection(resampler_->GetOutputPort());
  filter->ComputeBandwidthOn();
  filter->ComputeProxyRadiusOn();
  for (const bool ball : { false, true })
  {
    ball ? filter->SetNeighborhoodToFixedRadius() : filter->SetNeighborhoodToKNearest();
    filter->SetRadius(0.004);
    filter->Update();
    vtkPolyData* cloud = filter->GetOutput();
    PickedPoint picked;
    picked.index = 40;
    cloud->GetPoint(picked.index, &picked.inWorkspace.x);
    ASSERT_EQ(measurePicked(cloud, filter->GetSettings(), picked), Status::Ok);
    vtkDataArray* bandwidths = cloud->GetPointData()->GetArray("Bandwidth");
    vtkDataArray* radii = cloud->GetPointData()->GetArray("ProxyRadius");
    EXPECT_NEAR(picked.bandwidth, bandwidths->GetComponent(40, 0), 1e-9 * picked.bandwidth);
    EXPECT_NEAR(picked.radius, radii->GetComponent(40, 0), 1e-9 * picked.radius);
  }
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
  for (const char* key :
    { "x", "Left", "plus", "0", "f", "Prior", "h", "c", "s", "u", "p", "v", "i", "t", "n", "w" })
  {
    this->press(key);
  }
  bare->Refresh();
  EXPECT_FALSE(bare->UpdateModel());
}

TEST_F(InteractorStyleHaptic, WarnsOfAPathInAnotherUnit)
{
  HipPath path;
  path.points = { { 0.0, { 0.0, 0.0, 70.0 } }, { 1.0, { 10.0, 0.0, 10.0 } } };
  SimulatedDevice inMillimetres;
  inMillimetres.setPath(path);
  applyUnits({ 1e-3, 1.0 }, path);
  SimulatedDevice inMetres;
  inMetres.setPath(path);
  int warnings = 0;
  this->count(vtkCommand::WarningEvent, warnings);
  style_->SetDevice(&inMetres);
  style_->StartUpdates();
  EXPECT_EQ(warnings, 0);
  style_->SetDevice(&inMillimetres);
  style_->StartUpdates();
  EXPECT_EQ(warnings, 1);
  style_->StartUpdates();
  EXPECT_EQ(warnings, 1);
  EXPECT_NE(style_->JudgeUnits({ "--unit", "--path-unit", {} }).find("--path-unit mm"), std::string::npos);
}

} // namespace
