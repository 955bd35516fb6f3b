"""read, write and info."""

import json
import os
import pathlib
import unittest
import warnings

from support import TestCase, run_program, sphere

import numpy as np
import pointhaptics as ph


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
            ph.write(self.path("cloud.ply"), sphere(5), {"a b": np.arange(5)})
        self.assertTrue(any("cloud.ply" in str(w.message) for w in caught), caught)

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


if __name__ == "__main__":
    unittest.main()
