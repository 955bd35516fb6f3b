"""The library that computes, by its C interface: see pointhaptics.h. Its functions give up the GIL while they run."""

from __future__ import annotations

import ctypes
import os
from ctypes import POINTER, ArgumentError, byref, c_char_p, c_double, c_int, c_size_t, c_ulonglong, c_void_p
from typing import Any, Callable, NoReturn, Type, TypeVar

from .version import LIBRARY

_OUT_OF_MEMORY = 30
_STOPPED = 13
__all__ = ["ArgumentError"]

_DOUBLES = POINTER(c_double)
TICK = ctypes.CFUNCTYPE(c_int, c_void_p, c_double, _DOUBLES, _DOUBLES)


class Stopped(Exception):
    """A call ended early, as its caller asked."""


class SceneOptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t), ("voxel", c_double), ("workspace", c_double * 6), ("dims", c_int * 3),
        ("stop", c_void_p),
    ]  # fmt: skip


class Gains(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t), ("free_gain", c_double), ("normal_gain", c_double), ("tangent_gain", c_double),
        ("sink_tolerance", c_double), ("step_period", c_double), ("largest_step", c_double),
        ("maximum_steps", c_int), ("normalized_by_density", c_int),
    ]  # fmt: skip


class ProxyOptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t), ("stiffness", c_double), ("damping", c_double), ("mu_s", c_double),
        ("mu_d", c_double), ("force_limit", c_double), ("method", c_int), ("gains", POINTER(Gains)),
    ]  # fmt: skip


class ServoOptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t), ("rate", c_double), ("mass", c_double), ("grip_stiffness", c_double),
        ("grip_damping", c_double), ("start", c_double * 3), ("workspace", c_double * 6), ("path", c_void_p),
        ("path_count", c_size_t), ("on_tick", TICK), ("user", c_void_p), ("trace", c_int),
    ]  # fmt: skip


class ServoStatistics(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_size_t), ("rate", c_double), ("jitter_p50", c_double), ("jitter_p99", c_double),
        ("jitter_max", c_double), ("update_p50", c_double), ("update_p99", c_double), ("update_max", c_double),
        ("ticks", c_ulonglong), ("deadline_misses", c_ulonglong), ("lost", c_ulonglong), ("realtime", c_int),
    ]  # fmt: skip


_Struct = TypeVar("_Struct", bound=ctypes.Structure)


def struct_of(kind: Type[_Struct], **values: Any) -> _Struct:
    """A struct of the interface: its size is set, and what is not given is 0, its default."""
    return kind(struct_size=ctypes.sizeof(kind), **values)


# RTLD_GLOBAL would show its symbols to other extensions.
_library = ctypes.CDLL(os.path.join(os.path.dirname(os.path.abspath(__file__)), LIBRARY))


def _function(name: str, *types: Any, result: Any = c_int) -> Callable[..., Any]:
    function = getattr(_library, name)
    function.argtypes = types
    function.restype = result
    return function  # type: ignore[no-any-return]


_OUT = POINTER(c_void_p)
problem = _function("ph_problem", result=c_char_p)
stop_create = _function("ph_stop_create", _OUT)
stop_request = _function("ph_stop_request", c_void_p, result=None)
stop_destroy = _function("ph_stop_destroy", c_void_p, result=None)
scene_create = _function("ph_scene_create", c_void_p, c_size_t, POINTER(SceneOptions), _OUT)
scene_create_float = _function("ph_scene_create_float", c_void_p, c_size_t, c_size_t, POINTER(SceneOptions), _OUT)
scene_note = _function("ph_scene_note", c_void_p, result=c_char_p)
scene_destroy = _function("ph_scene_destroy", c_void_p, result=None)
gains_of = _function("ph_gains_of", c_int, POINTER(Gains))
proxy_create = _function("ph_proxy_create", POINTER(ProxyOptions), _OUT)
proxy_set_scene = _function("ph_proxy_set_scene", c_void_p, c_void_p)
proxy_set_options = _function("ph_proxy_set_options", c_void_p, POINTER(ProxyOptions))
proxy_step_row = _function("ph_proxy_step_row", c_void_p, c_void_p, c_double, c_void_p)
proxy_destroy = _function("ph_proxy_destroy", c_void_p, result=None)
feel_steps = _function("ph_feel_steps", c_void_p, c_size_t, c_double, POINTER(c_size_t))
feel = _function("ph_feel", c_void_p, c_void_p, c_size_t, c_double, POINTER(ProxyOptions), c_void_p, c_void_p)
unlikely_units = _function("ph_unlikely_units", c_void_p, c_void_p, c_size_t, c_int, result=c_char_p)
servo_start = _function("ph_servo_start", c_void_p, POINTER(ProxyOptions), POINTER(ServoOptions), _OUT)
servo_target = _function("ph_servo_target", c_void_p, c_void_p)
servo_set_options = _function("ph_servo_set_options", c_void_p, POINTER(ProxyOptions))
servo_running = _function("ph_servo_running", c_void_p)
servo_trace = _function("ph_servo_trace", c_void_p, c_void_p, c_size_t, POINTER(c_size_t))
servo_statistics_of = _function("ph_servo_statistics_of", c_void_p, POINTER(ServoStatistics))
servo_stop = _function("ph_servo_stop", c_void_p, result=None)
servo_destroy = _function("ph_servo_destroy", c_void_p, result=None)
end_interpreter = _function("ph_end_interpreter", result=None)


def check(status: int) -> None:
    """Raises what a status of the last call in this thread stands for; nothing for 0."""
    if status == _OUT_OF_MEMORY:
        raise MemoryError(problem().decode())
    if status == _STOPPED:
        raise Stopped
    if status:
        raise ValueError(problem().decode())


class NotCopied:
    """Base of what has a state of its own: a copy would share it."""

    def __reduce_ex__(self, protocol: object) -> NoReturn:
        raise TypeError(f"a {type(self).__name__} cannot be copied or pickled; make another one, as of its Scene")


class Handle(NotCopied):
    """Owns an object of the library and destroys it."""

    def __init__(self, create: Callable[..., int], destroy: Callable[[c_void_p], None], *arguments: Any) -> None:
        self.value = c_void_p()
        self._destroy = destroy
        check(create(*arguments, byref(self.value)))

    def __del__(self) -> None:
        if self.value:
            self._destroy(self.value)


class Stop(Handle):
    """Ends calls that were given it."""

    def __init__(self) -> None:
        super().__init__(stop_create, stop_destroy)
        self.is_requested = False

    def request(self) -> None:
        self.is_requested = True
        stop_request(self.value)


def _give_up_the_gil() -> None:
    """Lets long work of VTK filters give up the GIL, too, and run signal handlers."""
    python = ctypes.pythonapi
    is_ending = getattr(python, "Py_IsFinalizing", None) or getattr(python, "_Py_IsFinalizing", None)
    functions = (
        python.PyGILState_Check, python.PyEval_SaveThread, python.PyEval_RestoreThread, is_ending, python.PyErr_CheckSignals
    )  # fmt: skip
    addresses = [None if function is None else ctypes.cast(function, c_void_p) for function in functions]
    _function("ph_set_interpreter_lock", *[c_void_p] * 5, result=None)(*addresses)


_give_up_the_gil()
