// A ball of points is touched with the mouse: F: the hand follows the pointer, J: what it feels, Q: the end.
#include <vtkActor.h>
#include <vtkHapticTouch.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cstdio>

int main()
{
  vtkNew<vtkSphereSource> ball; // or a vtkPointCloudReader: only the points count
  ball->SetRadius(0.02);
  ball->SetCenter(-0.03, 0.0, 0.0); // to the left of the hand, which begins in the middle
  ball->SetThetaResolution(300);
  ball->SetPhiResolution(150);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputConnection(ball->GetOutputPort());
  resampler->SetVoxelSize(0.001);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(resampler->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkNew<vtkInteractorStyleHaptic> style;
  style->SetResampler(resampler);
  interactor->SetInteractorStyle(style);
  vtkNew<vtkHapticTouch> touch; // a simulated hand, its servo loop and what is seen of them
  style->GetCommands().add({ "say-force", "j", "Touch", "say what the hand feels",
    [&touch] { std::printf("%.2f N to the right\n", touch->GetServoLoop().latest().state.force.x); } });
  return touch->Run(style) ? 0 : 1;
}
