"""Parameters and result rows that proxies, paths and servo loops share."""

from __future__ import annotations

import math
from ctypes import byref, pointer
from typing import Mapping, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import library
from .arrays import number, whole
from .calls import warn

#: The columns of the program's OUT.csv, and of what Scene.feel() returns.
FELT_COLUMNS = (
    "t", "hip_x", "hip_y", "hip_z", "proxy_x", "proxy_y", "proxy_z", "normal_x", "normal_y", "normal_z",
    "force_x", "force_y", "force_z", "radius", "contact", "update_us",
)  # fmt: skip
FELT_TYPE = np.dtype([(name, np.float64) for name in FELT_COLUMNS])
METHODS = {"surface-fit": 0, "sphere": 2, "gradient-steps": 1}
PRESETS = {"tuned": 0, "paper": 1}
_LARGEST_INT = 10000


def word(value: object, name: str, words: Mapping[str, int]) -> int:
    if not isinstance(value, str) or value not in words:
        raise ValueError(f"{name}: {value!r}; give one of {', '.join(map(repr, words))}")
    return words[value]


def gains_of(preset: str, gains: Optional[Mapping[str, float]]) -> library.Gains:
    """The gains of a preset, some of them replaced; raises for names that there are not, and numbers out of range."""
    result = library.struct_of(library.Gains)
    library.check(library.gains_of(word(preset, "preset", PRESETS), byref(result)))
    names = [field[0] for field in library.Gains._fields_[1:]]
    for name, value in ({} if gains is None else gains).items():
        if name not in names:
            raise ValueError(f"gains: no gain is called {name!r}; give some of {', '.join(names)}")
        if name == "normalized_by_density":
            result.normalized_by_density = bool(value)
        elif name == "maximum_steps":
            result.maximum_steps = whole(value, "gains['maximum_steps']", 1, _LARGEST_INT)
        else:
            setattr(result, name, number(value, f"gains[{name!r}]", 0.0, math.inf))
    return result


def options_of(
    stiffness: float,
    damping: float,
    mu_s: float,
    mu_d: float,
    method: str,
    force_limit: float,
    preset: str,
    gains: Optional[Mapping[str, float]],
) -> library.ProxyOptions:
    """The options of the library; raises TypeError or ValueError where one is out of range."""
    mu_d = number(mu_d, "mu_d", 0.0, 10.0)
    mu_s = number(mu_s, "mu_s", 0.0, 10.0) or mu_d
    if mu_d > mu_s:
        raise ValueError(f"mu_d: {mu_d!r} is above mu_s {mu_s!r}; give mu_d <= mu_s")
    return library.struct_of(
        library.ProxyOptions,
        stiffness=number(stiffness, "stiffness", 0.0, 1e5) or -1.0,  # 0 is the default there
        damping=number(damping, "damping", 0.0, 1e3),
        mu_s=mu_s,
        mu_d=mu_d,
        force_limit=math.inf if force_limit == math.inf else number(force_limit, "force_limit", 0.0, math.inf, True),
        method=word(method, "method", METHODS),
        gains=pointer(gains_of(preset, gains)),
    )


def as_path(path: object) -> NDArray[np.float64]:
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
    return np.ascontiguousarray(array, np.float64)


def warn_of_units(scene: library.Handle, path: NDArray[np.float64], touched: bool = True) -> None:
    """Warns where the sizes of cloud and path make other units than metres and seconds likely."""
    odd = library.unlikely_units(scene.value, path.ctypes.data, len(path), touched)
    if odd:
        warn(odd.decode(), UserWarning)


def as_place(place: object, name: str) -> Tuple[float, float, float]:
    """x, y and z in metres; raises where they are none."""
    numbers = np.asarray(place)
    if numbers.dtype.kind not in "fiu":
        raise TypeError(f"{name}: values of type {numbers.dtype}; give x, y and z in metres")
    if numbers.shape != (3,):
        raise ValueError(f"{name}: shape {numbers.shape}; give x, y and z in metres")
    return float(numbers[0]), float(numbers[1]), float(numbers[2])
