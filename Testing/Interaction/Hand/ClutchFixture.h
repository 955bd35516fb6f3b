/// @file
/// A model under a hand that is not a mouse: pipeline, style and servo loop, no window, no display.
#pragma once

#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "MadeClouds.h"
#include "Unit/Eventually.h"

#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTransform.h>

#include <chrono>
#include <thread>

namespace pointhaptics
{
namespace trial
{

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
  /// A strip, 4 cm wide, is there to be felt, by the hand at @p port.
  void begin(HapticPort& port, double x0, double x1)
  {
    resampler->SetInputData(flatCloud(x0, x1, 0.02));
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
  /// Element of the model's matrix.
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
