/// @file
/// A window with the style and its pipeline, on a flat cloud. Needs a display, and skips without one.
#pragma once

#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "MadeClouds.h"
#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTransform.h>

#include <chrono>
#include <string>
#include <thread>

namespace pointhaptics
{

/// A window with the style and its pipeline; the camera looks down the z axis, y up.
class InteractorStyleFixture : public ::testing::Test
{
protected:
  void SetUp() override
  {
    SKIP_WITHOUT_DISPLAY();
    resampler_->SetInputData(trial::flatCloud(-0.03, 0.03, 0.03));
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
  /// Lets the style's timer tick until @p condition holds. @return whether it does, in 20 seconds.
  template <typename Condition>
  bool eventually(const Condition& condition)
  {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition() && std::chrono::steady_clock::now() < deadline)
    {
      interactor_->InvokeEvent(vtkCommand::TimerEvent);
      std::this_thread::yield();
    }
    return condition();
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

} // namespace pointhaptics
