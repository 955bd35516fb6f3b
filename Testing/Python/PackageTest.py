"""The package as a whole: what it offers, its help and its classes."""

import copy
import dataclasses
import importlib.metadata
import inspect
import os
import pickle
import subprocess
import sys
import unittest

from support import TestCase, sphere

import numpy as np
import pointhaptics as ph


class Package(TestCase):
    def test_signatures_are_the_documented_ones(self):
        for function, expected in (
            (ph.resample, "points voxel dims workspace transform attributes covariance categorical threads "
             "representative minimum_points voxel_index"),
            (ph.bandwidth, "points k rule beta r1 r2 density counts"),
            (ph.read, "path salvage columns samples local_metres"),
            (ph.write, "path points attributes fields extension"),
            (ph.info, "path"),
            (ph.Scene, "points voxel dims workspace"),
            (ph.Scene.feel, "self path stiffness damping mu_s mu_d rate method force_limit preset gains"),
            (ph.Proxy, "scene stiffness damping mu_s mu_d method force_limit preset gains"),
            (ph.Proxy.step, "self hand dt"),
        ):
            with self.subTest(function):
                self.assertEqual(list(inspect.signature(function).parameters), expected.split())

    def test_everything_public_has_help_and_types(self):
        for name in ph.__all__:
            thing = getattr(ph, name)
            if callable(thing):
                self.assertGreater(len(inspect.getdoc(thing)), 40, name)
            if inspect.isfunction(thing):
                hints = inspect.get_annotations(thing)
                self.assertEqual(set(hints), {*inspect.signature(thing).parameters, "return"}, name)

    def test_pydoc_shows_it(self):
        shown = subprocess.run([sys.executable, "-m", "pydoc", "pointhaptics.resample"], capture_output=True, text=True)
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertIn("edge of a cubic voxel", shown.stdout)

    def test_the_classes_work_in_a_pipeline(self):
        resampler = ph.vtkVoxelMeanResampler()
        resampler.SetInputData(ph.arrays.Cloud(sphere(100)).data)
        resampler.SetVoxelSize(0.01)
        radii = ph.vtkKernelBandwidthFilter()
        radii.SetInputConnection(resampler.GetOutputPort())
        radii.Update()
        self.assertTrue(radii.GetOutput().GetPointData().HasArray("ProxyRadius"))
        self.assertEqual(ph.vtkSplatMapper.__name__, "vtkSplatMapper")
        with self.assertRaises(AttributeError):
            ph.vtkNoSuchThing

    def test_a_class_alone_without_input_is_an_exception_not_a_crash(self):
        for filter in (ph.vtkVoxelMeanResampler(), ph.vtkHapticFeel(), ph.vtkPointCloudInfo()):
            with self.assertRaises(ValueError):
                ph.updates.update(filter)

    def test_a_block_of_another_kind_is_no_crash(self):
        from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet

        blocks, info = vtkMultiBlockDataSet(), ph.vtkPointCloudInfo()
        blocks.SetBlock(0, vtkImageData())
        info.SetInputDataObject(blocks)
        info.Update()
        self.assertEqual((info.GetNumberOfPoints(), info.GetErrorCode()), (0, 0))


class Habits(TestCase):
    """Expectations of users of NumPy, pip and pickle."""

    def test_version_and_metadata(self):
        self.assertRegex(ph.__version__, r"^\d+\.\d+\.\d+$")
        found = importlib.metadata.distribution("pointhaptics")
        self.assertEqual(found.version, ph.__version__)
        self.assertEqual(found.metadata["Name"], "pointhaptics")
        for name in ("py.typed", "PointHapticsFilters.pyi", "PointHapticsInteraction.pyi"):
            self.assertTrue(os.path.exists(os.path.join(os.path.dirname(ph.__file__), name)), name)

    def test_every_field_has_help(self):
        for thing in (ph.Voxels, ph.Bandwidths):
            for field in dataclasses.fields(thing):
                self.assertRegex(thing.__doc__, rf"(?m)^ *{field.name} : \S", field.name)
        self.assertIn("-1", ph.Voxels.__doc__)
        self.assertIn("lower one", ph.resample.__doc__)

    def test_scenes_and_voxels_can_be_pickled_and_copied(self):
        path = [[0, 0, 0, 0.045], [0.1, 0, 0, 0.036]]
        scene = ph.Scene(sphere(3000), workspace=(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05))
        expected = scene.feel(path)["force_z"]
        for again in (pickle.loads(pickle.dumps(scene)), copy.copy(scene), copy.deepcopy(scene)):
            self.assert_same_bits(again.feel(path)["force_z"], expected)
        voxels = ph.resample(sphere(3000), voxel=0.005, attributes={"a": np.arange(3000)}, covariance=True)
        again = pickle.loads(pickle.dumps(voxels))
        for name, values in voxels.arrays.items():
            self.assert_same_bits(again.arrays[name], values)

    def test_what_has_a_state_of_its_own_is_not_copied(self):
        scene = ph.Scene(sphere(3000))
        with ph.ServoLoop(scene, start=(0, 0, 0.05)) as loop:
            for thing in (ph.Proxy(scene), loop):
                for copied in (copy.copy, copy.deepcopy, pickle.dumps):
                    self.assert_raises(TypeError, [type(thing).__name__, "Scene"], copied, thing)

    def test_attributes_keep_what_the_file_says_of_all(self):
        attributes = ph.Attributes({"a": np.arange(3)}, {"Viewpoint": np.arange(7)})
        for joined in (attributes | {"b": np.arange(3)}, {"b": np.arange(3)} | attributes, copy.copy(attributes)):
            self.assertEqual((type(joined), list(joined.fields)), (ph.Attributes, ["Viewpoint"]))
            self.assertIn("a", joined)

    def test_messages_name_no_option_of_the_program(self):
        for extension, words in (("las", "fields=.*LasScale"), ("pcd", "KeepDoublesOn")):
            with self.assertWarnsRegex(RuntimeWarning, words) as said:
                ph.write(self.path("cloud." + extension), 1e5 + sphere(1000) / 7)
            self.assertNotIn("--", str(said.warning))

    def test_input_without_points_is_refused_everywhere(self):
        nothing = np.empty((0, 3))
        for function in (ph.resample, ph.bandwidth, ph.Scene, lambda points: ph.write(self.path("a.ply"), points)):
            self.assert_raises(ValueError, ["points", "(0, 3)"], function, nothing)

    def test_a_truth_value_is_no_length(self):
        for wrong in (True, np.True_):
            self.assert_raises(ValueError, ["voxel", "True"], ph.resample, sphere(10), voxel=wrong)
            self.assert_raises(ValueError, ["voxel", "True"], ph.Scene, sphere(10), voxel=wrong)

    def test_counts_are_numbers_of_points(self):
        for wrong in (-1.0, np.nan, np.inf):
            self.assert_raises(ValueError, "counts", ph.bandwidth, sphere(3), counts=[1, 2, wrong])

    def test_normals_are_turned_in_any_case(self):
        points, normals = sphere(1000), np.tile([1.0, 0.0, 0.0], (1000, 1))
        turn = np.array([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
        for name in ("Normals", "normals", "NORMALS"):
            turned = ph.resample(points, voxel=0.01, transform=turn, attributes={name: normals}).attributes[name]
            np.testing.assert_allclose(turned, np.tile([0.0, 1.0, 0.0], (len(turned), 1)), atol=1e-12)

    def test_voxels_know_their_lattice(self):
        points = sphere(2000)
        voxels = ph.resample(points, voxel=0.01, workspace=(-0.05, 0.05, -0.05, 0.05, -0.05, 0.03), voxel_index=True)
        np.testing.assert_allclose(voxels.origin, -0.05)
        np.testing.assert_allclose(voxels.spacing, 0.01)
        self.assertEqual(voxels.dimensions.tolist(), [10, 10, 8])
        inside = voxels.voxel_index >= 0
        self.assertEqual((~inside).sum(), voxels.clipped)
        cells = np.trunc((points[inside] - voxels.origin) / voxels.spacing)
        means = np.trunc((voxels.points[voxels.voxel_index[inside]] - voxels.origin) / voxels.spacing)
        np.testing.assert_array_equal(cells, means)


if __name__ == "__main__":
    unittest.main()
