"""Between NumPy's arrays and VTK's: without a copy where the memory has the layout that VTK needs."""

from __future__ import annotations

from os import PathLike
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules import vtkCommonCore as core
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonTransforms import vtkAbstractTransform, vtkMatrixToLinearTransform

_CLASSES = {
    "f4": core.vtkFloatArray,
    "f8": core.vtkDoubleArray,
    "i1": core.vtkSignedCharArray,
    "u1": core.vtkUnsignedCharArray,
    "i2": core.vtkShortArray,
    "u2": core.vtkUnsignedShortArray,
    "i4": core.vtkIntArray,
    "u4": core.vtkUnsignedIntArray,
    "i8": core.vtkLongLongArray,
    "u8": core.vtkUnsignedLongLongArray,
}
# Types that VTK lacks, and the smallest that holds their values.
_WIDENED = {"b1": np.uint8, "f2": np.float32}


def _numbers(values: object, name: str) -> NDArray[Any]:
    """`values` as a C-contiguous array of a type that VTK has; raises where there is none."""
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise TypeError(f"{name}: some values are masked; give an array without a mask, such as a.filled(numpy.nan)")
    try:
        array = np.asarray(values)
    except ValueError as error:  # rows of different lengths
        raise ValueError(f"{name}: {error}; give rows of one length") from None
    code = array.dtype.kind + str(array.dtype.itemsize)
    if code in _WIDENED:
        array = array.astype(_WIDENED[code])
    elif code not in _CLASSES:
        raise TypeError(f"{name}: values of type {array.dtype}; give integers of at most 64 bits, float32 or float64")
    # The array itself where nothing is to be done.
    return np.asarray(array, array.dtype.newbyteorder("="), "C")


def as_points(points: object) -> NDArray[Any]:
    """Points as a C-contiguous (n, 3) array of float32 or float64; integers become float64. Raises where it is none."""
    if isinstance(points, (str, bytes, PathLike)):
        raise TypeError(f"points: {points!r}; give an array of shape (n, 3): read() gives that of a file")
    array = _numbers(points, "points")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"points: shape {array.shape}; give an array of shape (n, 3), one point a row")
    if len(array) == 0:
        raise ValueError("points: shape (0, 3); give at least one point")
    return array if array.dtype.kind == "f" else array.astype(np.float64)


def to_vtk(array: NDArray[Any], name: Optional[str] = None) -> core.vtkDataArray:
    """A VTK array that looks at the memory of `array`, which must be C-contiguous and outlive it."""
    result = _CLASSES[array.dtype.kind + str(array.dtype.itemsize)]()
    if name is not None:
        result.SetName(name)
    result.SetNumberOfComponents(array.shape[1] if array.ndim == 2 else 1)
    result.SetVoidArray(array.reshape(-1), array.size, 1)
    result._numpy_reference = array
    return result


class Attributes(Dict[str, NDArray[Any]]):
    """The attributes of a cloud: name -> (n,) or (n, components); and in .fields what its file says of the whole cloud.

    fields : name -> array, or text: CoordinateSystem, LengthUnit, Viewpoint (tx ty tz qw qx qy qz), OrganizedDimensions
        (width, height), ScanPoses, LasScale ... write() writes them where the format has a place, and warns where not.
        Whoever moves, scales or sorts the points removes those that are then wrong.
    """

    def __init__(self, attributes: Mapping[str, NDArray[Any]] = {}, fields: Mapping[str, Any] = {}) -> None:
        super().__init__(attributes)
        self.fields: Dict[str, Any] = dict(fields)

    def copy(self) -> "Attributes":
        return Attributes(self, self.fields)

    def __or__(self, other: Mapping[str, NDArray[Any]]) -> "Attributes":  # type: ignore[override]
        return Attributes({**self, **other}, {**self.fields, **getattr(other, "fields", {})})

    def __ior__(self, other: Mapping[str, NDArray[Any]]) -> "Attributes":  # type: ignore[override]
        self.update(other)
        self.fields.update(getattr(other, "fields", {}))
        return self

    def __ror__(self, other: Mapping[str, NDArray[Any]]) -> "Attributes":  # type: ignore[override]
        return Attributes({**other, **self}, self.fields)


class Cloud:
    """A vtkPolyData that looks at NumPy's memory, and keeps that memory."""

    def __init__(
        self, points: object, attributes: Mapping[str, object] = {}, fields: Mapping[str, object] = {}, texts: bool = False
    ) -> None:
        self._kept = [as_points(points)]
        self._takes_texts = texts
        self.data = vtkPolyData()
        vtk_points = core.vtkPoints()
        vtk_points.SetData(to_vtk(self._kept[0]))
        self.data.SetPoints(vtk_points)
        if not isinstance(attributes, Mapping):
            raise TypeError(f"attributes: a {type(attributes).__name__}; give a dict of names and arrays")
        for name, values in attributes.items():
            self.add(name, values)
        for name, values in fields.items():
            self._add_field(name, values)

    def __len__(self) -> int:
        return len(self._kept[0])

    def add(self, name: str, values: object, argument: Optional[str] = None) -> None:
        """Adds a point array; "Normals" of three components become the active normals. Errors name the argument."""
        if not isinstance(name, str) or not name:
            raise TypeError(f"attributes: the name {name!r}; give a string that is not empty")
        argument = argument or f"attributes[{name!r}]"
        if self._takes_texts and np.asarray(values).dtype.kind in "UO":
            self._add_texts(name, np.asarray(values), argument)
            return
        array = _numbers(values, argument)
        if array.ndim not in (1, 2) or len(array) != len(self) or array.size == 0:
            raise ValueError(
                f"{argument}: shape {array.shape}; give one row for each of the {len(self)} points, "
                f"({len(self)},) or ({len(self)}, components)"
            )
        self._kept.append(array)
        vtk_array = to_vtk(array, name)
        if field_name(name) == "normals" and array.ndim == 2 and array.shape[1] == 3:
            self.data.GetPointData().SetNormals(vtk_array)
        else:
            self.data.GetPointData().AddArray(vtk_array)


    def _add_texts(self, name: str, texts: NDArray[Any], argument: str) -> None:
        if texts.shape != (len(self),) or not all(isinstance(text, str) for text in texts.tolist()):
            raise ValueError(f"{argument}: shape {texts.shape}; give one text for each of the {len(self)} points")
        self.data.GetPointData().AddArray(texts_to_vtk([str(text) for text in texts.tolist()], name))

    def _add_field(self, name: str, values: object) -> None:
        array = np.atleast_1d(np.asarray(values))
        if array.dtype.kind in "UO":
            self.data.GetFieldData().AddArray(texts_to_vtk([str(text) for text in array.tolist()], name))
            return
        array = _numbers(array, f"field[{name!r}]")
        self._kept.append(array)
        self.data.GetFieldData().AddArray(to_vtk(array, name))


def texts_to_vtk(texts: List[str], name: str) -> core.vtkStringArray:
    """A VTK array of texts."""
    result = core.vtkStringArray()
    result.SetName(name)
    for text in texts:
        result.InsertNextValue(text.encode("utf-8", "surrogateescape"))
    return result


def from_vtk(array: core.vtkAbstractArray) -> NDArray[Any]:
    """A NumPy array that looks at the memory of `array` and keeps it; strings and bits are copied."""
    if isinstance(array, core.vtkStringArray):
        texts = (array.GetValue(i) for i in range(array.GetNumberOfValues()))
        return np.array([t.decode("utf-8", "surrogateescape") if isinstance(t, bytes) else t for t in texts])
    if isinstance(array, core.vtkBitArray):
        bytes_ = core.vtkUnsignedCharArray()
        bytes_.DeepCopy(array)
        array = bytes_
    result: NDArray[Any] = vtk_to_numpy(array)
    return result


def points_of(data: vtkPolyData) -> NDArray[Any]:
    """The points of a vtkPolyData, (n, 3), without a copy."""
    points = data.GetPoints()
    return from_vtk(points.GetData()) if points else np.empty((0, 3), np.float32)


def arrays_of(data: vtkDataSetAttributes, without: Sequence[str] = ()) -> Dict[str, NDArray[Any]]:
    """The arrays of point data by name, in their order, without a copy."""
    result = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(i)
        if array.GetName() not in without:
            result[array.GetName() or f"Array{i}"] = from_vtk(array)
    return result


def as_bounds(workspace: ArrayLike) -> Tuple[float, ...]:
    """x0, x1, y0, y1, z0, z1; raises where these are no box."""
    box = _numbers(workspace, "workspace").astype(np.float64).reshape(-1)
    if box.shape != (6,) or not np.isfinite(box).all() or not (box[0::2] < box[1::2]).all():
        raise ValueError(f"workspace: {workspace!r}; give x0, x1, y0, y1, z0, z1 with x0 < x1, y0 < y1 and z0 < z1")
    return tuple(box.tolist())


_MOST_VOXELS = 1 << 21  # on an axis


def as_dims(dims: object) -> Tuple[int, int, int]:
    """Voxels on each axis, of one number or three; raises where they are none."""
    if np.ndim(dims) > 1:  # type: ignore[arg-type]
        raise ValueError(f"dims: {dims!r}; give one whole number or three, voxels on each axis")
    three = (dims, dims, dims) if np.ndim(dims) == 0 else tuple(dims)  # type: ignore[arg-type]
    if len(three) != 3:
        raise ValueError(f"dims: {dims!r}; give one whole number or three, voxels on each axis")
    x, y, z = (whole(n, "dims", 1, _MOST_VOXELS) for n in three)
    return x, y, z


def field_name(name: str) -> str:
    """One spelling of a field's name: see Core/Base/FieldNames.h."""
    return name.lower().translate({ord(filler): None for filler in "_ -"})


def as_transform(transform: object) -> vtkAbstractTransform:
    """A VTK transform as it is, or one of a 4x4 matrix; raises where it is none."""
    if isinstance(transform, vtkAbstractTransform):
        return transform
    matrix = _numbers(transform, "transform").astype(np.float64)
    if matrix.shape != (4, 4) or not (matrix[3] == (0.0, 0.0, 0.0, 1.0)).all():
        raise ValueError(
            f"transform: shape {matrix.shape}; give an affine matrix of shape (4, 4) whose last row is 0, 0, 0, 1, "
            "or a vtkLinearTransform"
        )
    elements = vtkMatrix4x4()
    elements.DeepCopy(matrix.reshape(-1).tolist())
    linear = vtkMatrixToLinearTransform()
    linear.SetInput(elements)
    return linear


def number(value: object, name: str, low: float, high: float, open_low: bool = False) -> float:
    """`value` as a float in its range; raises TypeError or ValueError with the range."""
    if isinstance(value, (str, bytes)) or value is None:
        raise TypeError(f"{name}: {value!r}; give a number")
    if isinstance(value, (bool, np.bool_)):
        raise ValueError(f"{name}: {value!r}; give a number")
    try:
        result = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise TypeError(f"{name}: {value!r}; give a number") from None
    except OverflowError:
        result = np.inf
    if not (low < result if open_low else low <= result) or not result <= high or result == np.inf:
        least = f"above {low:g}" if open_low else f"from {low:g}"
        span = f"a finite number {least}" if high == np.inf else f"a number {least} to {high:g}"
        raise ValueError(f"{name}: {value!r}; give {span}")
    return result


def whole(value: object, name: str, low: int, high: int) -> int:
    """`value` as an int in its range; raises TypeError or ValueError with the range."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name}: {value!r}; give a whole number")
    if not low <= value <= high:
        raise ValueError(f"{name}: {value!r}; give a whole number from {low} to {high}")
    return int(value)
