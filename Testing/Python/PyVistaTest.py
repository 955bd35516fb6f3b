"""The accessor for PyVista, against a stand-in: Debian has no PyVista."""

import sys
import types
import unittest

from support import TestCase, sphere

import numpy as np
import pointhaptics as ph


class DataSet:
    """The part of a pyvista.DataSet that the accessor uses."""

    def __init__(self, points):
        self.points = points
        self.point_data = {}


class PolyData(DataSet):
    pass


def register_dataset_accessor(name, target_cls, *, override=False):
    """As PyVista's: the accessor is made at the first use, one for each dataset."""
    assert isinstance(name, str) and isinstance(target_cls, type) and not override

    def decorator(accessor):
        def get(self):
            if name not in self.__dict__:
                self.__dict__[name] = accessor(self)
            return self.__dict__[name]

        # A descriptor without __set__: what is in the object's own dictionary comes first.
        setattr(target_cls, name, type("Lazy", (), {"__get__": lambda _, mesh, cls: get(mesh)})())
        return accessor

    return decorator


stand_in = types.ModuleType("pyvista")
stand_in.DataSet, stand_in.PolyData = DataSet, PolyData
stand_in.register_dataset_accessor = register_dataset_accessor
sys.modules["pyvista"] = stand_in

import pointhaptics.pyvista_accessor  # noqa: E402, F401


class Accessor(TestCase):
    def test_resample_and_bandwidth_are_the_functions(self):
        mesh = PolyData(sphere(5000))
        mesh.point_data["a"] = np.arange(5000)
        means = mesh.pointhaptics.resample(voxel=0.002, covariance=True)
        expected = ph.resample(mesh.points, voxel=0.002, attributes=mesh.point_data, covariance=True)
        self.assert_same_bits(means.points, expected.points)
        self.assertEqual(sorted(means.point_data), ["VoxelCovariance", "VoxelPointCount", "a"])
        self.assert_same_bits(means.point_data["a"], expected.attributes["a"])
        self.assert_same_bits(means.point_data["VoxelPointCount"], expected.counts)

        wide = means.pointhaptics.bandwidth(density=True)
        found = ph.bandwidth(expected.points, counts=expected.counts, density=True)
        self.assert_same_bits(wide.point_data["ProxyRadius"], found.radius)
        self.assert_same_bits(wide.point_data["Density"], found.density)
        self.assert_same_bits(wide.point_data["a"], expected.attributes["a"])
        self.assertNotIn("Bandwidth", means.point_data)
        self.assertEqual(sorted(means.pointhaptics.resample(voxel=0.01).point_data), ["VoxelPointCount", "a"])
        nearest = mesh.pointhaptics.resample(voxel=0.002, representative="nearest-to-mean", voxel_index=True)
        ids = np.asarray(nearest.point_data["vtkOriginalPointIds"])
        self.assert_same_bits(np.asarray(mesh.point_data["VoxelIndex"])[ids], np.arange(len(ids)))

    def test_errors_are_those_of_the_functions(self):
        mesh = PolyData(sphere(10))
        self.assertIs(mesh.pointhaptics, mesh.pointhaptics)
        self.assert_raises(ValueError, "voxel", mesh.pointhaptics.resample, voxel=-1)


if __name__ == "__main__":
    unittest.main()
