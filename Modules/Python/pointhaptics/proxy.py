"""A hand on a scene, step by step, in the caller's time."""

from __future__ import annotations

from ctypes import byref
from typing import Any, Mapping, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import library
from .arrays import number
from .calls import interruptible
from .scene import Scene
from .touch import FELT_TYPE, as_place, options_of, warn_of_units

_ROW = FELT_TYPE.itemsize
_BLOCK = 256


class Proxy(library.NotCopied):
    """The proxy of a hand: it stays on the surface while the hand goes inside; the spring between is the force.

    scene : what is felt. It may serve any number of proxies at a time.
    stiffness : spring between hand and proxy, N/m, 0 to 1e5.
    damping : of the hand's speed along the normal, in contact, N s/m, 0 to 1e3.
    mu_s, mu_d : static and dynamic friction, 0 to 10, mu_d <= mu_s; mu_s 0: that of mu_d.
    method : "surface-fit" (accurate), "sphere" or "gradient-steps" (the paper's).
    force_limit : the force never exceeds it, N, above 0; inf: none.
    preset : gains of "gradient-steps": "tuned" follows a hand of 50 mm/s, "paper" has those that the paper prints.
    gains : dict that replaces some of these: free_gain (k_h, 0 to 1), normal_gain (k_n, 0 to 10), tangent_gain (delta,
        0 to 1), sink_tolerance (zeta over the proxy radius, 0 to 1), step_period (seconds), largest_step (over the
        radius), maximum_steps (1 to 10000), normalized_by_density (bool).

    Raises TypeError or ValueError: one line that names the argument, its value and the cure. One thread at a time uses
    a proxy.
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
        preset: str = "tuned",
        gains: Optional[Mapping[str, float]] = None,
    ) -> None:
        if not isinstance(scene, Scene):
            raise TypeError(f"scene: a {type(scene).__name__}; give a Scene")
        options = options_of(stiffness, damping, mu_s, mu_d, method, force_limit, preset, gains)
        stop = library.Stop()
        made = interruptible(lambda: scene.made(stop), stop.request)
        self._made = made
        self._handle = library.Handle(library.proxy_create, library.proxy_destroy, byref(options))
        library.check(library.proxy_set_scene(self._handle.value, made.value))
        self._hand = np.zeros(3)
        self._arguments = self._handle.value, self._hand.ctypes.data
        self._rows = np.zeros(0, FELT_TYPE)
        self._next = 0
        self._address = 0
        self._doubts = True

    def step(self, hand: ArrayLike, dt: float = 0.001) -> np.void:
        """The hand is at `hand` (x, y, z, metres), `dt` seconds after the last step. Returns what it feels.

        Returns a structured scalar with the fields FELT_COLUMNS: felt["force_x"] and so on; its t counts from the
        first step, where it is 0. Steps along a path give the forces of Scene.feel(), bit for bit. Raises TypeError
        or ValueError; a hand that is NaN is answered with a force that fades out, as a servo loop must.

        Cost: some microseconds; now and then some milliseconds for a finer scene about a hand that moves on.
        """
        handle, place = self._arguments
        i = self._next
        if i == len(self._rows):
            if 0 < i and self._doubts:
                rows = np.column_stack([self._rows[name] for name in ("t", "hip_x", "hip_y", "hip_z")])
                self._doubts = False  # the first rows tell
                warn_of_units(self._made, rows)
            # What was returned looks at rows of the block before: a copy of each takes longer.
            self._rows = np.zeros(_BLOCK, FELT_TYPE)
            self._address = self._rows.ctypes.data
            i = 0
        self._next = i + 1
        try:
            given: Any = hand
            x, y, z = given
            self._hand[:] = (x, y, z)
        except (TypeError, ValueError):
            as_place(hand, "hand")
            raise
        try:
            status = library.proxy_step_row(handle, place, dt, self._address + _ROW * i)
        except library.ArgumentError:
            number(dt, "dt", 0.0, np.inf, open_low=True)
            raise
        if status:
            library.check(status)
        return self._rows[i]  # type: ignore[no-any-return]
