"""Shared by the tests of the ParaView plugin. Run by pvpython or pvbatch with Testing/ParaView/run.sh."""

import os
import subprocess
import tempfile
import unittest

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

PROGRAM = os.environ["POINTHAPTICS_PROGRAM"]
SHARED_DATA = os.environ["POINTHAPTICS_SHARED_DATA"]


def load_plugin(remote=False):
    """Loads the plugin into the client, and with remote into the server it is connected to."""
    plugin = os.environ["POINTHAPTICS_PLUGIN"]
    if remote:
        simple.LoadPlugin(plugin, remote=True)
    simple.LoadPlugin(plugin, remote=False, ns=vars(simple))


def run_program(*arguments):
    """Runs the program; returns what it prints."""
    # Libraries of ParaView's root are not for the program.
    environment = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        raise AssertionError(f"pointhaptics {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def read_vtp(path):
    """A .vtp file as a vtkPolyData, without any class of this project."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def shared_data(name):
    """The path of a real cloud; skips the test where the folder of real clouds is missing."""
    path = os.path.join(SHARED_DATA, name)
    if not os.path.exists(path):
        raise unittest.SkipTest(f"{name} is not in {SHARED_DATA}")
    return path


def arrays_of(cloud):
    """Points and point arrays of a vtkPolyData by name; none of an empty one."""
    if not cloud.GetPoints():
        return {}
    arrays = {"(points)": vtk_to_numpy(cloud.GetPoints().GetData())}
    for index in range(cloud.GetPointData().GetNumberOfArrays()):
        array = cloud.GetPointData().GetArray(index)
        arrays[array.GetName()] = vtk_to_numpy(array)
    return arrays


class ErrorMessages:
    """Collects what goes to the message window meanwhile: with ErrorMessages() as messages: ... messages.found"""

    def __init__(self, event="ErrorEvent"):
        self.event = event

    def __enter__(self):
        self.found = []
        self.window = vtkOutputWindow.GetInstance()
        self.tag = self.window.AddObserver(self.event, self.add)
        return self

    def __exit__(self, *_):
        self.window.RemoveObserver(self.tag)

    def add(self, _window, _event, text):
        self.found.append(text)

    add.CallDataType = "string0"


class TestCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def assert_same_bits(self, found, expected):
        """Two clouds (vtkPolyData) with the same points and point arrays, bit for bit."""
        left, right = arrays_of(found), arrays_of(expected)
        self.assertEqual(sorted(left), sorted(right))
        for name, array in right.items():
            with self.subTest(name):
                self.assertEqual((left[name].dtype, left[name].shape), (array.dtype, array.shape))
                self.assertEqual(left[name].tobytes(), array.tobytes())
                self.assertGreater(len(array), 0)

    def resampled(self, proxy, path, *options):
        """Compares a proxy's output with what the program's resample makes of a file."""
        run_program("resample", path, "-o", self.path("program.vtp"), *options)
        self.assert_same_bits(servermanager.Fetch(proxy), read_vtp(self.path("program.vtp")))

    def bandwidths(self, proxy, path, *options):
        """Compares a proxy's output with what the program's bandwidth makes of a file."""
        run_program("bandwidth", path, "-o", self.path("program.vtp"), *options)
        self.assert_same_bits(servermanager.Fetch(proxy), read_vtp(self.path("program.vtp")))
