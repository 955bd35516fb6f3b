/// @file
/// A window off the screen whose pixels a test reads. Needs a display: see SKIP_WITHOUT_DISPLAY.
#pragma once

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

namespace pointhaptics
{

/// The camera looks down the z axis at the origin, from 0.2 m.
struct OffscreenWindow
{
  OffscreenWindow(int width, int height)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(width, height);
    window->AddRenderer(renderer);
    renderer->GetActiveCamera()->SetPosition(0, 0, 0.2);
    renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
  }

  /// Red, green and blue of the last frame, from row @p first to row @p last; all rows by default.
  std::vector<unsigned char> pixels(int first = 0, int last = -1)
  {
    const int* size = window->GetSize();
    vtkNew<vtkUnsignedCharArray> data;
    window->GetPixelData(0, first, size[0] - 1, last < 0 ? size[1] - 1 : last, 0, data);
    return { data->GetPointer(0), data->GetPointer(0) + data->GetNumberOfValues() };
  }
  /// Draws a frame and reads it.
  std::vector<unsigned char> picture(int first = 0, int last = -1)
  {
    window->Render();
    return this->pixels(first, last);
  }

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
};

} // namespace pointhaptics
