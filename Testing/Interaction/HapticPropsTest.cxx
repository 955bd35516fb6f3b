#include "vtkHapticGauge.h"
#include "vtkHapticProps.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <cmath>

using namespace pointhaptics;

namespace
{

ProxyState makeContact()
{
  ProxyState state;
  state.contact = true;
  state.hip = { 0.01, 0.0, -0.002 };
  state.proxy = { 0.01, 0.0, 0.0 };
  state.normal = { 0.0, 0.0, 1.0 };
  state.force = { 0.0, 0.0, 1.6 };
  state.radius = 0.003;
  state.sphereCenter = { 0.01, 0.0, 0.003 };
  return state;
}

TEST(HapticProps, ShowsNothingOfATouchBeforeTheFirst)
{
  vtkNew<vtkHapticProps> props;
  EXPECT_FALSE(props->GetProxyActor()->GetVisibility());
  EXPECT_FALSE(props->GetHipActor()->GetVisibility());
  EXPECT_TRUE(props->GetWorkspaceActor()->GetVisibility());
}

TEST(HapticProps, PlacesSphereNormalAndArrow)
{
  vtkNew<vtkHapticProps> props;
  EXPECT_TRUE(props->Update(makeContact()));
  vtkMatrix4x4* sphere = props->GetProxyActor()->GetUserMatrix();
  EXPECT_DOUBLE_EQ(sphere->GetElement(2, 3), 0.003);
  EXPECT_DOUBLE_EQ(sphere->GetElement(0, 0), 0.003); // its radius
  vtkMatrix4x4* normal = props->GetNormalActor()->GetUserMatrix();
  EXPECT_DOUBLE_EQ(normal->GetElement(2, 3), 0.0);
  EXPECT_GT(normal->GetElement(2, 0), 0.0); // along +z
  vtkMatrix4x4* arrow = props->GetForceActor()->GetUserMatrix();
  EXPECT_DOUBLE_EQ(arrow->GetElement(2, 0), 0.0096); // 1.6 N
  EXPECT_DOUBLE_EQ(arrow->GetElement(2, 3), 0.003);  // from the sphere's centre
  EXPECT_EQ(props->GetProxyActor()->GetProperty()->GetOpacity(), 1.0);
}

TEST(HapticProps, DrawASmallSphereLargerOnTheSameContactPoint)
{
  vtkNew<vtkHapticProps> props;
  props->SetSmallestSphereRadius(0.005);
  props->Update(makeContact());
  vtkMatrix4x4* sphere = props->GetProxyActor()->GetUserMatrix();
  EXPECT_DOUBLE_EQ(sphere->GetElement(0, 0), 0.005);
  EXPECT_DOUBLE_EQ(sphere->GetElement(2, 3), 0.005);
}

/// Three points a metre apart: the camera would be in the sphere, and the window pink.
TEST(HapticProps, HideASphereLargerThanTheWorkspace)
{
  vtkNew<vtkHapticProps> props; // the workspace's edge is 0.1 m
  ProxyState state = makeContact();
  state.radius = 0.06;
  props->Update(state);
  EXPECT_FALSE(props->GetProxyActor()->GetVisibility());
  EXPECT_TRUE(props->GetNormalActor()->GetVisibility());
  state.radius = 0.04;
  props->Update(state);
  EXPECT_TRUE(props->GetProxyActor()->GetVisibility());
}

/// A small sphere that is drawn larger hides no more of a close view than of the whole cloud.
TEST(HapticProps, LimitWhatIsDrawnLargerOnTheScreen)
{
  constexpr int kHeight = 800;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  window->SetOffScreenRendering(1);
  window->SetSize(kHeight, kHeight);
  window->SetDPI(72);
  window->AddRenderer(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer);
  props->SetSmallestSphereRadius(0.0022);
  ProxyState state = makeContact();
  state.radius = 0.0004;
  state.sphereCenter = state.proxy + state.radius * state.normal;
  const auto radiusFrom = [&](double distance)
  {
    camera->SetFocalPoint(&state.sphereCenter.x);
    camera->SetPosition(state.sphereCenter.x, state.sphereCenter.y - distance, state.sphereCenter.z);
    camera->SetViewUp(0.0, 0.0, 1.0);
    renderer->InvokeEvent(vtkCommand::StartEvent);
    return props->GetProxyActor()->GetUserMatrix()->GetElement(0, 0);
  };
  const double pixelAtOneMetre =
    2.0 * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle())) / kHeight;
  props->Update(state);
  EXPECT_DOUBLE_EQ(radiusFrom(0.3), 0.0022);
  EXPECT_NEAR(radiusFrom(0.05), 24.0 * 0.05 * pixelAtOneMetre, 1e-6);
  vtkMatrix4x4* sphere = props->GetProxyActor()->GetUserMatrix();
  EXPECT_NEAR(sphere->GetElement(2, 3), sphere->GetElement(0, 0), 1e-12) << "it leaves the contact point";
  EXPECT_DOUBLE_EQ(props->GetForceActor()->GetUserMatrix()->GetElement(2, 3), sphere->GetElement(2, 3));
  EXPECT_DOUBLE_EQ(radiusFrom(0.002), 0.0004) << "no smaller than it is";
  EXPECT_DOUBLE_EQ(radiusFrom(0.3), 0.0022);
  props->RemoveFrom(renderer);
}

TEST(HapticProps, AreTranslucentWithoutNormalInFreeSpace)
{
  ProxyState state = makeContact();
  state.contact = false;
  vtkNew<vtkHapticProps> props;
  props->Update(state);
  EXPECT_TRUE(props->GetProxyActor()->GetVisibility());
  EXPECT_LT(props->GetProxyActor()->GetProperty()->GetOpacity(), 1.0);
  EXPECT_FALSE(props->GetNormalActor()->GetVisibility());
  EXPECT_FALSE(props->GetForceActor()->GetVisibility());
}

TEST(HapticProps, SayWhetherARenderIsWorthwhile)
{
  vtkNew<vtkHapticProps> props;
  ProxyState state = makeContact();
  EXPECT_TRUE(props->Update(state));
  EXPECT_FALSE(props->Update(state));
  state.hip.x += 1e-3;
  EXPECT_TRUE(props->Update(state));
  state.hip.x = NAN;
  EXPECT_FALSE(props->Update(state));
}

TEST(HapticProps, ShowTheGaugeOnTheArrowsSideAndOnlyWhereThereIsForce)
{
  vtkNew<vtkRenderer> renderer;
  renderer->GetActiveCamera()->SetPosition(0, -1, 0);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer);
  EXPECT_FALSE(props->GetGauge()->GetVisibility());
  ProxyState state = makeContact();
  state.force = { 1.6, 0.0, 0.0 };
  props->Update(state);
  EXPECT_TRUE(props->GetGauge()->GetVisibility());
  EXPECT_FALSE(props->GetGauge()->GetLeft());
  state.force = { -1.6, 0.0, 0.0 };
  props->Update(state);
  EXPECT_TRUE(props->GetGauge()->GetLeft());
  state.force = {};
  props->Update(state);
  EXPECT_FALSE(props->GetGauge()->GetVisibility()) << "there is nothing to gauge";
}

TEST(HapticProps, LiftAnArrowThatIsSeenEndOnOffTheSphere)
{
  vtkNew<vtkRenderer> renderer;
  renderer->GetActiveCamera()->SetPosition(0, 0, 1);
  renderer->GetActiveCamera()->SetViewUp(0, 1, 0);
  vtkNew<vtkHapticProps> props;
  props->AddTo(renderer);
  props->Update(makeContact()); // its force is along z
  vtkMatrix4x4* arrow = props->GetForceActor()->GetUserMatrix();
  vtkMatrix4x4* sphere = props->GetProxyActor()->GetUserMatrix();
  const auto above = [arrow, sphere] { return arrow->GetElement(1, 3) - sphere->GetElement(1, 3); };
  EXPECT_GT(above(), sphere->GetElement(0, 0));
  EXPECT_NEAR(arrow->GetElement(0, 3), sphere->GetElement(0, 3), 1e-9);
  ProxyState aside = makeContact();
  aside.force = { 1.6, 0.0, 0.0 };
  props->Update(aside);
  EXPECT_NEAR(above(), 0.0, 1e-9) << "it is seen from its side";
}

TEST(HapticProps, CutAnArrowThatWouldLeaveTheWorkspace)
{
  vtkNew<vtkHapticProps> props;
  ProxyState state = makeContact();
  state.force = { 0.0, 0.0, 1e6 };
  props->Update(state);
  EXPECT_LE(props->GetForceActor()->GetUserMatrix()->GetElement(2, 0), 0.05);
}

} // namespace
