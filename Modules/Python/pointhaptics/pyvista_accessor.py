"""PyVista: `mesh.pointhaptics.resample(...)` and `.bandwidth(...)` on every dataset with points.

    import pyvista
    import pointhaptics.pyvista_accessor

    means = pyvista.read("scan.ply").pointhaptics.resample(voxel=0.001).pointhaptics.bandwidth()
    means.plot(scalars="ProxyRadius")

Needs PyVista 0.48 or newer, which knows accessors. Points and point data are handed over without a copy; the results
are new pyvista.PolyData of vertices.
"""

from __future__ import annotations

from typing import Any, Dict

import numpy as np
from numpy.typing import NDArray
import pyvista

from . import filters

_COUNTS = "VoxelPointCount"


@pyvista.register_dataset_accessor("pointhaptics", pyvista.DataSet)
class PointHapticsAccessor:
    """The filters of pointhaptics on one dataset. Made by PyVista, at the first use of `.pointhaptics`."""

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh

    def resample(self, **options: Any) -> Any:
        """One mean for each active voxel, with the means of all point arrays and "VoxelPointCount".

        options: those of pointhaptics.resample: voxel, dims, workspace, transform, covariance, categorical, threads,
        representative, minimum_points; attributes chooses other arrays than the mesh's. With covariance=True
        "VoxelCovariance" (n, 6) is there too, with voxel_index=True the mesh gets the point array "VoxelIndex".
        Raises TypeError or ValueError as pointhaptics.resample does.
        """
        options.setdefault("attributes", self._arrays())
        voxels = filters.resample(np.asarray(self._mesh.points), **options)
        result = pyvista.PolyData(voxels.points)
        for name, values in voxels.attributes.items():
            result.point_data[name] = values
        result.point_data[_COUNTS] = voxels.counts
        if voxels.covariance is not None:
            result.point_data["VoxelCovariance"] = voxels.covariance
        if voxels.point_ids is not None:
            result.point_data["vtkOriginalPointIds"] = voxels.point_ids
        if voxels.voxel_index is not None:
            self._mesh.point_data["VoxelIndex"] = voxels.voxel_index
        return result

    def bandwidth(self, **options: Any) -> Any:
        """The mesh's points with the arrays "Bandwidth", "ProxyRadius" and with density=True "Density" added.

        options: those of pointhaptics.bandwidth: k, rule, beta, r1, r2, density, counts; where the mesh comes from
        resample(), its counts are used. Raises TypeError or ValueError as pointhaptics.bandwidth does.
        """
        arrays = self._arrays(resampled=True)
        options.setdefault("counts", arrays.get(_COUNTS))
        points = np.asarray(self._mesh.points)
        found = filters.bandwidth(points, **options)
        result = pyvista.PolyData(points)
        for name, values in arrays.items():
            result.point_data[name] = values
        result.point_data["Bandwidth"] = found.bandwidth
        result.point_data["ProxyRadius"] = found.radius
        if found.density is not None:
            result.point_data["Density"] = found.density
        return result

    def _arrays(self, resampled: bool = False) -> Dict[str, NDArray[Any]]:
        """The point data by name; what an earlier resampling added only where it is wanted."""
        own = () if resampled else (_COUNTS, "VoxelCovariance", "VoxelIndex", "vtkOriginalPointIds")
        return {name: np.asarray(values) for name, values in self._mesh.point_data.items() if name not in own}
