"""resample and bandwidth: equal to the program bit for bit, and clear about bad input."""

import pathlib
import unittest

from support import TestCase, run_program, sphere

import numpy as np
import pointhaptics as ph
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkCommonTransforms import vtkTransform


class EqualsTheProgram(TestCase):
    """Compares results with those of the program, which reads the cloud from a file."""

    def cloud(self, dtype):
        points = sphere(20000).astype(dtype)
        random = np.random.default_rng(2)
        attributes = {
            "Intensity": random.integers(0, 65536, len(points)).astype(np.uint16),
            "Normals": (points / 0.04).astype(np.float32),
            "Label": random.integers(0, 5, len(points)).astype(np.int32),
            "Pair": random.random((len(points), 2)),
        }
        ph.write(self.path("in.vtp"), points, attributes)
        return points, attributes

    def compare(self, voxels, program):
        points, attributes = ph.read(program)
        self.assertGreater(len(voxels), 100)
        self.assert_same_bits(voxels.points, points)
        self.assert_same_bits(voxels.counts, attributes.pop("VoxelPointCount"))
        if voxels.covariance is not None:
            self.assert_same_bits(voxels.covariance, attributes.pop("VoxelCovariance"))
        self.assertEqual(sorted(voxels.attributes), sorted(attributes))
        for name, values in attributes.items():
            self.assert_same_bits(voxels.attributes[name], values)

    def test_float_and_double_points_with_every_attribute(self):
        for dtype in (np.float32, np.float64):
            points, attributes = self.cloud(dtype)
            run_program("resample", self.path("in.vtp"), "-o", self.path("out.vtp"), "--voxel", 0.002, "--covariance")
            self.compare(ph.resample(points, voxel=0.002, attributes=attributes, covariance=True), self.path("out.vtp"))

    def test_default_lattice(self):
        points, attributes = self.cloud(np.float32)
        run_program("resample", self.path("in.vtp"), "-o", self.path("out.vtp"))
        self.compare(ph.resample(points, attributes=attributes), self.path("out.vtp"))

    def test_points_far_from_all_others_are_left_out(self):
        strays = np.random.default_rng(4).normal(size=(150, 3)) * 3
        points = np.concatenate([sphere(5000), strays]).astype(np.float32)
        attributes = {"Label": np.arange(len(points), dtype=np.int32) % 3}
        ph.write(self.path("in.vtp"), points, attributes)
        run_program("resample", self.path("in.vtp"), "-o", self.path("out.vtp"))
        with self.assertWarnsRegex(RuntimeWarning, "150 of 5,150 points are far from all others; .* takes them in"):
            voxels = ph.resample(points, attributes=attributes)
        self.compare(voxels, self.path("out.vtp"))
        self.assertEqual(voxels.clipped, 150)

    def test_transform_workspace_dims_and_threads(self):
        points, attributes = self.cloud(np.float64)
        matrix = np.array([[0, -2, 0, 0.01], [2, 0, 0, 0], [0, 0, 2, -0.02], [0, 0, 0, 1.0]])
        box = (-0.05, 0.06, -0.05, 0.05, -0.1, 0.05)
        run_program(
            "resample", self.path("in.vtp"), "-o", self.path("out.vtp"), "--dims", "40,50,60",
            "--matrix=" + ",".join(map(str, matrix.reshape(-1))), "--workspace=" + ",".join(map(str, box)),
        )  # fmt: skip
        for threads in (None, 1, 2):
            voxels = ph.resample(points, None, (40, 50, 60), box, matrix, attributes, threads=threads)
            self.compare(voxels, self.path("out.vtp"))
            self.assertGreater(voxels.clipped, 0)

    def test_representatives(self):
        points, attributes = self.cloud(np.float32)
        for representative in ("nearest-to-mean", "nearest-to-center", "median"):
            run_program(
                "resample", self.path("in.vtp"), "-o", self.path("out.vtp"), "--voxel", 0.002, "--minimum-points", 3,
                "--representative", representative, "--voxel-index", self.path("index.csv"),
            )  # fmt: skip
            voxels = ph.resample(
                points, voxel=0.002, attributes=attributes,
                representative=representative, minimum_points=3, voxel_index=True,
            )  # fmt: skip
            self.compare(voxels, self.path("out.vtp"))
            self.assertGreaterEqual(voxels.counts.min(), 3)
            index = np.loadtxt(self.path("index.csv"), dtype=np.int64, delimiter=",", skiprows=1)
            self.assert_same_bits(voxels.voxel_index, index.reshape(-1))
            members = np.bincount(voxels.voxel_index[voxels.voxel_index >= 0], minlength=len(voxels))
            self.assert_same_bits(members, voxels.counts)
            if representative == "median":
                self.assertIsNone(voxels.point_ids)
                continue
            self.assert_same_bits(voxels.points, points[voxels.point_ids])
            self.assert_same_bits(voxels.attributes["Pair"], attributes["Pair"][voxels.point_ids])
            self.assert_same_bits(voxels.voxel_index[voxels.point_ids], np.arange(len(voxels)))

    def test_a_vtk_transform_is_its_matrix(self):
        points, _ = self.cloud(np.float64)
        transform = vtkTransform()
        transform.RotateZ(30)
        transform.Scale(1, 2, 3)
        matrix = np.array([[transform.GetMatrix().GetElement(i, j) for j in range(4)] for i in range(4)])
        left = ph.resample(points, voxel=0.002, transform=transform)
        right = ph.resample(points, voxel=0.002, transform=matrix)
        self.assert_same_bits(left.points, right.points)

    def test_bandwidth(self):
        points, _ = self.cloud(np.float32)
        run_program("bandwidth", self.path("in.vtp"), "-o", self.path("out.vtp"), "--rule", "silverman", "--beta", 3,
                    "--r1", 0.0001, "--r2", 0.002, "--neighbors", 12)  # fmt: skip
        _, arrays = ph.read(self.path("out.vtp"))
        found = ph.bandwidth(points, 12, "silverman", 3.0, 0.0001, 0.002, density=True)
        self.assert_same_bits(found.bandwidth, arrays["Bandwidth"])
        self.assert_same_bits(found.radius, arrays["ProxyRadius"])
        self.assert_same_bits(found.density, arrays["Density"])

    def test_bandwidth_of_means_counts_their_points(self):
        points, _ = self.cloud(np.float64)
        run_program("resample", self.path("in.vtp"), "-o", self.path("means.vtp"), "--dims", 40)
        run_program("bandwidth", self.path("means.vtp"), "-o", self.path("out.vtp"))
        _, arrays = ph.read(self.path("out.vtp"))
        voxels = ph.resample(points, dims=40)
        found = ph.bandwidth(voxels.points, counts=voxels.counts)
        self.assert_same_bits(found.radius, arrays["ProxyRadius"])
        self.assertIsNone(found.density)


class Arrays(TestCase):
    def test_points_are_not_copied(self):
        points = sphere(1000)
        cloud = ph.arrays.Cloud(points)
        points[0] = (7, 8, 9)
        self.assertEqual(cloud.data.GetPoint(0), (7, 8, 9))

    def test_results_outlive_what_made_them(self):
        voxels = ph.resample(sphere(5000), voxel=0.002, attributes={"a": np.arange(5000)})
        points, values = voxels.points, voxels.attributes["a"]
        before = points.copy(), values.copy()
        del voxels
        for seed in range(5):  # their memory would be used again
            ph.resample(sphere(5000, seed), voxel=0.002, attributes={"a": np.arange(5000)})
        self.assert_same_bits(points, before[0])
        self.assert_same_bits(values, before[1])

    def test_every_layout_gives_the_same(self):
        points = sphere(3000)
        expected = ph.resample(points, voxel=0.003).points
        wide = np.zeros((3000, 7))
        wide[:, 2:5] = points
        frozen = points.copy()
        frozen.flags.writeable = False
        for name, same in {
            "Fortran order": np.asfortranarray(points),
            "columns of a table": wide[:, 2:5],
            "backwards": points[::-1].copy()[::-1],
            "the other byte order": points.astype(points.dtype.newbyteorder()),
            "a list": points.tolist(),
            "read only": frozen,
        }.items():
            with self.subTest(name):
                self.assert_same_bits(ph.resample(same, voxel=0.003).points, expected)

    def test_every_type_of_attribute_comes_back(self):
        points = sphere(2000)
        values = np.arange(2000) % 100
        for dtype in "i1 u1 i2 u2 i4 u4 i8 u8 f4 f8".split():
            with self.subTest(dtype):
                voxels = ph.resample(points, voxel=0.003, attributes={"a": values.astype(dtype)})
                self.assertEqual(voxels.attributes["a"].dtype, np.dtype(dtype))
                self.assertEqual(voxels.attributes["a"].shape, (len(voxels),))
        flags = ph.resample(points, voxel=0.003, attributes={"a": values > 50}, categorical=["a"])
        self.assertEqual(set(np.unique(flags.attributes["a"])), {0, 1})

    def test_integers_are_points_too(self):
        points = np.array([[0, 0, 0], [1, 0, 0], [5, 5, 5]])
        self.assert_same_bits(ph.resample(points, voxel=2).points, ph.resample(points * 1.0, voxel=2).points)

    def test_not_finite_points_are_counted(self):
        points = sphere(1000)
        points[3] = (np.nan, 0, 0)
        points[5, 2] = np.inf
        voxels = ph.resample(points, voxel=0.005)
        self.assertEqual((voxels.invalid, voxels.clipped, voxels.counts.sum()), (2, 0, 998))
        nothing = ph.resample(np.full((3, 3), np.nan), attributes={"a": np.arange(3)})
        self.assertEqual((nothing.invalid, len(nothing), nothing.points.shape), (3, 0, (0, 3)))
        self.assertEqual(nothing.attributes["a"].shape, (0,))


class BadInput(TestCase):
    def test_points(self):
        for kind, words, points in (
            (ValueError, "(0, 3)", np.empty((0, 3))),
            (ValueError, "(0,)", []),
            (ValueError, "(5,)", np.zeros(5)),
            (ValueError, "(3, 2)", np.zeros((3, 2))),
            (ValueError, "(1, 3, 1)", np.zeros((1, 3, 1))),
            (TypeError, "complex128", np.zeros((2, 3), complex)),
            (TypeError, "<U1", [["a", "b", "c"]]),
            (TypeError, "object", np.full((2, 3), None)),
            (ValueError, "length", [[1, 2, 3], [1, 2]]),
            (TypeError, "object", None),
            (TypeError, "read() gives that of a file", "scan.ply"),
            (TypeError, "read() gives that of a file", pathlib.Path("scan.ply")),
            (TypeError, "masked", np.ma.masked_less(np.zeros((2, 3)), 1)),
        ):
            for function in (ph.resample, ph.bandwidth, ph.Scene):
                with self.subTest(points=points, function=function):
                    self.assert_raises(kind, ["points", words, "give"], function, points)

    def test_attributes(self):
        points = sphere(10)
        for kind, words, attributes in (
            (ValueError, "(9,)", {"a": np.zeros(9)}),
            (ValueError, "(10, 0)", {"a": np.zeros((10, 0))}),
            (ValueError, "()", {"a": 1.0}),
            (ValueError, "(10, 2, 2)", {"a": np.zeros((10, 2, 2))}),
            (TypeError, "object", {"a": [None] * 10}),
            (TypeError, "name 3", {3: np.zeros(10)}),
            (TypeError, "name ''", {"": np.zeros(10)}),
            (TypeError, "a list; give a dict", [np.zeros(10)]),
        ):
            with self.subTest(attributes):
                self.assert_raises(kind, ["attributes", words, "give"], ph.resample, points, attributes=attributes)
        self.assert_raises(ValueError, ["categorical", "'b'", "['a']"], ph.resample, points,
                           attributes={"a": np.zeros(10)}, categorical=["b"])  # fmt: skip

    def test_lattice(self):
        points = sphere(100)
        for kind, words, options in (
            (ValueError, ["voxel", "-1"], {"voxel": -1}),
            (ValueError, ["voxel", "0"], {"voxel": 0}),
            (ValueError, ["voxel", "nan"], {"voxel": np.nan}),
            (ValueError, ["voxel", "inf"], {"voxel": np.inf}),
            (TypeError, ["voxel", "'1'"], {"voxel": "1"}),
            (ValueError, ["voxel", "dims"], {"voxel": 1, "dims": 3}),
            (ValueError, ["dims", "0"], {"dims": 0}),
            (ValueError, ["dims", str(2**40)], {"dims": 2**40}),
            (TypeError, ["dims", "2.5"], {"dims": 2.5}),
            (ValueError, ["dims", "(1, 2)"], {"dims": (1, 2)}),
            (ValueError, ["workspace", "x0"], {"workspace": (0, 0, 0, 1, 0, 1)}),
            (ValueError, ["workspace", "x0"], {"workspace": (0, 1)}),
            (ValueError, ["workspace", "x0"], {"workspace": (0, np.nan, 0, 1, 0, 1)}),
            (ValueError, ["transform", "(3, 3)"], {"transform": np.eye(3)}),
            (ValueError, ["transform"], {"transform": np.ones((4, 4))}),
            (ValueError, ["singular"], {"transform": np.diag([1, 1, 0, 1.0])}),
            (ValueError, ["threads", "0"], {"threads": 0}),
            (TypeError, ["threads", "1.5"], {"threads": 1.5}),
            (ValueError, ["representative", "'nearest'", "'nearest-to-mean'"], {"representative": "nearest"}),
            (ValueError, ["minimum_points", "0"], {"minimum_points": 0}),
            # Only the filter can find these errors.
            (ValueError, ["voxel"], {"voxel": 1e-12}),
            (ValueError, ["voxel"], {"voxel": 5e-324}),
        ):
            with self.subTest(options):
                self.assert_raises(kind, words, ph.resample, points, **options)

    def test_bandwidth(self):
        points = sphere(100)
        for kind, words, options in (
            (ValueError, ["k", "0"], {"k": 0}),
            (TypeError, ["k", "True"], {"k": True}),
            (ValueError, ["rule", "'best'", "'scott'"], {"rule": "best"}),
            (ValueError, ["beta", "0"], {"beta": 0}),
            (ValueError, ["r1", "-1"], {"r1": -1}),
            (ValueError, ["r2", "r1"], {"r1": 2, "r2": 1}),
            (ValueError, ["counts", "(3,)"], {"counts": np.ones(3)}),
        ):
            with self.subTest(options):
                self.assert_raises(kind, words, ph.bandwidth, points, **options)


def headings(filter):
    return {line.split(":")[0].strip() for line in str(filter).splitlines() if ":" in line}


def another(value):
    if value is None:
        return vtkTransform()
    if isinstance(value, tuple):
        return tuple(another(each) for each in value)
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value - 1 if value > 1 else value + 1
    return 0.5 * value if value else 0.001


class Properties(TestCase):
    """Each setting of a filter is a property: set, kept, printed, and a reason to run again."""

    PRINTED_AS = {"Neighborhood": "FixedRadius", "WorkspaceBounds": "Workspace"}
    NOT_SET = {"CategoricalArrays", "NumberOfClippedPoints", "NumberOfInvalidPoints", "NumberOfFeltPoints"}

    def test_of_every_filter(self):
        for kind in (ph.vtkVoxelMeanResampler, ph.vtkKernelBandwidthFilter, ph.vtkHapticFeel):
            names = {name[3:] for name in dir(kind) if name.startswith("Set") and hasattr(kind, "Get" + name[3:])}
            names -= {name[3:] for name in dir(vtkTrivialProducer)}
            settings = {self.PRINTED_AS.get(name, name) for name in names}
            printed = headings(kind()) - headings(vtkTrivialProducer()) - self.NOT_SET
            self.assertGreater(len(names), 5)
            self.assertLessEqual(settings, printed)
            if kind is not ph.vtkHapticFeel:  # of whose parameters some are for programs alone
                self.assertEqual(settings, printed)
            for name in names:
                with self.subTest(name):
                    filter = kind()
                    time = filter.GetMTime()
                    value = another(getattr(filter, "Get" + name)())
                    getattr(filter, "Set" + name)(value)
                    self.assertEqual(getattr(filter, "Get" + name)(), value)
                    self.assertGreater(filter.GetMTime(), time)


if __name__ == "__main__":
    unittest.main()
