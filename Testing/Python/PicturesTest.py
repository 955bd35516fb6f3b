"""Pictures of VTK's own props beside the classes that draw: needs a display."""

import os
import unittest

import numpy as np
import pointhaptics as ph
import vtkmodules.vtkRenderingVolumeOpenGL2 as volumes
from vtkmodules import vtkRenderingCore as core
from vtkmodules import vtkRenderingOpenGL2 as opengl
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

SIZE = 200


def volume():
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-20, 20, -20, 20, -20, 20)
    mapper = volumes.vtkOpenGLGPUVolumeRayCastMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    opacity = vtkPiecewiseFunction()
    opacity.AddPoint(40, 0)
    opacity.AddPoint(270, 0.3)
    prop = core.vtkVolume()
    prop.SetMapper(mapper)
    prop.GetProperty().SetScalarOpacity(opacity)
    return prop


def ball():
    """Partly within the volume."""
    source = vtkSphereSource()
    source.SetRadius(12)
    source.SetCenter(20, 0, 0)
    mapper = core.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = core.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(1, 0, 0)
    return actor


def collection(*passes):
    sequence, all_passes = opengl.vtkSequencePass(), opengl.vtkRenderPassCollection()
    for each in passes:
        all_passes.AddItem(each)
    sequence.SetPasses(all_passes)
    return sequence


def shading(is_moving):
    camera = opengl.vtkCameraPass()
    parts = (opengl.vtkLightsPass(), opengl.vtkOpaquePass(), opengl.vtkTranslucentPass(), opengl.vtkVolumetricPass())
    camera.SetDelegatePass(collection(*parts))
    shading = ph.vtkDepthShadingPass()
    shading.SetDelegatePass(camera)
    shading.SetStrength(0)
    shading.SetIsMoving(is_moving)
    return collection(shading)


@unittest.skipUnless(os.environ.get("DISPLAY"), "no display")
class DepthShading(unittest.TestCase):
    def picture(self, samples, stencil, is_shaded, is_moving=False, size=SIZE):
        window, renderer = core.vtkRenderWindow(), core.vtkRenderer()
        window.SetOffScreenRendering(1)
        window.SetSize(size, size)
        window.SetMultiSamples(samples)
        window.SetStencilCapable(stencil)
        window.AddRenderer(renderer)
        renderer.SetBackground(1, 1, 1)
        renderer.AddVolume(volume())
        renderer.AddActor(ball())
        if is_shaded:
            renderer.SetPass(shading(is_moving))
        renderer.ResetCamera()
        window.Render()
        grab = core.vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.Update()
        return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).astype(int)

    def test_volumes_are_drawn_whatever_depths_the_window_has(self):
        for samples in (0, 4):
            for stencil in (0, 1):
                with self.subTest(samples=samples, stencil=stencil):
                    plain, shaded = (self.picture(samples, stencil, each) for each in (False, True))
                    self.assertGreater((plain.max(axis=1) < 200).sum(), SIZE)
                    differs = np.abs(plain - shaded).max(axis=1) > 16
                    self.assertLess(differs.sum(), SIZE if samples else 1)  # several samples smooth the ball's rim

    def test_volumes_end_at_the_same_surfaces_in_motion(self):
        """A picture in motion has fewer pixels where the processor draws, and a volume copies those of the window."""
        plain = self.picture(0, 0, False, size=700)
        moving = self.picture(0, 0, True, is_moving=True, size=700)
        self.assertLess((np.abs(plain - moving).max(axis=1) > 16).sum(), SIZE)


if __name__ == "__main__":
    unittest.main()
