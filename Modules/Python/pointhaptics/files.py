"""Point cloud files: read, write and look at."""

from __future__ import annotations

import contextlib
import errno
import operator
import os
import shutil
import tempfile
from typing import IO, Any, Dict, Iterator, Mapping, NoReturn, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike, NDArray

from .arrays import Attributes, Cloud, arrays_of, points_of
from .calls import warn
from .classes import vtkPointCloudInfo, vtkPointCloudReader, vtkPointCloudWriter
from .filters import Voxels
from .updates import run, text_of

#: The name of a file, or a binary file object.
Path = Union[str, "os.PathLike[str]", IO[bytes]]
# vtkErrorCode: what a file holds, not the system, is at fault.
_CONTENT = (20003, 20004, 20005)  # UnrecognizedFileType, PrematureEndOfFile, FileFormat
_ERRNOS = {os.strerror(code): code for code in errno.errorcode}


def _name(path: object) -> str:
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path: {path!r}; give the name of a file, or a file opened for bytes")
    name = os.fspath(path)
    if not isinstance(name, str) or not name or "\0" in name:
        raise ValueError(f"path: {path!r}; give the name of a file")
    return name


def _for_vtk(name: str) -> Any:
    """Bytes: VTK's wrapping ends the process where a text is no UTF-8, as names of files may be."""
    return os.fsencode(name)


def _shown_name(file: object) -> str:
    name = getattr(file, "name", None)
    return name if isinstance(name, str) else "<file object>"


@contextlib.contextmanager
def _file_to_read(path: object) -> Iterator[Tuple[str, str]]:
    """The name of a file, and how messages call it."""
    if not hasattr(path, "read"):
        yield (_name(path),) * 2
        return
    shown = _shown_name(path)
    with tempfile.NamedTemporaryFile(suffix=os.path.splitext(shown)[1]) as copy:
        try:
            shutil.copyfileobj(path, copy)
        except TypeError:
            raise TypeError(f"path: {shown!r} gives text; open it for bytes, as open(name, 'rb')") from None
        copy.flush()
        yield copy.name, shown


# Options of the program in messages, and what does the same here.
_SPOKEN = {
    "view and feel take metres about their middle": "local_metres=True gives metres",
    "--salvage (in VTK: SalvageOn())": "salvage=True",
    "--columns NAMES": "columns=...",
    "--columns": "columns",
    "--las-scale sets": "fields={'LasScale': [[0.001, 0.001, 0.001]]} sets",
    "--double keeps": "vtkPointCloudWriter.KeepDoublesOn() keeps",
    "--translate of resample takes": "the transform of resample() takes",
    ", or take --unit": "",
}


def _spoken(message: str) -> str:
    for option, here in _SPOKEN.items():
        message = message.replace(option, here)
    return message


def _fail(message: str, name: str, shown: str, is_content: bool) -> NoReturn:
    """Raises OSError where the system is at fault, ValueError where the content is."""
    message = _spoken(message.replace(name, shown))
    number = next((number for text, number in _ERRNOS.items() if text in message), 0)
    number = errno.EISDIR if os.path.isdir(name) else number
    if not number and is_content:
        raise ValueError(message)
    number = number or errno.EIO
    raise OSError(number, message[len(shown) + 2 :] if message.startswith(shown + ": ") else message, shown)


def _check_readable(name: str) -> None:
    """Raises OSError, with errno and filename, for what cannot be opened. Opens nothing: it may be a pipe."""
    try:
        os.stat(name)
    except FileNotFoundError as error:
        raise OSError(error.errno, f"{os.strerror(errno.ENOENT)}; check the name", name) from None
    number = errno.EISDIR if os.path.isdir(name) else 0 if os.access(name, os.R_OK) else errno.EACCES
    if number:
        raise OSError(number, f"{os.strerror(number)}; name a file that may be read", name)


def _read(
    name: str,
    shown: str,
    salvage: bool = False,
    columns: Sequence[str] = (),
    samples: int = 0,
    local_metres: bool = False,
) -> vtkPointCloudReader:
    _check_readable(name)
    reader = vtkPointCloudReader()
    reader.SetFileName(_for_vtk(name))
    reader.SetSalvage(bool(salvage))
    reader.SetColumns([column.encode() for column in columns])
    reader.SetSamples(samples)
    reader.SetLocalMetres(bool(local_metres))
    errors = run(reader, reader.Update)
    if errors or reader.GetErrorMessage():
        _fail(text_of(reader.GetErrorMessage()) or errors[0], name, shown, True)
    if reader.GetOutput().GetNumberOfPoints() == 0:
        raise ValueError(f"{shown}: holds no points; give a file with at least one")
    return reader


def read(
    path: Path,
    *,
    salvage: bool = False,
    columns: Sequence[str] = (),
    samples: int = 0,
    local_metres: bool = False,
) -> Tuple[NDArray[Any], Attributes]:
    """Read a point cloud; the format goes by content (PLY, PCD, LAS, VTP, OBJ, columns of text ...).

    path: the name of a file, or a file object opened for bytes, which is read to its end.
    salvage: read a file that is cut as far as it goes; a warning says how far.
    columns: names of the columns of a text, for one whose header says nothing or the wrong thing; "-" leaves one out.
    samples: of a file with faces so many points on these, spread evenly, the same ones at each call; arrays are
        interpolated, integers but colours and intensities are those of the nearest vertex. 0: the vertices, in their
        order; a RuntimeWarning says that there are faces.
    local_metres: where x and y are degrees of longitude and latitude, give metres to the east and north of their
        medians, as `feel` of the program takes them: a Scene takes metres.

    Returns points, (n, 3) float64 where the file's numbers need it and float32 otherwise, in the file's frame and
    unit, and attributes, name -> (n,) or (n, components) of the file's type: "RGB", "Normals", "Intensity" ... What
    the file says of the whole cloud, such as its coordinate system, is in attributes.fields. What is not read, such as
    columns of texts, is said by a RuntimeWarning.

    Raises OSError with errno and filename where it cannot be opened (FileNotFoundError ...), ValueError where it is
    damaged, empty or of an unknown format, each with file, format, place, value and cure in one line; MemoryError.
    """
    if isinstance(columns, str) or not all(isinstance(column, str) for column in columns):
        raise TypeError(f"columns: {columns!r}; give a list of names, such as ['x', 'y', 'z']")
    number = operator.index(samples)
    if isinstance(samples, bool) or not 0 <= number <= 100_000_000:
        raise ValueError(f"samples: {samples!r}; give a number from 0 to 100,000,000")
    with _file_to_read(path) as (name, shown):
        reader = _read(name, shown, salvage, columns, number, local_metres)
    for note in reader.GetNotes():
        warn(f"{shown}: {_spoken(note)}")
    output = reader.GetOutput()
    fields = {name: _field_value(values) for name, values in arrays_of(output.GetFieldData()).items()}
    return points_of(output), Attributes(arrays_of(output.GetPointData()), fields)


def _field_value(values: NDArray[Any]) -> Any:
    return values[0] if values.dtype.kind == "U" and len(values) == 1 else values


def write(
    path: Path,
    points: Union[ArrayLike, Voxels],
    attributes: Mapping[str, ArrayLike] = {},
    *,
    fields: Optional[Mapping[str, Any]] = None,
    extension: Optional[str] = None,
) -> None:
    """Write a point cloud with its attributes: .vtp, .ply, .pcd, .las or .csv by extension.

    path: the name of a file, or a file object opened for bytes.
    points: (n, 3), or what resample() returned, which has its arrays with it, counts and covariances among them,
        and in .vtp its lattice.
    attributes: name -> (n,) or (n, components). "RGB" (uint8) and "Normals" become the format's own; texts go into
        .vtp alone.
    fields: name -> array or text, of the whole cloud. Default: those of the attributes, where they come from read().
    extension: such as "ply", where the name does not say it.
    The file appears when it is complete, with every digit. What its format cannot hold is said by a RuntimeWarning.
    Texts (.csv, .xyz) have no types: read() gives small integers as int32, columns of at most 6 digits as float32 and
    others as float64; .astype(numpy.float32) of what was float32 has the bits again.

    Raises TypeError or ValueError for bad arrays and unknown extensions, OSError with errno and filename where the file
    cannot be written, MemoryError.
    """
    if isinstance(points, Voxels):
        lattice = {"LatticeOrigin": points.origin, "LatticeSpacing": points.spacing}
        fields = {**lattice, "LatticeDimensions": points.dimensions, **points.attributes.fields, **(fields or {})}
        attributes = {**points.arrays, **attributes}
        points = points.points
    if fields is None:
        fields = attributes.fields if isinstance(attributes, Attributes) else {}
    if not hasattr(path, "write"):
        name = _name(path)
        _write(name, name, points, attributes, fields, extension)
        return
    shown = _shown_name(path)
    ending = os.path.splitext(shown)[1] if extension is None else f".{extension}"
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "cloud" + ending)
        _write(name, shown, points, attributes, fields, None)
        with open(name, "rb") as written:
            shutil.copyfileobj(written, path)  # type: ignore[arg-type]


def _write(
    name: str,
    shown: str,
    points: ArrayLike,
    attributes: Mapping[str, ArrayLike],
    fields: Mapping[str, Any],
    extension: Optional[str],
) -> None:
    ending = os.path.splitext(name)[1] if extension is None else extension
    if not vtkPointCloudWriter.CanWrite(_for_vtk(name if extension is None else f"cloud.{extension}")):
        raise ValueError(
            f"{shown}: unknown extension {ending!r}; end the name in {vtkPointCloudWriter.GetExtensions()}"
        )
    cloud = Cloud(points, attributes, fields, texts=True)
    writer = vtkPointCloudWriter()
    writer.SetFileName(_for_vtk(name))
    if extension is not None:
        writer.SetExtension(extension)
    writer.SetInputData(cloud.data)
    written = []
    errors = run(writer, lambda: written.append(writer.Write()))
    for note in writer.GetNotes():
        warn(f"{shown}: {_spoken(note)}")
    if errors or written != [1]:
        message = text_of(writer.GetErrorMessage()) or (errors[0] if errors else "cannot be written")
        _fail(message, name, shown, writer.GetErrorCode() in _CONTENT)


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
    with _file_to_read(path) as (name, shown):
        summary = vtkPointCloudInfo()
        reader = _read(name, shown)  # a port does not keep its filter
        summary.SetInputConnection(reader.GetOutputPort())
        errors = run(summary, summary.Update)
    if errors:
        raise ValueError(errors[0])
    result: Dict[str, Any] = {
        "file": shown,
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
