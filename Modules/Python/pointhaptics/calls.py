"""Runs long calls: signal handlers run meanwhile, what they raise reaches the caller, and the end of Python ends them."""

from __future__ import annotations

import _thread
import atexit
import itertools
import mmap
import sys
import threading
import time
import traceback
import warnings
from typing import Any, Callable, Generic, List, Optional, Set, Tuple, Type, TypeVar

from .library import end_interpreter

Result = TypeVar("Result")

# Seconds that a call is waited for after a signal handler raised; it ends soon after that, and its result is dropped.
_PATIENCE = 0.1
_LOOK = 0.005
_SIGNALS = 0.05
# Bytes of address space: its stack, of 8 MiB by default, and frames.
_ROOM_OF_THREAD = 16 << 20

_running: Set["_Call[Any]"] = set()
_here = threading.local()  # .call: the one that this thread runs
_is_ending = False


class _Call(Generic[Result]):
    """A call in a thread of its own, so that the thread that waits for it runs signal handlers."""

    def __init__(self, work: Callable[[], Result], stop: Callable[[], None]) -> None:
        self.work = work
        self.stop = stop
        self.done = _thread.allocate_lock()
        self.done.acquire()
        self.result: List[Result] = []
        self.fault: Optional[BaseException] = None
        self.warnings: List[Tuple[str, Type[Warning]]] = []

    def __call__(self) -> None:
        outer = getattr(_here, "call", None)
        _here.call = self
        try:
            self.result.append(self.work())
        except BaseException as fault:
            self.fault = fault
        finally:
            _here.call = outer
            _running.discard(self)
            self.done.release()

    def give_up(self) -> None:
        end = time.monotonic() + _PATIENCE
        # A filter that has not begun forgets a stop.
        while self in _running and time.monotonic() < end:
            self.stop()
            self.done.acquire(timeout=_LOOK)


def warn(text: str, category: Type[Warning] = RuntimeWarning) -> None:
    """Warns at the line outside this package that led here; within a call, when it is over."""
    call = getattr(_here, "call", None)
    if call is not None:
        call.warnings.append((text, category))
        return
    frames = traceback.walk_stack(sys._getframe())
    inside = itertools.takewhile(lambda entry: entry[0].f_globals.get("__package__") == __package__, frames)
    warnings.warn(text, category, stacklevel=len([None, *inside]))


def interruptible(work: Callable[[], Result], stop: Callable[[], None]) -> Result:
    """The result of work(), during which the GIL should be given up. stop(), from another thread, asks it to end.

    In the main thread signal handlers run meanwhile, and what they raise ends the work and is raised here. At the end
    of Python all work is ended; threads that still wait for it end, too.
    """
    if _is_ending:
        raise SystemExit
    call = _Call(work, stop)
    _running.add(call)
    try:
        _wait_for(call)
    except BaseException:
        call.give_up()
        raise
    if _is_ending:
        raise SystemExit
    for text, category in call.warnings:
        warn(text, category)
    if call.fault is not None:
        try:
            raise call.fault
        finally:
            call.fault = None  # it refers to this frame
    return call.result.pop()


def _wait_for(call: "_Call[Result]") -> None:
    # Signal handlers run in the main thread alone: others may wait within the call.
    if threading.current_thread() is not threading.main_thread():
        call()
        return
    try:
        # A thread that finds no memory for its first frame ends without a word, and its call would be waited for in vain.
        mmap.mmap(-1, _ROOM_OF_THREAD).close()
        _thread.start_new_thread(call, ())
    except (OSError, RuntimeError):  # no memory for a thread
        call()
        return
    # In short waits: _thread.interrupt_main() wakes none.
    while not call.done.acquire(timeout=_SIGNALS):
        pass


@atexit.register
def _end() -> None:
    global _is_ending
    _is_ending = True
    while _running:
        for call in list(_running):
            call.stop()
        time.sleep(_LOOK)
    end_interpreter()  # filters that threads update themselves
