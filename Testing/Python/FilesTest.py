"""read, write and info."""

import errno
import io
import json
import os
import pathlib
import unittest
import warnings

from support import TestCase, run_program, sphere

import numpy as np
import pointhaptics as ph
from pointhaptics import updates
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkTable


def without_nothing(told):
    """The program has all keys for each file, null or empty where there is nothing to say."""
    optional = ("scans", "notes")
    if isinstance(told, dict):
        kept = {key: value for key, value in told.items() if value is not None and not (key in optional and not value)}
        return {key: without_nothing(value) for key, value in kept.items()}
    return [without_nothing(value) for value in told] if isinstance(told, list) else told


class Files(TestCase):
    def test_every_format_gives_back_what_was_written(self):
        points = sphere(500)
        attributes = {
            "RGB": np.arange(1500).reshape(500, 3).astype(np.uint8),
            "Normals": (points / 0.04).astype(np.float32),
            "Time": np.linspace(0, 1, 500),
        }
        for extension in ("vtp", "ply", "pcd", "csv"):
            with self.subTest(extension):
                name = pathlib.Path(self.path("cloud." + extension))
                ph.write(name, points, attributes)
                again, arrays = ph.read(name)
                if extension == "pcd":  # PCL's point types read floats alone
                    np.testing.assert_array_equal(again, points.astype(np.float32))
                else:
                    self.assert_same_bits(again, points)
                for key in ("Time", "RGB"):
                    np.testing.assert_array_equal(arrays[key], attributes[key])
                np.testing.assert_array_equal(arrays["Normals"].astype(np.float32), attributes["Normals"])

    def test_pieces_are_one_cloud(self):
        points = sphere(300)
        for name, rows in (("a.vtp", points[:100]), ("b.vtp", points[100:])):
            ph.write(self.path(name), rows, {"Time": rows[:, 0].copy()})
        with open(self.path("both.pvtp"), "w") as file:
            file.write('<?xml version="1.0"?><VTKFile type="PPolyData"><PPolyData>'
                       '<Piece Source="a.vtp"/><Piece Source="b.vtp"/></PPolyData></VTKFile>')  # fmt: skip
        together, arrays = ph.read(self.path("both.pvtp"))
        self.assert_same_bits(together, points)
        self.assert_same_bits(arrays["Time"], points[:, 0].copy())
        os.remove(self.path("b.vtp"))
        with self.assertRaisesRegex(ValueError, "piece 2 of 2, 'b.vtp': there is no such file"):
            ph.read(self.path("both.pvtp"))

    def test_cut_files_and_columns_without_names(self):
        name = self.path("cut.pts")
        with open(name, "w") as file:
            file.write("3\n1 2 3 4\n5 6 7 8\n")
        with self.assertRaisesRegex(ValueError, "or read what is there by salvage=True"):
            ph.read(name)
        with self.assertWarnsRegex(RuntimeWarning, "the 2 points before are read, of 3"):
            points, _ = ph.read(name, salvage=True)
        self.assertEqual(len(points), 2)
        with open(self.path("rows.txt"), "w") as file:
            file.write("7 1 2 3 4\n8 5 6 7 8\n")
        points, attributes = ph.read(self.path("rows.txt"), columns=["-", "z", "y", "x", "gain"])
        np.testing.assert_array_equal(points, [[3, 2, 1], [7, 6, 5]])
        self.assertEqual(list(attributes), ["gain"])
        with self.assertRaisesRegex(ValueError, "columns has 2 names, and a point needs three"):
            ph.read(self.path("rows.txt"), columns=["x", "y"])
        with self.assertRaisesRegex(TypeError, "give a list of names"):
            ph.read(self.path("rows.txt"), columns="xyz")
        with self.assertWarnsRegex(RuntimeWarning, "are taken as .*; columns=... says otherwise"):
            ph.read(self.path("rows.txt"))

    def test_samples_of_a_mesh_are_those_of_the_program(self):
        with open(self.path("tetrahedron.off"), "w") as file:
            file.write("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        mesh = self.path("tetrahedron.off")
        with self.assertWarnsRegex(RuntimeWarning, "the points are the vertices of 4 faces"):
            self.assertEqual(len(ph.read(mesh)[0]), 4)
        with self.assertWarnsRegex(RuntimeWarning, "3,000 samples of 4 faces"):
            points, arrays = ph.read(mesh, samples=3000)
        run_program("convert", mesh, self.path("samples.vtp"), "--samples", 3000)
        converted, others = ph.read(self.path("samples.vtp"))
        self.assert_same_bits(points, converted)
        self.assert_same_bits(arrays["Normals"], others["Normals"])
        self.assertEqual((len(points), list(arrays)), (3000, ["Normals"]))
        self.assertEqual(json.loads(run_program("info", mesh, "--samples", 7, "--json"))["files"][0]["points"], 7)
        run_program("resample", mesh, "--samples", 3000, "--dims", 40, "-o", self.path("means.vtp"))
        self.assert_same_bits(ph.resample(points, dims=40).points, ph.read(self.path("means.vtp"))[0])
        self.assert_raises(ValueError, "samples: -1", ph.read, mesh, samples=-1)

    def test_info_is_that_of_the_program(self):
        points = sphere(5000)
        points[7] = np.nan
        points[9] = points[8]
        ph.write(self.path("cloud.ply"), points, {"a": np.linspace(-1, 3, 5000), "RGB": np.ones((5000, 3), np.uint8)})
        for name in ("cloud.ply",):
            told = json.loads(run_program("info", "--json", self.path(name)))["files"][0]
            self.assertEqual(ph.info(self.path(name)), without_nothing(told))
        self.assertEqual((told["points_invalid"], told["points_duplicate"]), (1, 1))

    def test_info_of_a_cloud_in_millimetres_hints(self):
        ph.write(self.path("cloud.ply"), 5000 * sphere(500))
        told = json.loads(run_program("info", "--json", self.path("cloud.ply")))["files"][0]
        self.assertIn("hint", told)
        self.assertEqual(ph.info(self.path("cloud.ply")), without_nothing(told))

    def test_what_a_format_cannot_hold_is_a_warning(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            ph.write(self.path("cloud.las"), sphere(5), {"a" * 40: np.arange(5)})
        self.assertTrue(any("cloud.las" in str(w.message) for w in caught), caught)
        self.assertEqual({w.filename for w in caught}, {__file__})  # the user's line

    def test_bad_files(self):
        with open(self.path("bad.ply"), "w") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nend_header\n")
        with open(self.path("empty.csv"), "w"):
            pass
        for function in (ph.read, ph.info):
            self.assert_raises(FileNotFoundError, "nowhere.ply", function, self.path("nowhere.ply"))
            self.assert_raises(OSError, self.folder, function, self.folder)
            self.assert_raises(ValueError, "bad.ply", function, self.path("bad.ply"))
            self.assert_raises(ValueError, "empty.csv", function, self.path("empty.csv"))
            self.assert_raises(TypeError, "3", function, 3)
            self.assert_raises(TypeError, "b''", function, b"")
            self.assert_raises(ValueError, "''", function, "")

    def test_bad_writes(self):
        self.assert_raises(ValueError, [".xyz3", ".ply"], ph.write, self.path("a.xyz3"), sphere(5))
        self.assert_raises(OSError, "nowhere", ph.write, self.path("nowhere/a.ply"), sphere(5))
        self.assert_raises(ValueError, "points", ph.write, self.path("a.ply"), np.zeros((0, 3)))
        self.assert_raises(ValueError, "attributes", ph.write, self.path("a.ply"), sphere(5), {"a": [1]})
        self.assertEqual(os.listdir(self.folder), [])


class WholeClouds(TestCase):
    """Fields of a file beside its columns, and files that are no clouds."""

    def test_fields_travel_from_file_to_file(self):
        with open(self.path("a.pcd"), "w") as file:
            file.write("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 3\n"
                       "VIEWPOINT 1 2 3 1 0 0 0\nPOINTS 6\nDATA ascii\n" + "0 0 1\n" * 6)  # fmt: skip
        points, attributes = ph.read(self.path("a.pcd"))
        self.assertEqual(attributes.fields["OrganizedDimensions"].ravel().tolist(), [2, 3])
        self.assertEqual(attributes.fields["Viewpoint"].ravel().tolist(), [1, 2, 3, 1, 0, 0, 0])
        ph.write(self.path("b.pcd"), points, attributes)
        with open(self.path("b.pcd"), "rb") as file:
            header = file.read(300)
        self.assertIn(b"WIDTH 2\nHEIGHT 3\nVIEWPOINT 1 2 3 1 0 0 0\n", header)
        with self.assertWarnsRegex(RuntimeWarning, "Viewpoint|OrganizedDimensions"):
            ph.write(self.path("b.csv"), points, attributes)

    def test_a_coordinate_system_travels(self):
        points = np.round(sphere(50), 4) + (500000, 5000000, 100)
        ph.write(self.path("a.las"), points, fields={"CoordinateSystem": "EPSG:25832", "LengthUnit": "m"})
        again, attributes = ph.read(self.path("a.las"))
        self.assertEqual(attributes.fields["CoordinateSystem"], "EPSG:25832")
        ph.write(self.path("b.laz"), again, attributes)
        last, attributes = ph.read(self.path("b.laz"))
        self.assertEqual(attributes.fields["CoordinateSystem"], "EPSG:25832")
        self.assert_same_bits(last, again)

    def test_degrees_become_metres_where_they_are_asked_for(self):
        with open(self.path("a.csv"), "w") as file:
            file.write("longitude,latitude,altitude\n" + "".join(f"8.{i},48.5,40\n" for i in range(10)))
        with self.assertWarnsRegex(RuntimeWarning, "degrees .* local_metres=True gives metres"):
            points, attributes = ph.read(self.path("a.csv"))
        self.assertAlmostEqual(points[3, 0], 8.3, places=6)
        self.assertEqual(attributes.fields["LengthUnit"], "degree")
        with self.assertWarnsRegex(RuntimeWarning, "are metres to the east and north"):
            points, attributes = ph.read(self.path("a.csv"), local_metres=True)
        self.assertAlmostEqual(points[9, 0] - points[0, 0], 0.9 * 111195 * np.cos(np.radians(48.5)), delta=10)
        self.assertEqual(attributes.fields["LengthUnit"], "metre")
        reader = ph.vtkPointCloudReader()
        reader.SetFileName(self.path("a.csv"))
        feel = ph.vtkHapticFeel()
        feel.SetInputConnection(0, reader.GetOutputPort())
        path = vtkTable()
        for name, rows in zip("txyz", ([0, 1], [0, 0], [0, 0], [50, 40])):
            column = numpy_to_vtk(np.array(rows, float), deep=True)
            column.SetName(name)
            path.AddColumn(column)
        feel.SetInputData(1, path)
        self.assertIn("let the reader give local metres", updates.run(feel, feel.Update)[0])

    def test_texts_are_kept_or_said(self):
        names = np.array(["tree", "road", "tree"])
        ph.write(self.path("a.vtp"), sphere(3), {"Name": names})
        self.assertEqual(ph.read(self.path("a.vtp"))[1]["Name"].tolist(), names.tolist())
        with self.assertWarnsRegex(RuntimeWarning, "Name"):
            ph.write(self.path("a.ply"), sphere(3), {"Name": names})
        with open(self.path("a.csv"), "w") as file:
            file.write("x,y,z,kind\n1,2,3,tree\n2,3,4,road\n")
        with self.assertWarnsRegex(RuntimeWarning, "kind"):
            ph.read(self.path("a.csv"))

    def test_voxels_are_written_with_their_counts(self):
        voxels = ph.resample(sphere(500), voxel=0.01, covariance=True)
        ph.write(self.path("means.vtp"), voxels)
        points, arrays = ph.read(self.path("means.vtp"))
        self.assert_same_bits(points, voxels.points)
        self.assert_same_bits(arrays["VoxelPointCount"], voxels.counts)
        self.assert_same_bits(arrays["VoxelCovariance"], voxels.covariance)
        np.testing.assert_array_equal(arrays.fields["LatticeSpacing"].ravel(), voxels.spacing)

    def test_attributes_join_with_their_fields(self):
        first = ph.Attributes({"x": np.zeros(2)}, {"f": 1})
        second = ph.Attributes({"y": np.ones(2)}, {"g": 2})
        joined = first | second
        first |= second
        for each in (joined, first):
            self.assertEqual((sorted(each), each.fields), (["x", "y"], {"f": 1, "g": 2}))

    def test_voxels_keep_the_unit_and_the_coordinate_system(self):
        fields = {"CoordinateSystem": "EPSG:25832", "LengthUnit": "foot"}
        points = np.random.default_rng(3).random((500, 3))
        attributes = ph.Attributes({"intensity": np.arange(500.0)}, fields)
        voxels = ph.resample(points, voxel=0.2, attributes=attributes)
        self.assertEqual(voxels.attributes.fields, fields)
        ph.write(self.path("v.las"), voxels)
        self.assertEqual(ph.read(self.path("v.las"))[1].fields["LengthUnit"], "foot")
        moved = ph.resample(points, voxel=0.2, attributes=attributes, transform=np.diag([2.0, 2.0, 2.0, 1.0]))
        self.assertEqual(moved.attributes.fields, {})

    def test_fields_that_a_format_has_no_place_for_are_said(self):
        for extension in ("ply", "pcd", "csv", "las"):
            with self.assertWarnsRegex(RuntimeWarning, "field data 'Owner', 'Run' are left out"):
                ph.write(self.path("a." + extension), sphere(5), fields={"Owner": "a name", "Run": 7})
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            ph.write(self.path("a.vtp"), sphere(5), fields={"Owner": "a name", "Run": 7})
            ph.write(self.path("a.ply"), ph.resample(sphere(50)))
        self.assertEqual(ph.read(self.path("a.vtp"))[1].fields["Owner"], "a name")

    def test_file_objects(self):
        points = sphere(100)
        memory = io.BytesIO()
        ph.write(memory, points, {"a": np.arange(100)}, extension="ply")
        memory.seek(0)
        again, arrays = ph.read(memory)
        self.assert_same_bits(again, points)
        self.assertEqual(arrays["a"].tolist(), list(range(100)))
        with open(self.path("b.csv"), "wb") as file:
            ph.write(file, points)
        with open(self.path("b.csv"), "rb") as file:
            self.assertEqual(ph.info(file)["points"], 100)
        self.assert_raises(TypeError, "bytes", ph.read, io.StringIO("1 2 3"))
        self.assert_raises(ValueError, "extension", ph.write, io.BytesIO(), points)
        self.assert_raises(ValueError, "<file object>", ph.read, io.BytesIO(b"no points"))

    def test_names_of_files_may_be_no_utf8(self):
        points = sphere(5)
        for extension in ("ply", "vtp", "csv"):
            name = os.fsdecode(os.path.join(os.fsencode(self.folder), b"h\xf6\xff." + extension.encode()))
            ph.write(name, points)
            self.assert_same_bits(ph.read(name)[0], points)
            self.assertEqual(ph.info(name)["file"], name)
            os.remove(name)
            with self.assertRaises(FileNotFoundError) as caught:
                ph.read(name)
            self.assertEqual(caught.exception.filename, name)
        damaged = os.fsdecode(os.path.join(os.fsencode(self.folder), b"\xff.ply"))
        with open(damaged, "wb") as file:
            file.write(b"ply\nnonsense\n")
        self.assert_raises(ValueError, "PLY", ph.read, damaged)
        self.assert_raises(ValueError, "surrogates", ph.read, damaged, columns=["\ud800"])
        self.assert_raises(ValueError, "extension", ph.write, self.path("a"), points, extension="\udcff")

    def test_latin_names_of_columns_become_utf8(self):
        for extension, text in (
            ("csv", "x,y,z,h\xf6he\n1,2,3,4\n"),
            ("ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                    "property float h\xf6he\nend_header\n1 2 3 4\n"),
        ):  # fmt: skip
            with open(self.path("latin." + extension), "wb") as file:
                file.write(text.encode("latin-1"))
            points, attributes = ph.read(self.path("latin." + extension))
            self.assertEqual(list(attributes), ["h\xf6he"])
            for other in ("vtp", "ply", "pcd", "csv"):
                ph.write(self.path("again." + other), points, attributes)
                self.assertEqual(list(ph.read(self.path("again." + other))[1]), ["h\xf6he"])

    def test_errors_of_the_system_have_errno_and_filename(self):
        nowhere = self.path("nowhere/a.ply")
        for kind, code, name, work in (
            (FileNotFoundError, errno.ENOENT, self.path("no.ply"), lambda: ph.read(self.path("no.ply"))),
            (FileNotFoundError, errno.ENOENT, self.path("no.ply"), lambda: ph.info(pathlib.Path(self.path("no.ply")))),
            (FileNotFoundError, errno.ENOENT, nowhere, lambda: ph.write(nowhere, sphere(5))),
            (IsADirectoryError, errno.EISDIR, self.folder, lambda: ph.read(self.folder)),
            (IsADirectoryError, errno.EISDIR, self.folder, lambda: ph.write(self.folder, sphere(5), extension="ply")),
            (OSError, errno.ENOSPC, "/dev/full", lambda: ph.write("/dev/full", sphere(5), extension="ply")),
        ):
            with self.subTest(name):
                with self.assertRaises(kind) as caught:
                    work()
                self.assertEqual((caught.exception.errno, caught.exception.filename), (code, name))


if __name__ == "__main__":
    unittest.main()
