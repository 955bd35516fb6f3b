"""Runs VTK filters: their errors become exceptions, their warnings Python's, and signals end them."""

from __future__ import annotations

import os
import re
from typing import Callable, List, Union

from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from .calls import interruptible, warn

_OUT_OF_MEMORY = 40012  # kOutOfMemoryCode of Core/Base/Host/OutOfMemory.h
# "ERROR: In file, line n\nvtkClass (0x...): the message\n\n"
_PREFIX = re.compile(r"\A(?:ERROR|Warning): In .*\n(?:vtk\w+ \(\w+\): )?")


def text_of(text: Union[str, bytes, None]) -> str:
    """VTK gives what is no UTF-8, such as the name of a file, as bytes; observers get None."""
    return os.fsdecode(text or "")


def _sentence(text: Union[str, bytes, None]) -> str:
    return " ".join(_PREFIX.sub("", text_of(text)).split())


class _Messages:
    """Collects what an algorithm reports while it runs."""

    CallDataType = "string0"  # VTK hands the text to __call__

    def __init__(self) -> None:
        self.errors: List[str] = []
        self.warnings: List[str] = []

    def __call__(self, caller: object, event: str, text: Union[str, bytes, None]) -> None:
        (self.errors if event == "ErrorEvent" else self.warnings).append(_sentence(text))


def run(algorithm: vtkAlgorithm, work: Callable[[], object]) -> List[str]:
    """Calls `work`, which runs `algorithm`, and returns the errors that were reported, each in one line.

    Warnings are passed to the module `warnings`. What a signal handler raises, as after Ctrl+C, ends the algorithm and
    is raised. Raises MemoryError where memory runs out.
    """
    messages = _Messages()
    # The executive reports what concerns the pipeline, such as an input of the wrong type.
    reporters = (algorithm, algorithm.GetExecutive())
    tags = [(r, r.AddObserver(e, messages)) for r in reporters for e in ("ErrorEvent", "WarningEvent")]

    def finish() -> None:
        try:
            work()
        finally:
            for reporter, tag in tags:
                reporter.RemoveObserver(tag)

    def stop() -> None:
        algorithm.SetAbortExecute(1)

    interruptible(finish, stop)
    if algorithm.GetErrorCode() == _OUT_OF_MEMORY:
        raise MemoryError(messages.errors[0] if messages.errors else "not enough memory")
    for text in messages.warnings:
        warn(text)
    return messages.errors


def update(algorithm: vtkAlgorithm) -> None:
    """Updates a filter. Raises ValueError with the first error that it reports."""
    errors = run(algorithm, algorithm.Update)
    if errors:
        raise ValueError(errors[0])
