"""Point cloud files: read, write and look at."""

from __future__ import annotations

import os
import warnings
from typing import Any, Dict, Mapping, Tuple, Union

import numpy as np

from .arrays import Cloud, arrays_of, points_of
from .classes import vtkPointCloudInfo, vtkPointCloudReader, vtkPointCloudWriter
from .updates import run

Path = Union[str, "os.PathLike[str]"]


def _name(path: Path) -> str:
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path: {path!r}; give the name of a file")
    name = os.fspath(path)
    if not isinstance(name, str) or not name or "\0" in name:
        raise ValueError(f"path: {path!r}; give the name of a file")
    return name


def _fail(message: str, name: str, what: str) -> None:
    """Raises OSError where the system is at fault, ValueError where the content is."""
    message = message or f"{name}: cannot be {what}"
    raise (OSError if what == "written" or not os.path.isfile(name) else ValueError)(message)


def _read(name: str) -> vtkPointCloudReader:
    if not os.path.exists(name):
        raise FileNotFoundError(f"{name}: does not exist; check the name")
    reader = vtkPointCloudReader()
    reader.SetFileName(name)
    errors = run(reader, reader.Update)
    if errors or reader.GetErrorMessage():
        _fail(reader.GetErrorMessage() or errors[0], name, "read")
    if reader.GetOutput().GetNumberOfPoints() == 0:
        raise ValueError(f"{name}: holds no points; give a file with at least one")
    return reader


def read(path: Path) -> Tuple[np.ndarray, Dict[str, np.ndarray]]:
    """Read a point cloud; the format goes by content (PLY, PCD, LAS, VTP, OBJ, columns of text ...).

    Returns points, (n, 3) float64 where the file's numbers need it and float32 otherwise, in the file's frame and
    unit, and attributes, name -> (n,) or (n, components) of the file's type: "RGB", "Normals", "Intensity" ...
    Field data of a file, such as its coordinate system, is not in them: see vtkPointCloudReader.

    Raises FileNotFoundError or OSError where it cannot be opened, ValueError where it is damaged or of an unknown
    format, each with file, format, place, value and cure in one line.
    """
    output = _read(_name(path)).GetOutput()
    return points_of(output), arrays_of(output.GetPointData())


def write(path: Path, points: np.ndarray, attributes: Mapping[str, np.ndarray] = {}) -> None:
    """Write a point cloud with its attributes: .vtp, .ply, .pcd, .las or .csv by extension.

    points: (n, 3); attributes: name -> (n,) or (n, components). "RGB" (uint8) and "Normals" become the format's own.
    The file appears when it is complete, with every digit. What its format cannot hold is said by a RuntimeWarning.

    Raises TypeError or ValueError for bad arrays and unknown extensions, OSError where the file cannot be written.
    """
    name = _name(path)
    if not vtkPointCloudWriter.CanWrite(name):
        extension = os.path.splitext(name)[1]
        raise ValueError(
            f"{name}: unknown extension {extension!r}; end the name in {vtkPointCloudWriter.GetExtensions()}"
        )
    cloud = Cloud(points, attributes)
    writer = vtkPointCloudWriter()
    writer.SetFileName(name)
    writer.SetInputData(cloud.data)
    written = []
    errors = run(writer, lambda: written.append(writer.Write()))
    for note in writer.GetNotes():
        warnings.warn(f"{name}: {note}", RuntimeWarning, stacklevel=2)
    if errors or written != [1]:
        _fail(writer.GetErrorMessage() or (errors[0] if errors else ""), name, "written")


def _array_info(summary: vtkPointCloudInfo, array: int) -> Dict[str, Any]:
    low, high = [], []
    for component in range(summary.GetNumberOfComponents(array)):
        span = [0.0, 0.0]
        if summary.GetArrayRange(array, component, span):
            low.append(span[0])
            high.append(span[1])
    return {
        "name": summary.GetArrayName(array),
        "type": summary.GetArrayType(array),
        "components": summary.GetNumberOfComponents(array),
        "min": low,
        "max": high,
    }


def info(path: Path) -> Dict[str, Any]:
    """Say what is in a point cloud file: the entry of `pointhaptics info --json` for it, as a dictionary.

    Keys: file, format, points, points_invalid, points_duplicate, arrays; with a finite point also bounds, spacing
    (median distance to the nearest other point), spacing_percentiles, density_variation, suggested_voxel, unit and
    unit_is_guess; coordinate_system where the file has one; hint and suggested_scale where the size is not about
    that of the 10 cm workspace. Lengths are in the file's unit.

    Raises as read() does.
    """
    name = _name(path)
    summary = vtkPointCloudInfo()
    reader = _read(name)  # a port does not keep its filter
    summary.SetInputConnection(reader.GetOutputPort())
    errors = run(summary, summary.Update)
    if errors:
        raise ValueError(errors[0])
    result: Dict[str, Any] = {
        "file": name,
        "format": summary.GetFormat(),
        "points": summary.GetNumberOfPoints(),
        "points_invalid": summary.GetNumberOfInvalidPoints(),
        "points_duplicate": summary.GetNumberOfDuplicatePoints(),
    }
    if summary.HasBounds():
        box, spacing = [0.0] * 6, [0.0] * 5
        summary.GetBounds(box)
        summary.GetSpacingPercentiles(spacing)
        result["bounds"] = {"min": box[0::2], "max": box[1::2]}
        result["spacing"] = spacing[2]
        result["spacing_percentiles"] = dict(zip(("5", "25", "50", "75", "95"), spacing))
        result["density_variation"] = summary.GetDensityVariation()
        result["suggested_voxel"] = summary.GetSuggestedVoxelSize()
        result["unit"] = summary.GetUnit()
        result["unit_is_guess"] = summary.GetUnitIsGuess()
    if summary.GetCoordinateSystem():
        result["coordinate_system"] = summary.GetCoordinateSystem()
    result["arrays"] = [_array_info(summary, i) for i in range(summary.GetNumberOfArrays())]
    if summary.GetHint():
        result["hint"] = summary.GetHint()
        result["suggested_scale"] = summary.GetSuggestedScale()
    return result
