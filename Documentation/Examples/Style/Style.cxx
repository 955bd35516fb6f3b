// Style [X Y]: a ball of points is touched with the mouse; the hand follows the pointer. Key Q ends it. With
// X and Y, pixels, the pointer goes there by itself, and after a second the program says what the hand feels.
#include <vtkHapticProps.h>
#include <vtkInteractorStyleHaptic.h>
#include <vtkVoxelMeanResampler.h>

#include <Devices/SimulatedDevice.h>
#include <Haptics/ServoLoop.h>

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char* argv[])
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
  window->SetOffScreenRendering(argc == 3);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);

  vtkNew<vtkHapticProps> props; // workspace, proxy, normal and force
  props->AddTo(renderer);
  pointhaptics::SimulatedDevice hand;
  pointhaptics::ServoLoop servo;
  vtkNew<vtkInteractorStyleHaptic> style;
  style->SetResampler(resampler);
  style->SetServoLoop(&servo);
  style->SetDevice(&hand);
  style->SetProps(props);
  style->SetHandMode(true);
  interactor->SetInteractorStyle(style);
  if (!style->UpdateModel() || hand.open() != pointhaptics::Status::Ok ||
    servo.start(hand, {}) != pointhaptics::Status::Ok)
  {
    std::fprintf(stderr, "there is nothing to feel\n");
    return 1;
  }
  window->Render();
  interactor->Initialize();
  style->StartUpdates();
  if (argc != 3)
  {
    interactor->Start();
    return 0;
  }
  interactor->SetEventPosition(std::atoi(argv[1]), std::atoi(argv[2]));
  interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
  for (const double end = servo.latest().timeSeconds + 1.0; servo.latest().timeSeconds < end;)
  {
    style->Refresh();
  }
  std::printf("the hand feels %.2f N to the right\n", servo.latest().state.force.x);
  return 0;
}
