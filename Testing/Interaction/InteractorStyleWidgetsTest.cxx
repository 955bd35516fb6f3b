// The style with what is drawn over the cloud: overlay, chart and sliders.
#include "InteractorStyleFixture.h"

#include "Unit/SkipWithoutDisplay.h"

#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticSliders.h"

#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <vtkActor2D.h>
#include <vtkActor2DCollection.h>
#include <vtkAxis.h>
#include <vtkCallbackCommand.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <vector>

using namespace pointhaptics;

namespace
{

class InteractorStyleWidgets : public InteractorStyleFixture
{
};

TEST_F(InteractorStyleWidgets, ShowsHelpAndChartOnTheirKeys)
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

TEST_F(InteractorStyleWidgets, TheTextsOfAChartEndWithinIt)
{
  SKIP_WITHOUT_DISPLAY();
  struct Case
  {
    int width, height, dotsPerInch;
  };
  for (const Case& asked : { Case{ 576, 108, 97 }, Case{ 1600, 500, 230 } })
  {
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkHapticChart> chart;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(asked.width, asked.height);
    window->SetDPI(asked.dotsPerInch);
    window->AddRenderer(chart->GetRenderer());
    chart->AddSample(0.0, 0.0, 0.00109);
    chart->AddSample(1.0, 0.0, 0.00109);
    window->Render();
    chart->Update();
    window->Render();
    for (const int row : { 0, asked.height - 1 })
    {
      vtkNew<vtkUnsignedCharArray> data;
      window->GetPixelData(0, row, asked.width - 1, row, 0, data);
      int inked = 0;
      for (vtkIdType i = 0; i < data->GetNumberOfValues(); ++i)
      {
        inked += data->GetValue(i) < 250;
      }
      EXPECT_EQ(inked, 0) << "row " << row << " at " << asked.dotsPerInch << " dots per inch";
    }
    window->RemoveRenderer(chart->GetRenderer());
  }
}

TEST_F(InteractorStyleWidgets, KeepsThePictureOfAChartThatDidNotChange)
{
  vtkNew<vtkHapticOverlay> overlay;
  vtkNew<vtkHapticChart> chart;
  overlay->AddTo(renderer_);
  chart->GetRenderer()->SetViewport(0.0, 0.0, 1.0, 0.5);
  renderer_->SetViewport(0.0, 0.5, 1.0, 1.0);
  window_->AddRenderer(chart->GetRenderer());
  style_->SetOverlay(overlay);
  style_->SetChart(chart);
  chart->AddSample(0.0, 1.0, 0.001);
  chart->AddSample(1.0, 2.0, 0.001);
  chart->Update();
  const auto chartPixels = [this]
  {
    vtkNew<vtkUnsignedCharArray> data;
    window_->GetPixelData(0, 0, 199, 99, 0, data);
    return std::vector<unsigned char>(data->GetPointer(0), data->GetPointer(0) + data->GetNumberOfValues());
  };
  int drawings = 0;
  int frames = 0;
  const auto countStarts = [](vtkRenderer* renderer, int& counter)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&counter);
    command->SetCallback(
      [](vtkObject*, unsigned long, void* client, void*) { ++*static_cast<int*>(client); });
    renderer->AddObserver(vtkCommand::StartEvent, command);
  };
  countStarts(renderer_, frames);
  countStarts(chart->GetRenderer(), drawings);
  const auto draw = [&](const char* note)
  {
    style_->GetStatus().setNote(note);
    const int before = frames;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (frames == before && std::chrono::steady_clock::now() < deadline)
    {
      style_->Refresh(); // renders once its share of the time has come
    }
    EXPECT_EQ(frames, before + 1) << note;
  };
  interactor_->Initialize();
  draw("first");
  const std::vector<unsigned char> first = chartPixels();
  EXPECT_GT(drawings, 0);
  drawings = 0;
  draw("second");
  EXPECT_EQ(drawings, 0);
  EXPECT_EQ(chartPixels(), first);
  EXPECT_TRUE(chart->GetVisibility());
  this->press("c"); // hides it, and shows it again
  this->press("c");
  draw("third");
  EXPECT_GT(drawings, 0);
}

TEST_F(InteractorStyleWidgets, ShowsTheServoPanelWithTheDevice)
{
  vtkNew<vtkHapticOverlay> overlay;
  style_->SetOverlay(overlay);
  style_->GetStatus().setDeviceNote("falcon, unhomed");
  style_->Refresh();
  EXPECT_EQ(overlay->GetPanel(), "");
  this->press("i");
  style_->Refresh();
  EXPECT_EQ(overlay->GetPanel(), "servo loop: none\ndevice: falcon, unhomed");
  ServoLoop servo;
  SimulatedDevice device;
  style_->SetServoLoop(&servo);
  ASSERT_EQ(servo.start(device, {}), Status::Ok);
  style_->GetStatus().setDeviceNote("simulated");
  style_->Refresh();
  servo.stop();
  style_->SetServoLoop(nullptr);
  EXPECT_NE(overlay->GetPanel().find("running"), std::string::npos);
  EXPECT_NE(overlay->GetPanel().find("deadline misses"), std::string::npos);
}

TEST_F(InteractorStyleWidgets, KeepsAPausedChartAsItIs)
{
  vtkNew<vtkHapticChart> chart;
  style_->SetChart(chart);
  chart->AddSample(0.0, 1.0, 0.001);
  chart->AddSample(1.0, 2.0, 0.001);
  EXPECT_TRUE(chart->Update());
  this->press("t");
  EXPECT_TRUE(chart->GetPaused());
  chart->AddSample(2.0, 3.0, 0.001);
  EXPECT_FALSE(chart->Update());
  this->press("t");
  EXPECT_TRUE(chart->Update());
}

TEST_F(InteractorStyleWidgets, SurvivesAPressOnASliderThatIsNotDrawnYet)
{
  vtkNew<vtkHapticSliders> sliders;
  sliders->SetInteractor(interactor_);
  style_->SetSliders(sliders);
  window_->SetSize(800, 600);
  window_->Render();
  this->press("v");
  interactor_->SetEventInformation(int(0.836 * 800), int(600 * (0.30 + 2 * 0.1)));
  interactor_->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  interactor_->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
  EXPECT_EQ(sliders->GetValue(vtkHapticSliders::Friction), 0.0);
}

TEST_F(InteractorStyleWidgets, MovesASliderByTheMouseAndNothingElse)
{
  vtkNew<vtkHapticSliders> sliders;
  sliders->SetInteractor(interactor_);
  style_->SetSliders(sliders);
  window_->SetSize(800, 600);
  this->press("v");
  EXPECT_TRUE(sliders->GetVisibility());
  window_->Render();
  int moved = -1;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&moved);
  command->SetCallback([](vtkObject*, unsigned long, void* client, void* slider)
    { *static_cast<int*>(client) = *static_cast<int*>(slider); });
  sliders->AddObserver(vtkHapticSliders::ValueChangedEvent, command);
  // Friction starts at the left end of its way; see the positions in vtkHapticSliders.
  const int row = int(600 * (0.30 + 2 * 0.1));
  double before[3];
  renderer_->GetActiveCamera()->GetPosition(before);
  interactor_->SetEventInformation(int(0.836 * 800), row);
  interactor_->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  interactor_->SetEventInformation(int(0.905 * 800), row);
  interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
  interactor_->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
  EXPECT_EQ(moved, vtkHapticSliders::Friction);
  EXPECT_NEAR(sliders->GetValue(vtkHapticSliders::Friction), 0.5, 0.1);
  EXPECT_EQ(renderer_->GetActiveCamera()->GetPosition()[0], before[0]);
  this->press("i"); // the key VTK's widgets would switch themselves off with
  window_->Render();
  this->press("v");
  EXPECT_FALSE(sliders->GetVisibility());
  sliders->SetInteractor(nullptr);
}

int numberOfVisibleTexts(vtkRenderer* renderer)
{
  vtkActor2DCollection* actors = renderer->GetActors2D();
  int count = 0;
  for (int i = 0; i < actors->GetNumberOfItems(); ++i)
  {
    count += vtkActor2D::SafeDownCast(actors->GetItemAsObject(i))->GetVisibility() != 0 ? 1 : 0;
  }
  return count;
}

/// The radius is read from its axis only if there is a number beside that of 0.
TEST(HapticChart, HasLabelsThatTellTheScaleOfALowChart)
{
  SKIP_WITHOUT_DISPLAY();
  for (const int height : { 115, 400 })
  {
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkHapticChart> chart;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(640, height);
    window->SetDPI(72);
    window->AddRenderer(chart->GetRenderer());
    for (int i = 0; i < 2000; ++i)
    {
      chart->AddSample(0.001 * i, 0.13, 0.00054);
    }
    chart->Update();
    window->Render();
    auto* context = vtkContextActor::SafeDownCast(chart->GetRenderer()->GetViewProps()->GetLastProp());
    ASSERT_TRUE(context);
    auto* drawn = vtkChartXY::SafeDownCast(context->GetScene()->GetItem(0));
    ASSERT_TRUE(drawn);
    EXPECT_NEAR(drawn->GetAxis(vtkAxis::RIGHT)->GetMaximum(), height < 200 ? 1.0 : 0.6, 1e-9);
    for (const int axis : { vtkAxis::LEFT, vtkAxis::RIGHT })
    {
      EXPECT_GE(drawn->GetAxis(axis)->GetTickLabels()->GetNumberOfTuples(), 2) << height << " axis " << axis;
    }
  }
}

TEST(HapticChart, HasTitlesOfOneSizeThatFollowTheWindow)
{
  SKIP_WITHOUT_DISPLAY();
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkHapticChart> chart;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetDPI(97);
  window->AddRenderer(chart->GetRenderer());
  auto* context = vtkContextActor::SafeDownCast(chart->GetRenderer()->GetViewProps()->GetLastProp());
  auto* drawn = vtkChartXY::SafeDownCast(context->GetScene()->GetItem(0));
  int sizes[2] = {};
  for (const int height : { 108, 400 })
  {
    window->SetSize(576, height);
    window->Render();
    chart->Update();
    int& size = sizes[height > 200];
    size = drawn->GetAxis(vtkAxis::LEFT)->GetTitleProperties()->GetFontSize();
    for (const int axis : { vtkAxis::RIGHT, vtkAxis::BOTTOM })
    {
      EXPECT_EQ(drawn->GetAxis(axis)->GetTitleProperties()->GetFontSize(), size)
        << height << " axis " << axis;
    }
  }
  EXPECT_LT(sizes[0], sizes[1]);
  window->SetSize(360, 45);
  window->Render();
  chart->Update();
  EXPECT_EQ(drawn->GetAxis(vtkAxis::RIGHT)->GetTitle(), "mm") << "the longer one would be cut";
  window->RemoveRenderer(chart->GetRenderer());
}

#ifdef __linux__
TEST(HapticChart, SaysThatTheDiskIsFull)
{
  SKIP_WITHOUT_DISPLAY();
  if (!std::filesystem::is_character_file("/dev/full"))
  {
    GTEST_SKIP() << "no /dev/full on this system";
  }
  vtkNew<vtkHapticChart> chart;
  chart->AddSample(0.0, 1.0, 0.001);
  chart->AddSample(1.0, 1.0, 0.001);
  vtkNew<vtkCallbackCommand> silence;
  silence->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  chart->AddObserver(vtkCommand::ErrorEvent, silence);
  EXPECT_FALSE(chart->WriteImage("/dev/full"));
  EXPECT_EQ(chart->GetErrorMessage(),
    "/dev/full: cannot be written: No space left on device; free some space on the disk or write elsewhere");
}
#endif

TEST(HapticOverlay, ShowsTheHelpAlsoWhereItsOtherTextsAreHidden)
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkHapticOverlay> overlay;
  overlay->AddTo(renderer);
  overlay->SetStatus("status");
  overlay->SetDetail("detail");
  EXPECT_EQ(numberOfVisibleTexts(renderer), 2);
  overlay->SetTextVisibility(false);
  overlay->SetStatus("another status");
  overlay->SetPanel("panel");
  EXPECT_EQ(numberOfVisibleTexts(renderer), 0);
  overlay->SetHelpVisibility(true);
  EXPECT_EQ(numberOfVisibleTexts(renderer), 1);
  overlay->SetHelpVisibility(false);
  overlay->SetTextVisibility(true);
  EXPECT_EQ(numberOfVisibleTexts(renderer), 3);
}

TEST(HapticSliders, MoveLengthsInProportionAndIgnoreWhatIsNoNumber)
{
  vtkNew<vtkHapticSliders> sliders;
  sliders->MoveTo(vtkHapticSliders::Stiffness, 0.5);
  EXPECT_NEAR(sliders->GetValue(vtkHapticSliders::Stiffness), 500.0, 1e-9); // between 50 and 5000
  sliders->MoveTo(vtkHapticSliders::Friction, 0.25);
  EXPECT_NEAR(sliders->GetValue(vtkHapticSliders::Friction), 0.25, 1e-12);
  sliders->SetValue(vtkHapticSliders::Stiffness, -1.0);
  sliders->SetValue(vtkHapticSliders::Stiffness, NAN);
  EXPECT_NEAR(sliders->GetValue(vtkHapticSliders::Stiffness), 500.0, 1e-9);
  sliders->SetValue(vtkHapticSliders::Stiffness, 20000.0);
  sliders->MoveTo(vtkHapticSliders::Stiffness, 2.0);
  EXPECT_NEAR(sliders->GetValue(vtkHapticSliders::Stiffness), 20000.0, 1e-6);
}

} // namespace
