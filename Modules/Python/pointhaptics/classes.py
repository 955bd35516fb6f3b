"""The VTK classes that the functions of this package stand on, as VTK's own wrapping gives them."""

from .PointHapticsFilters import vtkKernelBandwidthFilter, vtkVoxelMeanResampler
from .PointHapticsIO import vtkPointCloudInfo, vtkPointCloudReader, vtkPointCloudWriter
from .PointHapticsScene import vtkHapticFeel

__all__ = [
    "vtkHapticFeel",
    "vtkKernelBandwidthFilter",
    "vtkPointCloudInfo",
    "vtkPointCloudReader",
    "vtkPointCloudWriter",
    "vtkVoxelMeanResampler",
]
