"""The package as a whole: what it offers, its help and its classes."""

import inspect
import subprocess
import sys
import unittest

from support import TestCase, sphere

import pointhaptics as ph


class Package(TestCase):
    def test_signatures_are_the_documented_ones(self):
        for function, expected in (
            (ph.resample, "points voxel dims workspace transform attributes covariance categorical threads "
             "representative minimum_points voxel_index"),
            (ph.bandwidth, "points k rule beta r1 r2 density counts"),
            (ph.read, "path"),
            (ph.write, "path points attributes"),
            (ph.info, "path"),
            (ph.Scene, "points voxel dims workspace"),
            (ph.Scene.feel, "self path stiffness damping mu_s mu_d rate method"),
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


if __name__ == "__main__":
    unittest.main()
