"""See and feel raw point clouds: resampling, kernel bandwidths, files and haptic rendering.

Functions over NumPy arrays (metres, newtons, seconds; points are float32 or float64 of shape (n, 3)):

    import pointhaptics as ph

    points, attributes = ph.read("scan.ply")
    voxels = ph.resample(points, voxel=0.001, attributes=attributes)    # one mean per active voxel
    radii = ph.bandwidth(voxels.points, counts=voxels.counts).radius    # proxy radius at each mean
    felt = ph.Scene(points).feel(path)                                  # forces along a hand path
    ph.write("means.vtp", voxels.points, voxels.attributes)
    ph.info("scan.ply")                                                 # what is in a file

The VTK classes are here too, for pipelines: vtkVoxelMeanResampler, vtkKernelBandwidthFilter, vtkHapticFeel,
vtkPointCloudReader, vtkPointCloudWriter, vtkPointCloudInfo; those that draw, such as vtkSplatMapper and
vtkInteractorStyleHaptic, are loaded with their first use.

Points are handed to the filters without a copy where they are C-contiguous float32 or float64; other arrays are
copied. Results are views of the memory that the filters wrote. Everything is the same bit for bit as what the program
`pointhaptics` computes, with any number of threads.

Bad input raises TypeError or ValueError, and files that cannot be opened OSError, with one line that says what,
where, which value and the cure. Ctrl+C ends a running filter. Of one object one thread is served at a time; functions
may run in any thread.
"""

from __future__ import annotations

from .classes import (
    vtkHapticFeel,
    vtkKernelBandwidthFilter,
    vtkPointCloudInfo,
    vtkPointCloudReader,
    vtkPointCloudWriter,
    vtkVoxelMeanResampler,
)
from .files import info, read, write
from .filters import Bandwidths, Voxels, bandwidth, resample
from .scene import FELT_COLUMNS, Scene

__all__ = [
    "FELT_COLUMNS",
    "Bandwidths",
    "Scene",
    "Voxels",
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


def __getattr__(name: str):
    # The classes that draw need VTK's rendering modules, which take most of the time of an import.
    if name.startswith("vtk"):
        from . import PointHapticsInteraction, PointHapticsRendering

        for module in (PointHapticsRendering, PointHapticsInteraction):
            if hasattr(module, name):
                return getattr(module, name)
    raise AttributeError(f"module 'pointhaptics' has no attribute {name!r}")
