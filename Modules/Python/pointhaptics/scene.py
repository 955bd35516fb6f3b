"""A cloud as a hand feels it, and what the hand feels along a path, in virtual time."""

from __future__ import annotations

import threading
from ctypes import byref, c_double, c_int, c_size_t
from typing import Any, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import library
from .arrays import as_bounds, as_dims, as_points, number
from .calls import interruptible, warn
from .touch import FELT_COLUMNS, FELT_TYPE, as_path, options_of, warn_of_units

__all__ = ["FELT_COLUMNS", "Scene"]

_LOOK = 0.05  # seconds between two looks at a stop


class Scene:
    """A point cloud that can be felt. Immutable: any number of threads may use one at a time.

    points : (n, 3), float32 or float64, metres. Kept, not copied: do not write to them.
    voxel : edge of the voxels that are felt, metres, above 0; or
    dims : voxels on each axis, one number or three. Where neither is given: 300, and near the hand, where that tells
        more, voxels about as fine as the points, as in the program without --dims and --voxel.
    workspace : x0, x1, y0, y1, z0, z1, metres: points outside are not felt. Default: a cube about the points, but
        for a few far from all others, which the first call that feels them says in a RuntimeWarning.

    Raises TypeError or ValueError: one line that names the argument, its value and the cure. What is felt is made by
    the first call that needs it and kept for the next ones. Scenes can be pickled and copied: as these arguments.
    """

    def __init__(
        self,
        points: ArrayLike,
        voxel: Optional[float] = None,
        dims: Union[int, Sequence[int], None] = None,
        workspace: Optional[ArrayLike] = None,
    ) -> None:
        if voxel is not None and dims is not None:
            raise ValueError(f"voxel {voxel!r} and dims {dims!r}: two ways to say one thing; give one of them")
        self._points = as_points(points)
        blocks = (self._points[i : i + 100_000] for i in range(0, len(self._points), 100_000))
        if not any(np.isfinite(block).all(axis=1).any() for block in blocks):
            raise ValueError(f"points: none of {len(self._points)} is finite; give at least one without NaN")
        self._voxel = None if voxel is None else number(voxel, "voxel", 0.0, np.inf, open_low=True)
        self._dims = None if dims is None else as_dims(dims)
        self._workspace = None if workspace is None else as_bounds(workspace)
        self._lock = threading.Lock()
        self._made: Optional[library.Handle] = None

    @property
    def points(self) -> NDArray[Any]:
        """The points, (n, 3), float32 or float64, metres; read-only."""
        view = self._points.view()
        view.flags.writeable = False
        return view

    def __len__(self) -> int:
        return len(self._points)

    def __repr__(self) -> str:
        return f"<pointhaptics.Scene of {len(self)} points>"

    def __reduce__(self) -> Tuple[Any, ...]:
        return Scene, (self._points, self._voxel, self._dims, self._workspace)

    def made(self, stop: library.Stop) -> library.Handle:
        """The library's scene; made once. Raises Stopped. For the modules of this package."""
        while not self._lock.acquire(timeout=_LOOK):
            if stop.is_requested:
                raise library.Stopped
        try:
            if self._made is None:
                self._made = self._make(stop)
            return self._made
        finally:
            self._lock.release()

    def _make(self, stop: library.Stop) -> library.Handle:
        options = library.struct_of(
            library.SceneOptions,
            voxel=self._voxel or 0.0,
            dims=(c_int * 3)(*(self._dims or (0, 0, 0))),
            workspace=(c_double * 6)(*(self._workspace or [0.0] * 6)),
            stop=stop.value,
        )
        points = self._points
        if points.dtype == np.float32:
            size: Tuple[int, ...] = (len(points), 0)
            create = library.scene_create_float
        else:
            size = (len(points),)
            create = library.scene_create
        made = library.Handle(create, library.scene_destroy, points.ctypes.data, *size, byref(options))
        note = library.scene_note(made.value)
        if note:
            warn(note.decode())
        return made

    def feel(
        self,
        path: ArrayLike,
        stiffness: float = 800.0,
        damping: float = 0.0,
        mu_s: float = 0.0,
        mu_d: float = 0.0,
        rate: float = 1000.0,
        method: str = "surface-fit",
        *,
        force_limit: float = 8.0,
        preset: str = "tuned",
        gains: Optional[Mapping[str, float]] = None,
    ) -> NDArray[Any]:
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
        force_limit : the force never exceeds it, N, above 0; inf: none.
        preset, gains : of "gradient-steps": see Proxy.

        Returns
        -------
        Structured array of float64, one row a tick, with the fields FELT_COLUMNS: seconds, metres, newtons (on the
        hand), contact 0 or 1, update_us the wall time of the tick in microseconds.

        Raises
        ------
        TypeError, ValueError : one line that names the argument, its value and the cure.
        MemoryError : there is no memory for the scene or the rows.

        Warns where the sizes of cloud and path make other units than metres and seconds likely.

        The same rows as those of `pointhaptics feel`, bit for bit, update_us aside, from any number of threads at a
        time. Cost: about 10 us a tick, and the first time the resampling of the cloud.
        """
        rows = as_path(path)
        rate = number(rate, "rate", 1.0, 1e5)
        options = options_of(stiffness, damping, mu_s, mu_d, method, force_limit, preset, gains)
        stop = library.Stop()

        def work() -> NDArray[Any]:
            steps = c_size_t()
            library.check(library.feel_steps(rows.ctypes.data, len(rows), rate, byref(steps)))
            scene = self.made(stop)
            felt = np.empty(steps.value, FELT_TYPE)
            library.check(
                library.feel(
                    scene.value, rows.ctypes.data, len(rows), rate, byref(options), stop.value, felt.ctypes.data
                )
            )
            return felt

        felt = interruptible(work, stop.request)
        warn_of_units(self.made(stop), rows, bool(felt["contact"].any()))
        return felt
