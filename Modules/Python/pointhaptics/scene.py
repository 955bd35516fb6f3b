"""What a hand feels of a cloud along a path, in virtual time."""

from __future__ import annotations

from typing import Optional, Sequence, Union

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkTable

from .arrays import Cloud, from_vtk, number, to_vtk
from .classes import vtkHapticFeel
from .filters import set_lattice
from .updates import update

#: The columns of the program's OUT.csv, and of what Scene.feel() returns.
FELT_COLUMNS = (
    "t", "hip_x", "hip_y", "hip_z", "proxy_x", "proxy_y", "proxy_z", "normal_x", "normal_y", "normal_z",
    "force_x", "force_y", "force_z", "radius", "contact", "update_us",
)  # fmt: skip
_METHODS = {
    "surface-fit": vtkHapticFeel.SurfaceFit,
    "sphere": vtkHapticFeel.Sphere,
    "gradient-steps": vtkHapticFeel.GradientSteps,
}


def _as_path(path: object) -> np.ndarray:
    """(n, 4) float64 of t, x, y, z; from such an array or from a structured one with these fields."""
    array = np.asarray(path)
    if array.dtype.names:
        names = ("t", "hip_x", "hip_y", "hip_z") if "hip_x" in array.dtype.names else ("t", "x", "y", "z")
        missing = [name for name in names if name not in array.dtype.names]
        if missing or array.ndim != 1:
            raise ValueError(f"path: fields {array.dtype.names}; give a table with t, x, y and z")
        array = np.column_stack([array[name] for name in names])
    if array.dtype.kind not in "fiu":
        raise TypeError(f"path: values of type {array.dtype}; give numbers")
    if array.ndim != 2 or array.shape[1] != 4 or len(array) == 0:
        raise ValueError(f"path: shape {array.shape}; give one row or more of t, x, y, z, (n, 4), in seconds and metres")
    return array.astype(np.float64, copy=False)


class Scene:
    """A point cloud that can be felt.

    points : (n, 3), float32 or float64, metres. Kept, not copied: do not write to them while the scene is in use.
    voxel : edge of the voxels that are felt, metres, above 0; or
    dims : voxels on each axis, one number or three. Where neither is given: 300, and near the hand, where that tells
        more, voxels about as fine as the points, as in the program without --dims and --voxel.
    workspace : x0, x1, y0, y1, z0, z1, metres: points outside are not felt. Default: a cube about the points.

    Raises TypeError or ValueError: one line that names the argument, its value and the cure. The scene is made by the
    first call of feel() and kept for the next ones. One thread uses a scene at a time.
    """

    def __init__(
        self,
        points: np.ndarray,
        voxel: Optional[float] = None,
        dims: Union[int, Sequence[int], None] = None,
        workspace: Optional[Sequence[float]] = None,
    ) -> None:
        self._cloud = Cloud(points)
        self._filter = vtkHapticFeel()
        self._filter.SetInputData(0, self._cloud.data)
        set_lattice(self._filter.GetResampler(), voxel, dims, workspace)
        self._filter.SetRefineNearHand(voxel is None and dims is None)

    def __len__(self) -> int:
        return len(self._cloud)

    def __repr__(self) -> str:
        return f"<pointhaptics.Scene of {len(self)} points>"

    def feel(
        self,
        path: np.ndarray,
        stiffness: float = 800.0,
        damping: float = 0.0,
        mu_s: float = 0.0,
        mu_d: float = 0.0,
        rate: float = 1000.0,
        method: str = "surface-fit",
    ) -> np.ndarray:
        """Move the hand along a path, in virtual time, and return what it feels at each tick.

        Parameters
        ----------
        path : (n, 4), t, x, y, z in seconds and metres, times strictly ascending; or a structured array with these
            fields, or with t, hip_x, hip_y and hip_z. Between two rows the hand moves linearly.
        stiffness : spring between hand and proxy, N/m, 0 to 1e5.
        damping : of the hand's speed along the normal, in contact, N s/m, 0 to 1e3.
        mu_s, mu_d : static and dynamic friction, 0 to 10, mu_d <= mu_s; mu_s 0: that of mu_d.
        rate : ticks a second, 1 to 1e5.
        method : "surface-fit" (accurate), "sphere" or "gradient-steps" (the paper's).

        Returns
        -------
        Structured array of float64, one row a tick, with the fields FELT_COLUMNS: seconds, metres, newtons (on the
        hand), contact 0 or 1, update_us the wall time of the tick in microseconds.

        Raises
        ------
        TypeError, ValueError : one line that names the argument, its value and the cure.

        The same rows as those of `pointhaptics feel`, bit for bit, update_us aside. Cost: about 10 us a tick, and the
        first time the resampling of the cloud.
        """
        if method not in _METHODS:
            raise ValueError(f"method: {method!r}; give one of {', '.join(map(repr, _METHODS))}")
        feel = self._filter
        feel.SetMethod(_METHODS[method])
        feel.SetStiffness(number(stiffness, "stiffness", 0.0, 1e5))
        feel.SetDamping(number(damping, "damping", 0.0, 1e3))
        mu_d = number(mu_d, "mu_d", 0.0, 10.0)
        mu_s = number(mu_s, "mu_s", 0.0, 10.0) or mu_d
        feel.SetStaticFriction(mu_s)
        feel.SetDynamicFriction(mu_d)
        if mu_d > mu_s:
            raise ValueError(f"mu_d: {mu_d!r} is above mu_s {mu_s!r}; give mu_d <= mu_s")
        feel.SetRate(number(rate, "rate", 1.0, 1e5))
        rows = _as_path(path)
        columns = [np.ascontiguousarray(rows[:, i]) for i in range(4)]
        table = vtkTable()
        for name, column in zip("txyz", columns):
            table.AddColumn(to_vtk(column, name))
        feel.SetInputData(1, table)
        update(feel)
        output = feel.GetOutput()
        felt = np.empty(output.GetNumberOfRows(), [(name, np.float64) for name in FELT_COLUMNS])
        for name in FELT_COLUMNS:
            felt[name] = from_vtk(output.GetColumnByName(name))
        return felt
