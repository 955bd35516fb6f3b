"""A servo loop in real time, over a simulated hand."""

from __future__ import annotations

import atexit
import time
import weakref
from ctypes import byref, c_double, c_size_t
from types import TracebackType
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Type

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import library
from .arrays import as_bounds, number, whole
from .calls import interruptible
from .scene import Scene
from .touch import FELT_TYPE, as_path, as_place, options_of, warn_of_units

#: (t, hand, force) -> the force to feel instead, or None.
OnTick = Callable[[float, NDArray[np.float64], NDArray[np.float64]], Optional[Sequence[float]]]

_LOOK = 0.01  # seconds
_loops: "weakref.WeakSet[ServoLoop]" = weakref.WeakSet()


@atexit.register
def _end() -> None:
    for loop in list(_loops):
        library.servo_stop(loop._handle.value)


class ServoLoop(library.NotCopied):
    """A thread that reads a simulated hand, steps a proxy and pushes the hand, `rate` times a second.

    The hand is a mass on a spring and a damper, pulled to where the person wants it: along a path, or to target().

    scene, stiffness, damping, mu_s, mu_d, method, force_limit, preset, gains : as Proxy has them.
    rate : ticks a second, 1 to 10000.
    start : where the hand begins, x, y, z in metres.
    path : (n, 4), t, x, y, z: where the person wants the hand. The loop ends with it. Default: where target() says.
    mass, grip_stiffness, grip_damping : of the hand, kg, N/m and N s/m, above 0.
    workspace : x0, x1, y0, y1, z0, z1, metres: the hand stays in it. Default: 10 cm about start, and the path.
    on_tick : called in each tick, in the loop's thread, as on_tick(t, hand, force): seconds, metres and newtons, the
        arrays its own. Three numbers that it returns are felt instead of the force; None changes nothing. What it
        raises ends the loop, without a force, and is raised by the next call. It holds the GIL: other threads of
        Python delay it, and the tick with it.
    trace : ticks kept between two calls of trace(), 1 to 4194304.

        with ph.ServoLoop(scene, start=(0, 0, 0.05)) as loop:
            loop.target((0, 0, 0.02))
            time.sleep(1)
        felt = loop.trace()

    Raises TypeError or ValueError, also where the simulated hand would shake under such a spring.
    """

    def __init__(
        self,
        scene: Scene,
        stiffness: float = 800.0,
        damping: float = 0.0,
        mu_s: float = 0.0,
        mu_d: float = 0.0,
        method: str = "surface-fit",
        force_limit: float = 8.0,
        *,
        rate: float = 1000.0,
        start: ArrayLike = (0.0, 0.0, 0.0),
        path: Optional[ArrayLike] = None,
        mass: float = 0.1,
        grip_stiffness: float = 200.0,
        grip_damping: float = 9.0,
        workspace: Optional[ArrayLike] = None,
        on_tick: Optional[OnTick] = None,
        trace: int = 32768,
        preset: str = "tuned",
        gains: Optional[Mapping[str, float]] = None,
    ) -> None:
        if not isinstance(scene, Scene):
            raise TypeError(f"scene: a {type(scene).__name__}; give a Scene")
        if on_tick is not None and not callable(on_tick):
            raise TypeError(f"on_tick: a {type(on_tick).__name__}; give a function of t, hand and force")
        self._fault: Optional[BaseException] = None
        self._on_tick = on_tick
        self._callback = library.TICK(self._tick) if on_tick is not None else library.TICK(0)
        rows = np.empty((0, 4)) if path is None else as_path(path)
        self._options = options_of(stiffness, damping, mu_s, mu_d, method, force_limit, preset, gains)
        options = library.struct_of(
            library.ServoOptions,
            rate=number(rate, "rate", 1.0, 1e4),
            mass=number(mass, "mass", 0.0, np.inf, open_low=True),
            grip_stiffness=number(grip_stiffness, "grip_stiffness", 0.0, np.inf, open_low=True),
            grip_damping=number(grip_damping, "grip_damping", 0.0, np.inf, open_low=True),
            start=(c_double * 3)(*as_place(start, "start")),
            workspace=(c_double * 6)(*([0.0] * 6 if workspace is None else as_bounds(workspace))),
            path=rows.ctypes.data if len(rows) else None,
            path_count=len(rows),
            on_tick=self._callback,
            trace=whole(trace, "trace", 1, 1 << 22),
        )
        stop = library.Stop()
        made = interruptible(lambda: scene.made(stop), stop.request)
        if len(rows) > 0:
            warn_of_units(made, rows)
        self._handle = library.Handle(
            library.servo_start, library.servo_destroy, made.value, byref(self._options), byref(options)
        )
        _loops.add(self)

    def _tick(self, user: object, t: float, hand: Any, force: Any) -> int:
        assert self._on_tick is not None
        try:
            felt = self._on_tick(t, np.array(hand[:3]), np.array(force[:3]))
            if felt is not None:
                force[0], force[1], force[2] = felt
            return 0
        except BaseException as fault:
            self._fault = fault
            return 1

    def _raise(self) -> None:
        if self._fault is not None:
            fault, self._fault = self._fault, None
            raise fault

    def target(self, place: ArrayLike) -> None:
        """Where the person wants the hand from now on, x, y, z in metres; within the workspace."""
        self._raise()
        library.check(library.servo_target(self._handle.value, (c_double * 3)(*as_place(place, "target"))))

    @property
    def running(self) -> bool:
        """True until stop(), the end of the path, or an exception of on_tick."""
        return bool(library.servo_running(self._handle.value))

    def wait(self, timeout: Optional[float] = None) -> bool:
        """Wait until the loop ends, or for `timeout` seconds. Returns whether it has ended."""
        end = np.inf if timeout is None else time.monotonic() + timeout
        while self.running and time.monotonic() < end:
            time.sleep(_LOOK)
        self._raise()
        return not self.running

    def trace(self) -> NDArray[Any]:
        """The ticks since the last call, the oldest first: a structured array with the fields FELT_COLUMNS.

        Times count from the first tick, forces are those of the proxy, before on_tick.
        """
        parts = []
        count = c_size_t(1)
        while count.value:
            rows = np.empty(4096, FELT_TYPE)
            library.check(library.servo_trace(self._handle.value, rows.ctypes.data, len(rows), byref(count)))
            parts.append(rows[: count.value])
        self._raise()
        return np.concatenate(parts)

    def statistics(self) -> Dict[str, float]:
        """rate (ticks a second), ticks, deadline_misses, lost (ticks of the trace), realtime (0 or 1), and in seconds
        jitter_p50, jitter_p99, jitter_max, update_p50, update_p99 and update_max."""
        result = library.struct_of(library.ServoStatistics)
        library.check(library.servo_statistics_of(self._handle.value, byref(result)))
        return {field[0]: getattr(result, field[0]) for field in library.ServoStatistics._fields_[1:]}

    def stop(self) -> None:
        """Take the force away and end the thread. What is in the trace stays there."""
        library.servo_stop(self._handle.value)
        self._raise()

    def __enter__(self) -> "ServoLoop":
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], fault: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        library.servo_stop(self._handle.value)
        if kind is None:
            self._raise()
