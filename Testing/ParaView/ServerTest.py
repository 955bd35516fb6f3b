"""The ParaView plugin on a pvserver: real clouds come out as the program's, bit for bit, and each rank has its part.

Started by server.sh, which tells in POINTHAPTICS_SERVER_PORT where the server listens, and in POINTHAPTICS_SERVER_RANKS how
many ranks it has.
"""

import os
import unittest

import numpy as np
from paraview import servermanager, simple
from support import ErrorMessages, TestCase, arrays_of, load_plugin, read_vtp, run_program, shared_data
from vtkmodules.util.numpy_support import vtk_to_numpy

RANKS = int(os.environ["POINTHAPTICS_SERVER_RANKS"])
simple.Connect("localhost", int(os.environ["POINTHAPTICS_SERVER_PORT"]))
load_plugin(remote=True)


def read(path):
    return simple.PointHapticsReader(FileNames=[path])


def points_of_ranks(proxy):
    """How many points of a proxy's output each rank of the server has."""
    numbered = servermanager.Fetch(simple.ProcessIdScalars(Input=proxy))
    return np.bincount(arrays_of(numbered)["ProcessId"].astype(int), minlength=RANKS).tolist()


class Server(TestCase):
    def test_it_has_the_ranks(self):
        self.assertEqual(servermanager.ActiveConnection.GetNumberOfDataPartitions(), RANKS)

    def test_each_rank_has_its_part(self):
        run_program("generate", "idol", "-n", 200000, "-o", self.path("in.ply"))
        cloud = read(self.path("in.ply"))
        self.assertEqual(points_of_ranks(cloud), [200000 // RANKS] * RANKS)
        cloud.UpdatePropertyInformation()
        most = os.path.getsize(self.path("in.ply")) / RANKS + 2**20  # headers are looked for in the first megabyte
        self.assertLess(cloud.GetPropertyValue("NumberOfBytesRead"), most)
        means = points_of_ranks(simple.VoxelMeanResampler(Input=cloud, VoxelSize=0.002))
        self.assertGreater(min(means), 0.3 * sum(means))

    def test_the_reader_gives_the_program_its_cloud(self):
        for path in (shared_data("office1.pcd"), shared_data("formats/autzen_trim.laz")):
            with self.subTest(path):
                run_program("convert", path, "-o", self.path("program.vtp"))
                self.assert_same_bits(servermanager.Fetch(read(path)), read_vtp(self.path("program.vtp")))

    def test_splats_are_drawn_here_and_there(self):
        """By the client that gets the points, and by the server."""
        if not os.environ.get("DISPLAY"):
            self.skipTest("no display")
        run_program("generate", "sphere", "-n", 5000, "-o", self.path("in.ply"))
        cloud = read(self.path("in.ply"))
        for threshold in (1000, 0):
            lit = {}
            view = simple.CreateRenderView(ViewSize=[300, 300])
            self.addCleanup(simple.Delete, view)
            view.OrientationAxesVisibility = view.UseColorPaletteForBackground = 0
            view.Background, view.RemoteRenderThreshold = [0, 0, 0], threshold
            shown = simple.Show(cloud, view)
            shown.ColorArrayName = [None, ""]
            view.ResetCamera()
            for representation in ("Points", "Point Haptics Splats"):
                shown.SetRepresentationType(representation)
                simple.Render(view)
                picture = vtk_to_numpy(view.CaptureWindow(1).GetPointData().GetScalars())
                lit[representation] = (picture[:, :3].max(axis=1) > 0).sum()
            self.assertGreater(lit["Point Haptics Splats"], 1.2 * lit["Points"])

    def test_blocks_on_many_ranks_are_an_error_and_no_hang(self):
        run_program("generate", "sphere", "-n", 5000, "-o", self.path("in.ply"))
        blocks = simple.GroupDatasets(Input=[read(self.path("in.ply")), simple.PLYReader(FileNames=[self.path("in.ply")])])
        for proxy in (simple.VoxelMeanResampler(Input=blocks, VoxelSize=0.1), simple.KernelBandwidth(Input=blocks)):
            with ErrorMessages() as messages:
                proxy.UpdatePipeline()
            if RANKS > 1:
                self.assertIn("Merge Blocks", " ".join(messages.found))
            points = proxy.GetDataInformation().GetNumberOfPoints()
            self.assertTrue(points == 0 if RANKS > 1 else points > 0, points)

    def test_a_fault_that_one_rank_meets_is_told(self):
        with open(self.path("bad.csv"), "w") as file:
            file.write("x,y,z\n" + "".join(f"{i},{i % 7},{i % 3}\n" for i in range(20000)) + "1,2,three\n")
        with ErrorMessages() as messages:
            bad = read(self.path("bad.csv"))
            bad.UpdatePipeline()
        self.assertIn("three", " ".join(messages.found))
        self.assertEqual(bad.GetDataInformation().GetNumberOfPoints(), 0)

    def test_a_scan_of_rooms(self):
        path = shared_data("office1.pcd")
        self.resampled(simple.VoxelMeanResampler(Input=read(path), LatticeMode="Dimensions"), path)

    def test_lidar_with_labels_and_colors(self):
        path = shared_data("formats/autzen_trim.laz")
        means = simple.VoxelMeanResampler(Input=read(path), VoxelSize=20, ComputeCovariance=1)
        self.resampled(means, path, "--voxel", 20, "--covariance")

    def test_bandwidths_of_a_statue(self):
        path = shared_data("bun_zipper.ply")
        run_program("resample", path, "-o", self.path("means.vtp"), "--voxel", 0.002)
        means = simple.VoxelMeanResampler(Input=read(path), VoxelSize=0.002)
        self.bandwidths(simple.KernelBandwidth(Input=means), self.path("means.vtp"), "--density", "none")

    def test_without_real_clouds(self):
        run_program("generate", "idol", "-n", 20000, "-o", self.path("in.ply"))
        means = simple.VoxelMeanResampler(Input=read(self.path("in.ply")), VoxelSize=0.002)
        self.resampled(means, self.path("in.ply"), "--voxel", 0.002)
        self.bandwidths(simple.KernelBandwidth(Input=read(self.path("in.ply"))), self.path("in.ply"), "--density",
                        "none")  # fmt: skip

    def test_the_writer_writes_one_file(self):
        run_program("generate", "sphere", "-n", 5000, "-o", self.path("in.ply"))
        simple.SaveData(self.path("out.pcd"), proxy=read(self.path("in.ply")))
        run_program("convert", self.path("in.ply"), self.path("program.pcd"))
        found, expected = (servermanager.Fetch(read(self.path(name))) for name in ("out.pcd", "program.pcd"))
        self.assert_same_bits(found, expected)

    def test_a_cloud_without_points_is_not_written(self):
        run_program("generate", "sphere", "-n", 5000, "-o", self.path("in.ply"))
        box = {"WorkspacePosition": [9, 9, 9], "WorkspaceSize": [1, 1, 1]}
        none = simple.VoxelMeanResampler(Input=read(self.path("in.ply")), AutomaticWorkspace=0, VoxelSize=0.1, **box)
        with ErrorMessages() as errors:
            simple.SaveData(self.path("out.pcd"), proxy=none)
        self.assertEqual(len(errors.found), 1, errors.found)
        self.assertIn("the cloud holds no points", errors.found[0])

    def test_bad_input_is_an_error_and_the_server_lives_on(self):
        run_program("generate", "sphere", "-n", 5000, "-o", self.path("in.ply"))
        box = {"WorkspacePosition": [9, 9, 9], "WorkspaceSize": [1, 1, 1]}
        with ErrorMessages() as errors, ErrorMessages("WarningEvent") as warnings:
            bad = simple.VoxelMeanResampler(Input=read(self.path("in.ply")), VoxelSize=-1, **box)
            for size, automatic in ((-1, 1), (0.002, 0)):
                bad.VoxelSize, bad.AutomaticWorkspace = size, automatic
                for _ in range(2):
                    bad.UpdatePipeline()
                    self.assertEqual(servermanager.Fetch(bad).GetNumberOfPoints(), 0)
        self.assertEqual((len(errors.found), len(warnings.found)), (1, 1), errors.found + warnings.found)
        self.assertIn("No point is left: 5000 lie outside", warnings.found[0])
        bad.AutomaticWorkspace = 1
        self.resampled(bad, self.path("in.ply"), "--voxel", 0.002)


if __name__ == "__main__":
    unittest.main()
