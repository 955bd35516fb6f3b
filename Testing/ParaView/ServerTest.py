"""The ParaView plugin on a pvserver of two ranks: real clouds come out as the program's, bit for bit.

Started by server.sh, which tells in POINTHAPTICS_SERVER_PORT where the server listens.
"""

import os
import unittest

from paraview import servermanager, simple
from support import ErrorMessages, TestCase, load_plugin, run_program, shared_data

simple.Connect("localhost", int(os.environ["POINTHAPTICS_SERVER_PORT"]))
load_plugin(remote=True)


def read(path):
    return simple.PointHapticsReader(FileNames=[path])


class TwoRanks(TestCase):
    def test_there_are_two(self):
        self.assertEqual(servermanager.ActiveConnection.GetNumberOfDataPartitions(), 2)

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
        run_program("convert", self.path("in.ply"), self.path("program.vtp"))
        found, expected = servermanager.Fetch(read(self.path("out.pcd"))), servermanager.Fetch(read(self.path("in.ply")))
        self.assertEqual(found.GetNumberOfPoints(), expected.GetNumberOfPoints())

    def test_bad_input_is_an_error_and_the_server_lives_on(self):
        run_program("generate", "sphere", "-n", 5000, "-o", self.path("in.ply"))
        with ErrorMessages():
            bad = simple.VoxelMeanResampler(Input=read(self.path("in.ply")), VoxelSize=-1)
            bad.UpdatePipeline()
            self.assertEqual(bad.GetDataInformation().GetNumberOfPoints(), 0)
        bad.VoxelSize = 0.002
        self.resampled(bad, self.path("in.ply"), "--voxel", 0.002)


if __name__ == "__main__":
    unittest.main()
