"""Type hints: mypy --strict finds nothing in the examples, the package and its stubs, and knows the types of VTK's classes."""

import os
import subprocess
import sys
import unittest

from support import TestCase

import pointhaptics as ph

PACKAGE = os.path.dirname(os.path.dirname(os.path.abspath(ph.__file__)))
EXAMPLES = os.environ["POINTHAPTICS_EXAMPLES"]
SETTINGS = f"""[mypy]
strict = True
mypy_path = {PACKAGE}
[mypy-vtk,vtkmodules.*,matplotlib.*,pyvista.*]
ignore_missing_imports = True
"""
USE = """
import io
import pathlib
import numpy as np
import pointhaptics as ph
points = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]
voxels = ph.resample(points, voxel=0.1, workspace=[0, 1, 0, 1, 0, 1], attributes={"Time": [1.0, 2.0]})
reveal_type(voxels.counts)
ph.bandwidth(points, counts=[1, 2])
ph.Scene(points, dims=[10, 10, 10]).feel([[0.0, 0.0, 0.0, 0.0]])
ph.Proxy(ph.Scene(points)).step((0.0, 0.0, 0.0))
ph.write(pathlib.Path("a.ply"), voxels)
ph.write(io.BytesIO(), points, {"Time": [1.0, 2.0]}, extension="ply")
reveal_type(ph.read("a.ply")[1].fields)
resampler = ph.vtkVoxelMeanResampler()
resampler.SetDimensions(3, 3, 3)
reveal_type(resampler.GetDimensions())
resampler.SetDimensions(3)
"""


class Types(TestCase):
    def mypy(self, *arguments):
        with open(self.path("mypy.ini"), "w") as file:
            file.write(SETTINGS)
        done = subprocess.run(
            [sys.executable, "-m", "mypy", "--config-file", self.path("mypy.ini"), "--cache-dir", self.path("cache"),
             "--python-executable", sys.executable, *arguments],
            capture_output=True, text=True,
        )  # fmt: skip
        if "No module named mypy" in done.stderr:
            print("skipped: no mypy (package python3-mypy)")
            raise unittest.SkipTest("no mypy")
        return done.stdout

    def test_examples_and_package(self):
        examples = [os.path.join(EXAMPLES, name) for name in sorted(os.listdir(EXAMPLES)) if name.endswith(".py")]
        self.assertGreater(len(examples), 1)
        self.assertRegex(self.mypy(*examples), "Success: no issues found in [2-9] source files")
        self.assertRegex(self.mypy("-p", "pointhaptics"), "Success: no issues found in [1-9][0-9] source files")

    def test_types_are_those_of_the_wrapped_classes(self):
        with open(self.path("use.py"), "w") as file:
            file.write(USE)
        said = self.mypy(self.path("use.py"))
        self.assertIn('"tuple[builtins.int, builtins.int, builtins.int]"', said.replace("Tuple[", "tuple["))
        self.assertIn('"builtins.dict[builtins.str, Any]"', said.replace("typing.Dict", "builtins.dict"))
        errors = [line for line in said.splitlines() if ": error:" in line]
        self.assertEqual(len(errors), 1, said)
        self.assertIn("SetDimensions", errors[0])


if __name__ == "__main__":
    unittest.main()
