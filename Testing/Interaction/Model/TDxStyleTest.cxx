// A 3D mouse that VTK reads: its events move the model. No window, no display, no device.
#include "vtkInteractorStyleHaptic.h"
#include "vtkTDxInteractorStyleModel.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTDxInteractorStyleSettings.h>
#include <vtkTDxMotionEventInfo.h>

#include <cmath>
#include <limits>

namespace
{

class TDxStyle : public ::testing::Test
{
protected:
  TDxStyle()
  {
    renderer->GetActiveCamera()->SetPosition(0.4, 0, 0); // the screen's right is the workspace's -z
    renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    renderer->GetActiveCamera()->SetViewUp(0, 1, 0);
    style->SetDefaultRenderer(renderer);
    interactor->SetInteractorStyle(style);
  }
  void move(vtkTDxMotionEventInfo info) { interactor->InvokeEvent(vtkCommand::TDxMotionEvent, &info); }
  void button(unsigned long event, int button) { interactor->InvokeEvent(event, &button); }
  double element(int row, int column)
  {
    return style->GetModelTransform()->GetMatrix()->GetElement(row, column);
  }

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkSmartPointer<vtkInteractorStyleHaptic> style = vtkSmartPointer<vtkInteractorStyleHaptic>::New();
};

constexpr vtkTDxMotionEventInfo kRight{ 350.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
constexpr vtkTDxMotionEventInfo kTowards{ 0.0, 0.0, 350.0, 0.0, 0.0, 0.0, 0.0 };
constexpr vtkTDxMotionEventInfo kTurnAboutUp{ 0.0, 0.0, 0.0, 350.0, 0.0, 1.0, 0.0 };

} // namespace

TEST_F(TDxStyle, TranslatesTheModelAsTheCapIsPushedOnTheScreen)
{
  this->move(kRight);
  // Half of the 10 cm workspace in a second; an event after a pause stands for a sixtieth of one.
  EXPECT_NEAR(this->element(2, 3), -0.05 / 60.0, 1e-9);
  EXPECT_NEAR(this->element(0, 3), 0.0, 1e-12);
  EXPECT_NEAR(this->element(1, 3), 0.0, 1e-12);
}

TEST_F(TDxStyle, RotatesTheModelAsTheCapIsTurned)
{
  this->move(kTurnAboutUp);
  const double angle = 1.5 / 180.0 * std::acos(-1.0); // 90 degrees in a second
  EXPECT_NEAR(this->element(0, 2), std::sin(angle), 1e-9);
  EXPECT_NEAR(this->element(1, 1), 1.0, 1e-12);
}

TEST_F(TDxStyle, ScalesWithTheFirstButtonAndResetsWithTheSecond)
{
  this->button(vtkCommand::TDxButtonPressEvent, 1);
  this->move(kTowards);
  EXPECT_NEAR(this->element(0, 0), std::pow(2.0, 1.0 / 60.0), 1e-9);
  EXPECT_NEAR(this->element(0, 3), 0.0, 1e-12);
  this->button(vtkCommand::TDxButtonReleaseEvent, 1);
  this->move(kTowards);
  EXPECT_GT(this->element(0, 3), 0.0) << "towards the person";
  this->button(vtkCommand::TDxButtonPressEvent, 2);
  EXPECT_TRUE(style->GetModelTransform()->GetMatrix()->IsIdentity());
}

TEST_F(TDxStyle, KeepsToTheSettingsOfVTK)
{
  vtkTDxInteractorStyleSettings* settings = style->GetTDxStyle()->GetSettings();
  settings->SetTranslationXSensitivity(-0.5);
  settings->SetUseRotationY(false);
  this->move(kRight);
  EXPECT_NEAR(this->element(2, 3), 0.5 * 0.05 / 60.0, 1e-9);
  this->move(kTurnAboutUp);
  EXPECT_EQ(this->element(0, 2), 0.0);
}

TEST_F(TDxStyle, IsOneChangeToUndoAndIgnoresWhatIsNoNumber)
{
  for (int i = 0; i < 5; ++i)
  {
    this->move(kRight);
  }
  this->move({ std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 });
  EXPECT_LT(this->element(2, 3), 0.0);
  EXPECT_TRUE(style->GetModel().undo());
  EXPECT_TRUE(style->GetModelTransform()->GetMatrix()->IsIdentity());
  EXPECT_FALSE(style->GetModel().undo());
}

TEST_F(TDxStyle, MovesNothingOnceTheStyleIsGone)
{
  const vtkSmartPointer<vtkTDxInteractorStyle> tdx = style->GetTDxStyle();
  interactor->SetInteractorStyle(nullptr);
  style = nullptr;
  vtkTDxMotionEventInfo info = kRight;
  tdx->OnMotionEvent(&info);
  tdx->OnButtonPressedEvent(2);
}
