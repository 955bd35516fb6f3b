"""Runs VTK filters: their errors become exceptions, their warnings Python's, and Ctrl+C ends them."""

from __future__ import annotations

import re
import signal
import threading
import warnings
from typing import Callable, List

from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

# "ERROR: In file, line n\nvtkClass (0x...): the message\n\n"
_PREFIX = re.compile(r"\A(?:ERROR|Warning): In .*\n(?:vtk\w+ \(\w+\): )?")


def _sentence(text: str) -> str:
    return " ".join(_PREFIX.sub("", text).split())


class _Messages:
    """Collects what an algorithm reports while it runs."""

    CallDataType = "string0"  # VTK hands the text to __call__

    def __init__(self) -> None:
        self.errors: List[str] = []
        self.warnings: List[str] = []

    def __call__(self, caller: object, event: str, text: str) -> None:
        (self.errors if event == "ErrorEvent" else self.warnings).append(_sentence(text))


class _Interrupt:
    """Turns Ctrl+C into a request that a running algorithm sees at its next report of progress."""

    def __init__(self, algorithm: vtkAlgorithm) -> None:
        self._algorithm = algorithm
        self._former = None
        self.requested = False

    def __call__(self, caller: vtkAlgorithm, event: str) -> None:
        if self.requested:
            self._algorithm.SetAbortExecute(1)

    def __enter__(self) -> "_Interrupt":
        # Only the main thread may set handlers, and one that somebody else has set stays.
        if (
            threading.current_thread() is threading.main_thread()
            and signal.getsignal(signal.SIGINT) is signal.default_int_handler
        ):
            self._former = signal.signal(signal.SIGINT, self._request)
        return self

    def __exit__(self, *unused: object) -> None:
        if self._former is not None:
            signal.signal(signal.SIGINT, self._former)

    def _request(self, number: int, frame: object) -> None:
        self.requested = True


def run(algorithm: vtkAlgorithm, work: Callable[[], object]) -> List[str]:
    """Calls `work`, which runs `algorithm`, and returns the errors that were reported, each in one line.

    Warnings are passed to the module `warnings`. Raises KeyboardInterrupt after Ctrl+C; the algorithm has then ended.
    """
    messages = _Messages()
    with _Interrupt(algorithm) as interrupt:
        # The executive reports what concerns the pipeline, such as an input of the wrong type.
        reporters = (algorithm, algorithm.GetExecutive())
        tags = [(r, r.AddObserver(e, messages)) for r in reporters for e in ("ErrorEvent", "WarningEvent")]
        tags.append((algorithm, algorithm.AddObserver("ProgressEvent", interrupt)))
        try:
            work()
        finally:
            for reporter, tag in tags:
                reporter.RemoveObserver(tag)
    if interrupt.requested:
        raise KeyboardInterrupt
    for text in messages.warnings:
        warnings.warn(text, RuntimeWarning, stacklevel=4)
    return messages.errors


def update(algorithm: vtkAlgorithm) -> None:
    """Updates a filter. Raises ValueError with the first error that it reports."""
    errors = run(algorithm, algorithm.Update)
    if errors:
        raise ValueError(errors[0])
