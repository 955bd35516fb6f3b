"""A window whose style touches a cloud, and ends by itself."""

from __future__ import annotations

import numpy as np
import pointhaptics as ph
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor


def styled_window(points: np.ndarray):
    cloud = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(points, deep=True))
    cloud.SetPoints(places)
    resampler = ph.vtkVoxelMeanResampler()
    resampler.SetInputData(cloud)
    resampler.SetVoxelSize(0.001)
    window = vtkRenderWindow()
    window.AddRenderer(vtkRenderer())
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    style = ph.vtkInteractorStyleHaptic()
    style.SetResampler(resampler)
    interactor.SetInteractorStyle(style)
    return style, window, interactor


def close_soon(interactor, events: int = 10, then=lambda event: None) -> list:
    """Ends the interactor after some events of its timer, or once then() of one is true. Returns their numbers."""
    seen = []

    def tick(*_: object) -> None:
        is_done = then(len(seen))
        seen.append(len(seen))
        if is_done or len(seen) >= events:
            interactor.TerminateApp()

    interactor.AddObserver("TimerEvent", tick)
    return seen


def pixels(window) -> np.ndarray:
    """(n, 3) of the window."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.Update()
    return vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars())


def lit(window) -> int:
    """Pixels of the window that are not black."""
    return int((pixels(window).max(axis=1) > 30).sum())
