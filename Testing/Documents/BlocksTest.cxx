// Includes each code block of headers and documents (ExtractBlocks.cmake) and looks at what it did.
#include "CommandRegistry.h"
#include "HapticViewer.h"
#include "pointhaptics.h"
#include "vtkCloudAxes.h"
#include "vtkHapticFeel.h"
#include "vtkHapticProps.h"
#include "vtkHapticSliders.h"
#include "vtkHapticTouch.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"
#include "vtkSplatMapper.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/SettingsMembers.h"
#include "Haptics/HapticScene.h"
#include "Haptics/Proxy.h"
#include "Haptics/ServoLoop.h"
#include "Unit/SkipWithoutDisplay.h"

#ifdef POINTHAPTICS_HAS_PCL
#include "PCL/VoxelMean.h"
#endif

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTable.h>
#include <vtkTransform.h>
#include <vtkTrivialProducer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

/// Names that blocks take for granted.
class Blocks : public testing::Test
{
protected:
  Blocks()
  {
    ball_->SetRadius(0.02);
    ball_->SetThetaResolution(100);
    ball_->SetPhiResolution(50);
    filter_->SetInputConnection(ball_->GetOutputPort());
    filter_->SetVoxelSize(0.001);
    filter_->Update();
    window->SetOffScreenRendering(1);
    window->AddRenderer(renderer);
    window->SetSize(200, 200);
    interactor->SetRenderWindow(window);
  }

  /// Ends the interactor after ten events of its timer, which it counts.
  void closeSoon()
  {
    end_->SetClientData(this);
    end_->SetCallback(
      [](vtkObject* caller, unsigned long, void* self, void*)
      {
        if (++static_cast<Blocks*>(self)->events == 10)
        {
          vtkRenderWindowInteractor::SafeDownCast(caller)->TerminateApp();
        }
      });
    interactor->AddObserver(vtkCommand::TimerEvent, end_);
  }

  /// Pixels of the window that are not black.
  std::ptrdiff_t lit()
  {
    renderer->ResetCamera();
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, 199, 199, 0, pixels);
    return pixels->GetNumberOfValues() -
      std::count(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues(), 0);
  }

  vtkNew<vtkSphereSource> ball_;
  vtkNew<vtkVoxelMeanResampler> filter_;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkCallbackCommand> end_;
  int events = 0;
};

TEST_F(Blocks, Readme)
{
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetInputConnection(ball_->GetOutputPort());
  writer->SetFileName("scan.ply");
  ASSERT_EQ(writer->Write(), 1);
  {
#include "README.inc"
    EXPECT_TRUE(bandwidth->GetOutput()->GetPointData()->HasArray("ProxyRadius"));
    EXPECT_GT(bandwidth->GetOutput()->GetNumberOfPoints(), 1000);
  }
  std::vector<pointhaptics::Vec3> points;
  for (vtkIdType i = 0; i < filter_->GetOutput()->GetNumberOfPoints(); ++i)
  {
    const double* p = filter_->GetOutput()->GetPoint(i);
    points.push_back({ p[0], p[1], p[2] });
  }
  const pointhaptics::Vec3 hand = { 0.0195, 0.0, 0.0 };
#include "README.2.inc"
  EXPECT_EQ(status, pointhaptics::Status::Ok);
  EXPECT_TRUE(std::isfinite(state.force.x));
}

TEST_F(Blocks, VoxelMeanResampler)
{
  vtkSphereSource* const reader = ball_;
  {
#include "vtkVoxelMeanResampler.inc"
    EXPECT_GT(resampler->GetOutput()->GetNumberOfPoints(), 1000);
  }
}

TEST_F(Blocks, SplatMapper)
{
  SKIP_WITHOUT_DISPLAY();
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  bandwidth->SetInputConnection(filter_->GetOutputPort());
  vtkNew<vtkSplatMapper> mapper;
#include "vtkSplatMapper.inc"
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  EXPECT_GT(lit(), 10000);
}

TEST_F(Blocks, HapticFeel)
{
  vtkSphereSource* const reader = ball_;
  vtkNew<vtkTable> path;
  const double rows[4][2] = { { 0, 0.2 }, { 0.03, 0.015 }, { 0, 0 }, { 0, 0 } };
  for (int column = 0; column < 4; ++column)
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName((const char*[]){ "t", "x", "y", "z" }[column]);
    values->InsertNextValue(rows[column][0]);
    values->InsertNextValue(rows[column][1]);
    path->AddColumn(values);
  }
  vtkNew<vtkTrivialProducer> table;
  table->SetOutput(path);
#include "vtkHapticFeel.inc"
  EXPECT_GT(vtkDataArray::SafeDownCast(feel->GetOutput()->GetColumnByName("force_x"))->GetRange()[1], 0.5);
}

TEST_F(Blocks, InteractorStyleHaptic)
{
  SKIP_WITHOUT_DISPLAY();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(filter_->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  vtkVoxelMeanResampler* const resampler = filter_;
  closeSoon();
#include "vtkInteractorStyleHaptic.inc"
  EXPECT_EQ(touch->GetMessage(), "");
  EXPECT_GE(events, 10);
  EXPECT_GT(lit(), 1000);
  interactor->SetInteractorStyle(nullptr);
}

TEST_F(Blocks, PropsAndAxes)
{
  SKIP_WITHOUT_DISPLAY();
  const double bounds[6] = { -0.05, 0.05, -0.05, 0.05, -0.05, 0.05 };
  pointhaptics::ServoLoop servoLoop;
  {
#include "vtkHapticProps.inc"
    EXPECT_GT(lit(), 0);
    props->RemoveFrom(renderer);
  }
  vtkPolyData* const cloud = filter_->GetOutput();
  vtkNew<vtkInteractorStyleHaptic> style;
#include "vtkCloudAxes.inc"
  EXPECT_GT(lit(), 100);
}

TEST_F(Blocks, Sliders)
{
  SKIP_WITHOUT_DISPLAY();
  vtkNew<vtkInteractorStyleHaptic> style;
  vtkNew<vtkHapticSliders> sliders;
#include "vtkHapticSliders.inc"
  EXPECT_EQ(style->GetSliders(), sliders);
}

TEST_F(Blocks, Commands)
{
  struct Grid
  {
    int toggles = 0;
    void toggle() { ++toggles; }
  } grid;
  pointhaptics::CommandRegistry commands;
#include "CommandRegistry.inc"
  EXPECT_TRUE(commands.run("grid"));
  EXPECT_EQ(grid.toggles, 1);
}

TEST_F(Blocks, TouchFromC)
{
  std::vector<double> xyz;
  for (vtkIdType i = 0; i < filter_->GetOutput()->GetNumberOfPoints(); ++i)
  {
    const double* p = filter_->GetOutput()->GetPoint(i);
    xyz.insert(xyz.end(), p, p + 3);
  }
  const double* const points = xyz.data();
  const std::size_t count = xyz.size() / 3;
  const double hand[3] = { 0.0195, 0.0, 0.0 };
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include "pointhaptics.inc"
#pragma GCC diagnostic pop
  EXPECT_EQ(state.struct_size, sizeof state);
  EXPECT_TRUE(std::isfinite(state.force[0]));
  ph_proxy_destroy(proxy);
  ph_scene_destroy(scene);
}

using pointhaptics::settingsMember;
struct BallSettings
{
  double radius = 1.0;
  bool filled = false;

#include "SettingsMembers.inc"
};
static_assert(pointhaptics::listsEveryMember<BallSettings>());

/// Needs a person, who closes the window: compiled alone.
[[maybe_unused]] void viewer()
{
  using namespace pointhaptics;
#include "HapticViewer.inc"
}

#ifdef POINTHAPTICS_HAS_PCL
TEST_F(Blocks, PclVoxelMean)
{
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->push_back({ 0.0F, 0.0F, 0.0F });
  cloud->push_back({ 0.002F, 0.0F, 0.0F });
  pcl::PointCloud<pcl::PointXYZ> means;
#include "VoxelMean.inc"
  ASSERT_EQ(means.size(), 1u);
  EXPECT_FLOAT_EQ(means[0].x, 0.001F);
}
#else
// "VoxelMean.inc"
#endif

} // namespace
