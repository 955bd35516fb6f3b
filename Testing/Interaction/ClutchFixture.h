/// @file
/// A model under a hand that is not a mouse: pipeline, style and servo loop, no window, no display.
#pragma once

#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "../Unit/Eventually.h"

#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

namespace pointhaptics
{
namespace trial
{

/// A strip at z = 0, points 1 mm apart: from @p x0 to @p x1, 4 cm wide; metres.
inline vtkSmartPointer<vtkPolyData> strip(double x0, double x1)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i <= int(std::lround((x1 - x0) / 0.001)); ++i)
  {
    for (int j = -20; j <= 20; ++j)
    {
      points->InsertNextPoint(x0 + 0.001 * i, 0.001 * j, 0.0);
    }
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

/// The device is the test's. Whoever derives calls letGo() before the device goes.
class ClutchFixture : public ::testing::Test
{
protected:
  ClutchFixture()
  {
    renderer->GetActiveCamera()->SetPosition(0, 0, 0.4);
    renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    renderer->GetActiveCamera()->SetViewUp(0, 1, 0);
    style->SetDefaultRenderer(renderer);
    style->SetServoLoop(&servo);
    resampler->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    resampler->SetDimensions(100, 100, 100);
    bandwidth->SetInputConnection(resampler->GetOutputPort());
  }
  void letGo()
  {
    servo.stop();
    style->SetServoLoop(nullptr);
  }
  /// The strip is there to be felt, by the hand at @p port.
  void begin(HandPort& port, double x0, double x1)
  {
    resampler->SetInputData(strip(x0, x1));
    style->SetResampler(resampler);
    style->SetBandwidthFilter(bandwidth);
    style->UpdateModel();
    ServoSettings settings;
    settings.realtimePriority = false;
    ASSERT_EQ(servo.start(port, HapticParameters(), settings), Status::Ok);
    ASSERT_TRUE(eventually([&] { return servo.latest().tick > 2; }));
  }
  /// As the timer does it, until the hand feels the model where it is now.
  void settle()
  {
    for (int i = 0; i < 5000 && (style->IsModelChanged() || i < 3); ++i)
    {
      style->Refresh();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_FALSE(style->IsModelChanged());
  }
  /// Of the model's matrix.
  double element(int row, int column)
  {
    return style->GetModelTransform()->GetMatrix()->GetElement(row, column);
  }

  vtkNew<vtkVoxelMeanResampler> resampler;
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkInteractorStyleHaptic> style;
  ServoLoop servo;
};

} // namespace trial
} // namespace pointhaptics
