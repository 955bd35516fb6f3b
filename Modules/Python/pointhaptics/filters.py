"""Mean resampling and kernel bandwidths over NumPy arrays."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Collection, Dict, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray
from vtkmodules.vtkCommonTransforms import vtkAbstractTransform

from .arrays import Attributes, Cloud, arrays_of, as_bounds, as_dims, as_transform, field_name, from_vtk, number
from .arrays import points_of, whole
from .classes import vtkKernelBandwidthFilter, vtkVoxelMeanResampler
from .updates import update

_INT_MAX = (1 << 31) - 1
_COUNTS = "VoxelPointCount"
_COVARIANCE = "VoxelCovariance"
_POINT_IDS = "vtkOriginalPointIds"
_RULES = {
    "normal-reference": vtkKernelBandwidthFilter.NormalReference,
    "silverman-robust": vtkKernelBandwidthFilter.SilvermanRobust,
    "scott": vtkKernelBandwidthFilter.ScottMultivariate,
    "silverman": vtkKernelBandwidthFilter.SilvermanMultivariate,
    "sheather-jones": vtkKernelBandwidthFilter.SheatherJones,
}
_REPRESENTATIVES = {
    "mean": vtkVoxelMeanResampler.Mean,
    "nearest-to-mean": vtkVoxelMeanResampler.NearestToMean,
    "nearest-to-center": vtkVoxelMeanResampler.NearestToCenter,
    "median": vtkVoxelMeanResampler.Median,
}


@dataclass(frozen=True, eq=False)
class Voxels:
    """One row for each active voxel, in the order of the voxels' index (x fastest).

    points : (n, 3), the means of the points, or what else stands for them, of the input's type, in the workspace frame.
    counts : (n,) int64, points of each voxel.
    covariance : (n, 6) float64, XX YY ZZ XY YZ XZ in squared units of the points, or None where not asked for.
    attributes : dict of (n,) or (n, components), each in the input's type; its .fields have the unit and the coordinate
        system of the input's attributes, where no transform was given.
    clipped : finite points outside the workspace, in none of the voxels.
    invalid : points that are NaN or infinite.
    point_ids : (n,) int64, the row of the input that stands for each voxel, where it is one of them, or None.
    voxel_index : (points of the input,) int64, the row of each one's voxel in this table, or -1: clipped, invalid or in
        a voxel with fewer than minimum_points. `voxel_index[i] < 0` must be left out before it is an index, as -1 would
        take the last row: `inside = voxel_index >= 0; points[voxel_index[inside]]`. None where not asked for.
    origin : (3,) float64, the lowest corner of the lattice, workspace frame.
    spacing : (3,) float64, edges of a voxel.
    dimensions : (3,) int, voxels of the lattice on each axis.

    Voxel (i, j, k) covers origin + (i, j, k) * spacing up to, not including, the next one. write() takes such a table in
    the place of points.
    """

    points: NDArray[Any]
    counts: NDArray[np.int64]
    covariance: Optional[NDArray[np.float64]]
    attributes: Attributes = field(repr=False)
    clipped: int
    invalid: int
    point_ids: Optional[NDArray[np.int64]] = field(default=None, repr=False)
    voxel_index: Optional[NDArray[np.int64]] = field(default=None, repr=False)
    origin: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    spacing: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    dimensions: NDArray[np.int64] = field(default_factory=lambda: np.zeros(3, np.int64))

    def __len__(self) -> int:
        return len(self.points)

    @property
    def arrays(self) -> Dict[str, NDArray[Any]]:
        """The attributes, and under the program's names what else is there for each voxel: VoxelPointCount (the counts),
        VoxelCovariance and vtkOriginalPointIds."""
        own = {_COUNTS: self.counts, _COVARIANCE: self.covariance, _POINT_IDS: self.point_ids}
        return {**self.attributes, **{name: values for name, values in own.items() if values is not None}}


@dataclass(frozen=True, eq=False)
class Bandwidths:
    """One row for each point, in the unit of the points; 0 for points that are NaN or infinite.

    bandwidth : (n,) float64, kernel bandwidth.
    radius : (n,) float64, proxy radius.
    density : (n,) float64, points per squared unit over their number, or None where not asked for.
    """

    bandwidth: NDArray[np.float64]
    radius: NDArray[np.float64]
    density: Optional[NDArray[np.float64]]

    def __len__(self) -> int:
        return len(self.bandwidth)


def set_lattice(
    resampler: vtkVoxelMeanResampler,
    voxel: Optional[float],
    dims: Union[int, Sequence[int], None],
    workspace: Optional[ArrayLike],
) -> None:
    """Sets those that are given; raises where they contradict each other or are out of range."""
    if voxel is not None and dims is not None:
        raise ValueError(f"voxel {voxel!r} and dims {dims!r}: two ways to say one thing; give one of them")
    if workspace is not None:
        resampler.SetWorkspaceBounds(as_bounds(workspace))
    if voxel is not None:
        resampler.SetVoxelSize(number(voxel, "voxel", 0.0, np.inf, open_low=True))
    if dims is not None:
        resampler.SetDimensions(*as_dims(dims))


def resample(
    points: ArrayLike,
    voxel: Optional[float] = None,
    dims: Union[int, Sequence[int], None] = None,
    workspace: Optional[ArrayLike] = None,
    transform: Union[ArrayLike, vtkAbstractTransform, None] = None,
    attributes: Optional[Mapping[str, ArrayLike]] = None,
    covariance: bool = False,
    categorical: Collection[str] = (),
    threads: Optional[int] = None,
    *,
    representative: str = "mean",
    minimum_points: int = 1,
    voxel_index: bool = False,
) -> Voxels:
    """Replace the points in each voxel of a regular lattice by their mean, or by one of them.

    Parameters
    ----------
    points : (n, 3), float32 or float64. NaN and infinite points are left out and counted.
    voxel : edge of a cubic voxel in the units of the transformed points, above 0.
    dims : voxels on each axis, one number or three, 1 to 2097152; default 300. Give voxel or dims, not both.
    workspace : x0, x1, y0, y1, z0, z1: box of the lattice in the frame of the transformed points. Points outside are
        left out and counted. Default: a cube about the transformed points, without those far from all others: a
        RuntimeWarning says how many, and the workspace that takes them in.
    transform : (4, 4) affine matrix, applied to the points first, or a vtkLinearTransform.
    attributes : name -> (n,) or (n, components) of numbers. Each is averaged in its own type, integers rounded to
        nearest; "Normals" of three components, in any case, are turned with the transform and normalised.
    covariance : compute the six second moments of each voxel.
    categorical : names of attributes that hold labels: a voxel gets the most frequent one. Names that end with "class",
        "classification", "label", "segment" or "instance" always are, in any case, also in the plural or with an id.
    threads : at most so many, 1 or more; default: as vtkSMPTools is set. The result is the same with any number.
    representative : what stands for the points of a voxel: "mean"; "nearest-to-mean" or "nearest-to-center", the point
        of the input, with its own attributes, whose row is in .point_ids; or "median", coordinate by coordinate and
        component by component: of an even number of values the lower one of the middle two.
    minimum_points : voxels with fewer points are left out, 1 or more.
    voxel_index : find the voxel of each point: .voxel_index, its row, or -1 for points that are in none (see Voxels).

    Returns
    -------
    Voxels, with .points .counts .covariance .attributes .clipped .invalid .point_ids .voxel_index .origin .spacing
    .dimensions

    Raises
    ------
    TypeError, ValueError : one line that names the argument, its value and the cure; no points are a ValueError.
    MemoryError : there is no memory for the result.

    Sums are exact: the result is that of the program and of vtkVoxelMeanResampler, bit for bit, for every order of
    the points. Cost: some nanoseconds a point. Memory: see vtkVoxelMeanResampler; points and attributes that are
    C-contiguous are not copied.
    """
    resampler = vtkVoxelMeanResampler()
    set_lattice(resampler, voxel, dims, workspace)
    if transform is not None:
        resampler.SetTransform(as_transform(transform))
    attributes = {} if attributes is None else attributes
    for name in [categorical] if isinstance(categorical, str) else categorical:
        if field_name(name) not in map(field_name, attributes):
            raise ValueError(f"categorical: no attribute is called {name!r}; give names of {sorted(attributes)}")
        resampler.AddCategoricalArray(name)
    resampler.SetComputeCovariance(bool(covariance))
    if representative not in _REPRESENTATIVES:
        raise ValueError(f"representative: {representative!r}; give one of {', '.join(map(repr, _REPRESENTATIVES))}")
    resampler.SetRepresentative(_REPRESENTATIVES[representative])
    resampler.SetKeepOriginalPointIds(representative.startswith("nearest"))
    resampler.SetMinimumPointsPerVoxel(whole(minimum_points, "minimum_points", 1, _INT_MAX))
    resampler.SetComputeVoxelIndex(bool(voxel_index))
    if threads is not None:
        resampler.SetNumberOfThreads(whole(threads, "threads", 1, _INT_MAX))
    cloud = Cloud(points, attributes)
    resampler.SetInputData(cloud.data)
    update(resampler)
    output = resampler.GetOutput()
    data = output.GetPointData()
    own = (_COUNTS, _COVARIANCE, _POINT_IDS)
    fields = output.GetFieldData()
    point_ids = data.GetArray(_POINT_IDS)
    of_file = getattr(attributes, "fields", {}) if transform is None else {}
    kept = {name: of_file[name] for name in ("CoordinateSystem", "LengthUnit", "HeightUnit") if name in of_file}
    places = resampler.GetOutput(1).GetPointData().GetArray("VoxelIndex") if voxel_index else None
    return Voxels(
        points=points_of(output),
        counts=from_vtk(data.GetArray(_COUNTS)),
        covariance=from_vtk(data.GetArray(_COVARIANCE)) if covariance else None,
        attributes=Attributes(arrays_of(data, without=own), kept),
        clipped=resampler.GetNumberOfClippedPoints(),
        invalid=resampler.GetNumberOfInvalidPoints(),
        point_ids=from_vtk(point_ids) if point_ids else None,
        voxel_index=from_vtk(places) if places else None,
        origin=from_vtk(fields.GetArray("LatticeOrigin")).reshape(3),
        spacing=from_vtk(fields.GetArray("LatticeSpacing")).reshape(3),
        dimensions=from_vtk(fields.GetArray("LatticeDimensions")).reshape(3),
    )


def bandwidth(
    points: ArrayLike,
    k: int = 16,
    rule: str = "normal-reference",
    beta: float = 4.0,
    r1: Optional[float] = None,
    r2: Optional[float] = None,
    density: bool = False,
    *,
    counts: Optional[ArrayLike] = None,
) -> Bandwidths:
    """Kernel bandwidth and proxy radius at every point, from its k nearest neighbours.

    Parameters
    ----------
    points : (n, 3), float32 or float64.
    k : neighbours of each point, itself not counted, 1 or more.
    rule : "normal-reference" (the paper's), "silverman-robust", "scott", "silverman" or "sheather-jones".
    beta : proxy radius over bandwidth, above 0.
    r1, r2 : bounds of the proxy radius in the unit of the points. Default: 2.2 local spacings, and none.
    density : compute the kernel density estimate too, at the cost of a second search.
    counts : (n,) points that each point stands for, as Voxels.counts: bandwidths and radii are then theirs.

    Returns
    -------
    Bandwidths, with .bandwidth .radius .density

    Raises
    ------
    TypeError, ValueError : one line that names the argument, its value and the cure; no points are a ValueError.
    MemoryError : there is no memory for the result.

    Bandwidths are within 1e-9 relative of the definition, the same with any number of threads. Cost: 200 ns a point
    and thread for 16 neighbours; see vtkKernelBandwidthFilter.
    """
    if rule not in _RULES:
        raise ValueError(f"rule: {rule!r}; give one of {', '.join(map(repr, _RULES))}")
    estimator = vtkKernelBandwidthFilter()
    estimator.SetNumberOfNeighbors(whole(k, "k", 1, _INT_MAX))
    estimator.SetRule(_RULES[rule])
    estimator.SetRadiusScale(number(beta, "beta", 0.0, 1e6, open_low=True))
    if r1 is not None:
        estimator.SetMinimumRadius(number(r1, "r1", 0.0, np.inf, open_low=True))
    if r2 is not None:
        estimator.SetMaximumRadius(number(r2, "r2", 0.0, np.inf, open_low=True))
        if r1 is not None and r2 < r1:
            raise ValueError(f"r2: {r2!r} is below r1 {r1!r}; give r1 <= r2")
    estimator.SetComputeDensity(bool(density))
    cloud = Cloud(points)
    if counts is not None:
        cloud.add(_COUNTS, counts, "counts")
        if not (np.asarray(counts) >= 0).all() or not np.isfinite(counts).all():
            raise ValueError("counts: some are negative, NaN or infinite; give the number of points of each row")
    estimator.SetInputData(cloud.data)
    update(estimator)
    data = estimator.GetOutput().GetPointData()
    return Bandwidths(
        bandwidth=from_vtk(data.GetArray("Bandwidth")),
        radius=from_vtk(data.GetArray("ProxyRadius")),
        density=from_vtk(data.GetArray("Density")) if density else None,
    )
