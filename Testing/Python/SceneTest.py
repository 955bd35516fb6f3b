"""Scene.feel: the rows of the program, bit for bit."""

import _thread
import threading
import unittest
import warnings

from support import TestCase, run_program, sphere

import numpy as np
import pointhaptics as ph


def path_over_the_sphere():
    """Into the sphere, along its surface, and out."""
    t = np.linspace(0, 1.5, 40)
    angle = np.linspace(0, 1, 40)
    depth = 0.045 - 0.01 * np.sin(np.pi * angle)
    return np.column_stack([t, depth * np.cos(angle), depth * np.sin(angle), 0.001 * angle])


class Feel(TestCase):
    def program(self, *options):
        run_program("feel", self.path("in.vtp"), "--path", self.path("hip.csv"), "-o", self.path("out.csv"), *options)
        return np.genfromtxt(self.path("out.csv"), delimiter=",", names=True)

    def compare(self, felt, told):
        self.assertEqual(felt.dtype.names, told.dtype.names)
        self.assertEqual(felt.dtype.names, ph.FELT_COLUMNS)
        self.assertGreater(felt["contact"].sum(), 100)
        for name in felt.dtype.names[:-1]:
            self.assert_same_bits(felt[name], told[name])
        self.assertTrue((felt["update_us"] > 0).all())

    def setUp(self):
        super().setUp()
        self.points = sphere(60000).astype(np.float32)
        self.hand = path_over_the_sphere()
        ph.write(self.path("in.vtp"), self.points)
        np.savetxt(self.path("hip.csv"), self.hand, "%.17g", ",", header="t,x,y,z", comments="")

    def test_default(self):
        self.compare(ph.Scene(self.points).feel(self.hand), self.program())

    def test_finer_scenes_near_the_hand_are_those_of_the_program(self):
        run_program("generate", "idol", "-n", 543652, "-o", self.path("in.vtp"), "--force")
        self.hand = np.array([[0, 0, -0.06, 0], [1, 0, 0, 0]], float)
        np.savetxt(self.path("hip.csv"), self.hand, "%.17g", ",", header="t,x,y,z", comments="")
        self.compare(ph.Scene(ph.read(self.path("in.vtp"))[0]).feel(self.hand), self.program())

    def test_gains_methods_and_lattices(self):
        scene = ph.Scene(self.points, dims=100)
        for options, arguments in (
            (("--stiffness", 500, "--damping", 2, "--rate", 500), {"stiffness": 500, "damping": 2, "rate": 500}),
            (("--mu-s", 0.5, "--mu-d", 0.2), {"mu_s": 0.5, "mu_d": 0.2}),
            (("--mu-d", 0.2), {"mu_d": 0.2}),
            (("--method", "sphere"), {"method": "sphere"}),
            (("--method", "gradient-steps"), {"method": "gradient-steps"}),
        ):
            with self.subTest(options):
                self.compare(scene.feel(self.hand, **arguments), self.program("--dims", 100, *options))

    def test_voxel_and_workspace(self):
        scene = ph.Scene(self.points, voxel=0.001, workspace=(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05))
        told = self.program("--voxel", 0.001, "--workspace=-0.05,0.05,-0.05,0.05,-0.05,0.05")
        self.compare(scene.feel(self.hand), told)

    def test_points_far_from_all_others_are_left_out_as_in_the_program(self):
        points = np.concatenate([self.points, [[5.0, 0.0, 0.0]]])
        ph.write(self.path("in.vtp"), points)
        for options in ((), ("--voxel", 0.005), ("--dims", 50)):
            told = self.program(*options)
            arguments = {options[0][2:]: options[1]} if options else {}
            with self.assertWarnsRegex(RuntimeWarning, "1 of .* is far from all others; .* takes it in") as said:
                self.compare(ph.Scene(points, **arguments).feel(self.hand), told)
            self.assertEqual(said.filename, __file__)  # the line of the user, not of the package

    def test_it_says_how_many_points_it_has(self):
        self.assertEqual(repr(ph.Scene(self.points)), f"<pointhaptics.Scene of {len(self.points)} points>")

    def test_a_scene_forgets_the_path_before(self):
        scene = ph.Scene(self.points)
        first = scene.feel(self.hand)
        scene.feel(self.hand[::2] * (1, 1, -1, 1))
        again = scene.feel(self.hand)
        for name in ph.FELT_COLUMNS[:-1]:
            self.assert_same_bits(first[name], again[name])

    def test_a_felt_path_can_be_felt_again(self):
        scene = ph.Scene(self.points)
        first = scene.feel(self.hand)
        again = scene.feel(first)
        np.testing.assert_array_equal(again["force_x"], first["force_x"])

    def test_bad_gains(self):
        scene = ph.Scene(self.points)
        for kind, words, options in (
            (ValueError, ["stiffness", "-1"], {"stiffness": -1}),
            (ValueError, ["stiffness", "nan"], {"stiffness": np.nan}),
            (TypeError, ["damping", "'a'"], {"damping": "a"}),
            (ValueError, ["mu_d", "mu_s"], {"mu_s": 0.1, "mu_d": 0.2}),
            (ValueError, ["rate", "0"], {"rate": 0}),
            (ValueError, ["method", "'soft'", "'sphere'"], {"method": "soft"}),
        ):
            with self.subTest(options):
                self.assert_raises(kind, words, scene.feel, self.hand, **options)

    def test_bad_paths(self):
        scene = ph.Scene(self.points)
        nan = self.hand.copy()
        nan[3, 2] = np.nan
        for kind, words, path in (
            (ValueError, "(0, 4)", np.zeros((0, 4))),
            (ValueError, "(5, 3)", np.zeros((5, 3))),
            (ValueError, "(4,)", np.zeros(4)),
            (TypeError, "<U1", [["a", "b", "c", "d"]]),
            (ValueError, "row 3", nan),
            (ValueError, "row 1", self.hand[::-1]),
            (ValueError, "ticks", self.hand * (1e9, 1, 1, 1)),
            (ValueError, "fields", np.zeros(3, [("t", float), ("x", float)])),
        ):
            with self.subTest(words):
                self.assert_raises(kind, ["path", words], scene.feel, path)

    def test_nothing_to_feel(self):
        self.assert_raises(ValueError, ["points", "finite"], ph.Scene, np.full((4, 3), np.nan))
        far = ph.Scene(self.points, workspace=(1, 2, 1, 2, 1, 2))
        self.assert_raises(ValueError, "workspace", far.feel, self.hand)

    def test_units_that_sizes_make_unlikely_are_a_warning(self):
        scene = ph.Scene(self.points)
        large = ph.Scene(1000 * self.points)
        millimetres = self.hand * (1, 1000, 1000, 1000)
        for words, call in (
            ("multiply the places of the path by 0.001", lambda: scene.feel(millimetres)),
            ("multiply the points and the places of the path by 0.001", lambda: large.feel(millimetres)),
            ("multiply the points by 0.001", lambda: large.feel(self.hand)),
            ("multiply its times by 0.001", lambda: scene.feel(self.hand * (1000, 1, 1, 1), rate=10)),
            ("multiply the places of the path by 0.001", lambda: ph.ServoLoop(scene, path=millimetres).stop()),
        ):
            with self.subTest(words), self.assertWarnsRegex(UserWarning, words):
                call()
        proxy = ph.Proxy(scene)
        with self.assertWarnsRegex(UserWarning, "multiply the places of the path"):
            for place in np.linspace(millimetres[0, 1:], millimetres[-1, 1:], 300) * 2:
                proxy.step(place)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            scene.feel(self.hand)

    def filter_of(self, hand):
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable

        points, cloud, path = vtkPoints(), vtkPolyData(), vtkTable()
        points.SetData(numpy_to_vtk(self.points, deep=True))
        cloud.SetPoints(points)
        for name, column in zip("txyz", hand.T):
            array = numpy_to_vtk(column.copy(), deep=True)
            array.SetName(name)
            path.AddColumn(array)
        feel = ph.vtkHapticFeel()
        feel.SetInputDataObject(0, cloud)
        feel.SetInputDataObject(1, path)
        return feel

    def test_the_filter_warns_of_units_too(self):
        from vtkmodules.vtkCommonDataModel import vtkPolyData

        feel, said = self.filter_of(self.hand * (1, 1000, 1000, 1000)), []

        def keep(caller, event, text):
            said.append(text)

        keep.CallDataType = "string0"
        feel.AddObserver("WarningEvent", keep)
        feel.Update()
        self.assertEqual(len(said), 1)
        self.assertIn("multiply the places of the path by 0.001", said[0])
        for kind in ("ErrorEvent", "WarningEvent"):
            feel.AddObserver(kind, keep)
        said.clear()
        feel.SetInputDataObject(0, vtkPolyData())  # whatever left it empty has said why
        feel.Update()
        self.assertEqual((said, feel.GetErrorCode(), feel.GetOutput().GetNumberOfRows()), ([], 0, 0))
        self.assertGreater(feel.GetOutput().GetNumberOfColumns(), 10)

    def test_each_block_is_felt_alone(self):
        from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet

        feel, said = self.filter_of(self.hand), []
        feel.Update()
        rows = feel.GetOutput().GetNumberOfRows()
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, feel.GetInputDataObject(0, 0))
        blocks.SetBlock(1, vtkImageData())
        feel.SetInputDataObject(0, blocks)
        for kind in ("ErrorEvent", "WarningEvent"):
            feel.AddObserver(kind, lambda caller, event: said.append(event))
        feel.Update()
        found = [feel.GetOutputDataObject(0).GetBlock(index) for index in range(2)]
        self.assertEqual(([table.GetNumberOfRows() for table in found], said), ([rows, 0], ["WarningEvent"]))

    def test_a_block_that_fails_beside_one_that_is_felt_says_so_on_each_update(self):
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData

        feel, said = self.filter_of(self.hand), []
        empty = vtkPolyData()
        empty.ShallowCopy(feel.GetInputDataObject(0, 0))
        points = vtkPoints()
        for _ in range(empty.GetNumberOfPoints()):
            points.InsertNextPoint(np.nan, np.nan, np.nan)
        empty.SetPoints(points)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, empty)
        blocks.SetBlock(1, feel.GetInputDataObject(0, 0))
        feel.SetInputDataObject(0, blocks)
        feel.AddObserver("ErrorEvent", lambda caller, event: said.append(caller.GetErrorCode()))
        codes = []
        for _ in range(3):
            feel.Update()
            codes.append(feel.GetErrorCode())
        self.assertEqual((len(said), min(codes) > 0), (3, True))

    def test_what_an_observer_sets_in_a_run_counts_from_the_next_on(self):
        def soften(caller, event):
            if caller.GetProgress() > 0.5:
                caller.SetStiffness(100)

        feel, largest = self.filter_of(self.hand), []
        feel.AddObserver("ProgressEvent", soften)
        for _ in range(3):
            feel.Update()
            column = feel.GetOutput().GetColumnByName("force_y")
            largest.append(max(column.GetValue(row) for row in range(column.GetNumberOfValues())))
        self.assertGreater(largest[0], 2 * largest[1])
        self.assertEqual(largest[1], largest[2])
        before = feel.GetMTime()
        self.assertEqual(feel.GetMTime(), before)

    def test_an_input_that_an_observer_takes_away_is_an_error(self):
        feel, said = self.filter_of(self.hand), []
        feel.AddObserver("ErrorEvent", lambda caller, event: said.append(event))
        feel.AddObserver("StartEvent", lambda caller, event: caller.RemoveAllInputs())
        feel.Update()
        self.assertEqual(said, ["ErrorEvent"])
        self.assertNotEqual(feel.GetErrorCode(), 0)

    def test_what_an_observer_sets_in_the_inner_resampler_stays(self):
        def coarsen(caller, event):
            if caller.GetProgress() > 0:
                caller.GetResampler().SetVoxelSize(0.006)

        feel, felt = self.filter_of(self.hand), []
        feel.GetResampler().SetVoxelSize(0.002)
        feel.AddObserver("ProgressEvent", coarsen)
        for _ in range(3):
            feel.Update()
            felt.append(feel.GetNumberOfFeltPoints())
            self.assertEqual(feel.GetResampler().GetVoxelSize(), 0.006)
            self.assertTrue(feel.GetResampler().GetAutomaticWorkspace())
        self.assertGreater(felt[0], 4 * felt[1])
        self.assertEqual(felt[1], felt[2])

    def test_the_inner_resampler_asks_for_no_run_of_its_own(self):
        feel, said = self.filter_of(self.hand), []
        feel.AddObserver("ErrorEvent", lambda caller, event: said.append(event))
        feel.GetResampler().SetVoxelSize(1e-12)
        for times in (1, 2):
            feel.Update()
            self.assertEqual(len(said), times)
        feel.RepeatsErrorsOff()
        feel.Update()
        feel.Update()
        self.assertEqual(len(said), 3)
        before = feel.GetResampler().GetMTime()
        self.assertEqual(feel.GetResampler().GetMTime(), before)
        feel.GetResampler().SetVoxelSize(0.002)
        feel.Update()
        self.assertEqual((len(said), feel.GetErrorCode()), (3, 0))

    def test_ctrl_c_ends_a_long_path(self):
        scene = ph.Scene(self.points)
        scene.feel(self.hand[:2])
        slow = self.hand * (2000, 1, 1, 1)  # 3 million ticks
        timer = threading.Timer(0.2, _thread.interrupt_main)
        timer.start()
        self.addCleanup(timer.join)
        with self.assertRaises(KeyboardInterrupt):
            scene.feel(slow)
        self.assertEqual(len(scene.feel(self.hand[:2])), len(scene.feel(self.hand[:2])))


if __name__ == "__main__":
    unittest.main()
