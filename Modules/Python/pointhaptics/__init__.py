"""See and feel raw point clouds: resampling, kernel bandwidths, files and haptic rendering.

Functions over NumPy arrays (metres, newtons, seconds; points are float32 or float64 of shape (n, 3)):

    import pointhaptics as ph

    points, attributes = ph.read("scan.ply")
    voxels = ph.resample(points, voxel=0.001, attributes=attributes)    # one mean per active voxel
    radii = ph.bandwidth(voxels.points, counts=voxels.counts).radius    # proxy radius at each mean
    scene = ph.Scene(points)
    felt = scene.feel(path)                                             # forces along a hand path
    felt = ph.Proxy(scene).step(hand, dt=0.001)                         # the force on a hand, step by step
    ph.ServoLoop(scene)                                                 # a servo loop over a simulated hand
    ph.write("means.vtp", voxels)
    ph.info("scan.ply")                                                 # what is in a file

The VTK classes are here too, for pipelines: vtkVoxelMeanResampler, vtkKernelBandwidthFilter, vtkHapticFeel,
vtkPointCloudReader, vtkPointCloudWriter, vtkPointCloudInfo; those that draw, such as vtkSplatMapper and
vtkInteractorStyleHaptic, are loaded with their first use.

Points are handed to the filters without a copy where they are C-contiguous float32 or float64; other arrays are
copied. Results are views of the memory that the filters wrote. Everything is the same bit for bit as what the program
`pointhaptics` computes, with any number of threads.

Bad input, and input without points, raises TypeError or ValueError, files that cannot be opened OSError with errno and
filename, and want of memory MemoryError, with one line that says what, where, which value and the cure. Functions and
scenes may be used by any number of threads at a time; they give up the GIL while they work, and so do the filters. What
a signal handler raises, such as Ctrl+C, ends the work and is raised from the call.
"""

from __future__ import annotations

from typing import Any

from .classes import (
    vtkHapticFeel,
    vtkKernelBandwidthFilter,
    vtkPointCloudInfo,
    vtkPointCloudReader,
    vtkPointCloudWriter,
    vtkVoxelMeanResampler,
)
from .arrays import Attributes
from .files import info, read, write
from .filters import Bandwidths, Voxels, bandwidth, resample
from .proxy import Proxy
from .scene import FELT_COLUMNS, Scene
from .servo import ServoLoop
from .version import __version__

__all__ = [
    "FELT_COLUMNS",
    "Attributes",
    "Bandwidths",
    "Proxy",
    "Scene",
    "ServoLoop",
    "Voxels",
    "__version__",
    "bandwidth",
    "info",
    "read",
    "resample",
    "vtkHapticFeel",
    "vtkKernelBandwidthFilter",
    "vtkPointCloudInfo",
    "vtkPointCloudReader",
    "vtkPointCloudWriter",
    "vtkVoxelMeanResampler",
    "write",
]


def __getattr__(name: str) -> Any:
    # The classes that draw need VTK's rendering modules, which take most of the time of an import.
    if name.startswith("vtk"):
        try:
            from . import PointHapticsInteraction, PointHapticsRendering
        except ImportError as fault:
            import importlib.util
            import re

            # Of a module that could not be mapped for want of memory VTK says that there is none.
            hidden = re.search(r"No module named '?([\w.]+)", str(fault))
            is_there = hidden is not None and importlib.util.find_spec(hidden.group(1)) is not None
            if is_there or "failed to map segment" in str(fault):
                raise MemoryError(f"{name}: not enough memory for VTK's rendering modules") from None
            raise
        for module in (PointHapticsRendering, PointHapticsInteraction):
            if hasattr(module, name):
                return getattr(module, name)
    raise AttributeError(f"module 'pointhaptics' has no attribute {name!r}")
