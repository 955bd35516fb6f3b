"""Whatever is written is read back equal, or said, or refused before the file is touched: formats x names x types."""

import os
import unittest
import warnings

from support import TestCase

import numpy as np
import pointhaptics as ph

POINTS = np.arange(21.0).reshape(7, 3) + 0.5
NAMES = ["R&D", "a<b", 'say "x"', "it's", "two words", "Scan Angle", "Gps Time", "1", "-1", "nan", "1e3", "äöü €",
         "#", "//x", "a,b", "a;b", "a|b", "100 %", "_", "rgb", "RGBA", "n" * 300, "ä" * 150, "x", "X", "tab\there",
         "line\nend", "sep=;", "[m]", " lead", "trail ", "  ", "a_0", "name:0", "red", "nx", "Normals", "intensity",
         "Intensity", "label", "Label", "curvature", "classification", "Points", "Color16", "a%20b", "x [mm]", "E",
         "end_header", "column_4", "\x01a", "\x1b[0m", "\ufffe"]  # fmt: skip
# Names that mean something together.
SETS = [["a_0", "a_1"], ["a", "a_0"], ["red", "green", "blue"], ["r", "g", "b", "a"], ["nx", "ny", "nz"],
        ["two words", "two_words", "two,words"], ["Intensity", "intensity"], ["label", "Label"], ["x", "y", "z"],
        ["n" * 40 + "1", "n" * 40 + "2"], ["Scan Angle", "ScanAngle"], ["RGB", "rgb", "red"], ["unnamed", "_"],
        ["g%d" % i for i in range(200)]]  # fmt: skip
TYPES = [np.float32, np.float64, np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64]
LAS_FIELDS = {"Intensity", "ReturnNumber", "NumberOfReturns", "Classification", "ScanAngle", "UserData",
              "PointSourceId", "GpsTime", "RGB", "Color16"}  # fmt: skip


def values(kind, components=1):
    if np.dtype(kind).kind == "f":
        column = np.array([0, 1, -2.5, 1 / 3, np.finfo(kind).max / 4, np.nan, 5], kind)
    else:
        limits = np.iinfo(kind)
        column = np.array([0, 1, limits.max, limits.min, limits.max - 1, 100, 5], kind)
    return column if components == 1 else np.stack([np.roll(column, k) for k in range(components)], 1)


def are_equal(read, written, extension):
    if read.shape != written.shape:
        return False
    if written.dtype.kind == "f":
        # Text holds the digits that give a number of its type back.
        is_text = extension in ("csv", "xyz")
        return np.array_equal(read.astype(written.dtype) if is_text else read, written, equal_nan=True)
    return read.astype(object).tolist() == written.astype(object).tolist()


def letters(text):
    return "".join(letter for letter in text if letter.isalnum())


class Names(TestCase):
    def check(self, extension, attributes):
        """How it went: equal, said or refused."""
        name = self.path("a." + extension)
        with open(name, "w") as file:
            file.write("before")
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            try:
                ph.write(name, POINTS, attributes)
            except (TypeError, ValueError):
                with open(name) as file:
                    self.assertEqual((file.read(), os.listdir(self.folder)), ("before", ["a." + extension]))
                os.remove(name)
                return "refused"
            points, read = ph.read(name)
        np.testing.assert_array_equal(points, POINTS)
        os.remove(name)
        changed = [
            key for key, array in attributes.items() if key not in read or not are_equal(read[key], array, extension)
        ]
        more = set(read) - set(attributes) - (LAS_FIELDS if extension in ("las", "laz") else set())
        if not changed and not more:
            return "equal"
        for key in changed:
            # Messages cut a long name, and show control characters in their own way.
            said = [str(each.message) for each in told]
            known = [text for text in said if "rounded" in text or letters(key)[:12] in letters(text)]
            self.assertTrue(known, (key, list(read)[:8], said))
        self.assertTrue(told, more)
        return "said"

    def test_every_name_in_every_format(self):
        for extension in ("vtp", "ply", "pcd", "las", "laz", "csv", "xyz"):
            counts = {"equal": 0, "said": 0, "refused": 0}
            for name in NAMES + [""]:
                for kind in TYPES:
                    for components in (1, 3):
                        with self.subTest(extension, name=name[:20], kind=kind.__name__, components=components):
                            counts[self.check(extension, {name: values(kind, components)})] += 1
            for names in SETS:
                with self.subTest(extension, names=names[:4]):
                    self.check(extension, {name: values(TYPES[i % 10]) for i, name in enumerate(names)})
            with self.subTest(extension):
                self.assertEqual(counts["refused"], 20)  # the empty name
                self.assertGreater(counts["equal"], {"vtp": 999, "las": 600, "laz": 600}.get(extension, 700), counts)


if __name__ == "__main__":
    unittest.main()
