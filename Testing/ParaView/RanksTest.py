"""pvbatch on several ranks: each rank reads its own part, and the ranks' pieces one after the other are the program's output.

The pieces are looked at where they are made, on each rank: PieceOfRank.py.
"""

import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
from support import TestCase, arrays_of, read_vtp, run_program, shared_data

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "PieceOfRank.py")
# Not what pvpython's own MPI left: mpirun would take itself for a part of that job. But what run.sh set.
KEPT = ("OMPI_ALLOW_", "OMPI_MCA_rmaps_", "OMPI_MCA_mpi_yield_", "OMPI_MCA_hwloc_")
ENVIRONMENT = {
    name: value for name, value in os.environ.items() if not name.startswith(("PMIX_", "OMPI_")) or name.startswith(KEPT)
}  # fmt: skip


class Ranks(TestCase):
    def run_ranks(self, ranks, path, voxel):
        """Step by step the pieces of the ranks: {name: [{array: values} of each rank]}."""
        pvbatch = ["pvbatch", "--sym", SCRIPT, self.folder, path, str(voxel)]
        done = subprocess.run(["mpirun", "-np", str(ranks), *pvbatch], capture_output=True, text=True, timeout=200,
                              env=ENVIRONMENT)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        pieces = {}
        for name in {file.split(".")[0] for file in os.listdir(self.folder) if file.endswith(".npz")}:
            files = [self.path(f"{name}.{rank}.npz") for rank in range(ranks)]
            pieces[name] = [dict(np.load(file)) for file in files]
            for file in files:
                os.remove(file)
        return pieces

    def assert_joined(self, pieces, expected):
        """The pieces of all ranks against {array: values}, bit for bit."""
        for name, values in expected.items():
            with self.subTest(name):
                joined = np.concatenate([piece[name] for piece in pieces])
                self.assertEqual((joined.dtype, joined.shape), (values.dtype, values.shape))
                self.assertEqual(joined.tobytes(), values.tobytes())
                self.assertGreater(len(values), 0)

    def check(self, path, voxel, numbers_of_ranks, parts=True):
        """Compares run_ranks() with the program for each number of ranks. parts: the format has parts, and each rank reads no
        more than its own.
        """
        self.run_program_on(path, voxel)
        expected = {name: arrays_of(read_vtp(self.path(f"{name}.vtp"))) for name in ("cloud", "means", "radii")}
        found = {ranks: self.run_ranks(ranks, path, voxel) for ranks in numbers_of_ranks}
        for ranks, steps in found.items():
            with self.subTest(ranks=ranks):
                for name, values in expected.items():
                    self.assert_joined(steps[name], values)
                points = len(expected["cloud"]["(points)"])
                for piece in steps["cloud"]:
                    self.assertLess(abs(len(piece["(points)"]) - points / ranks), 1)
                    most = os.path.getsize(path) / (ranks if parts else 1) + 2**20  # headers are in the first megabyte
                    self.assertLessEqual(piece["bytes_read"][0], most)
                means = len(expected["means"]["(points)"])
                for piece in steps["means"]:
                    self.assertLess(abs(len(piece["(points)"]) - means / ranks), 0.1 * means)
        return found

    def run_program_on(self, path, voxel):
        run_program("convert", path, self.path("cloud.vtp"))
        run_program("resample", path, "-o", self.path("means.vtp"), "--voxel", voxel, "--covariance")
        run_program("bandwidth", self.path("means.vtp"), "-o", self.path("radii.vtp"), "--density", "gaussian")

    def test_pieces_of_a_generated_cloud(self):
        run_program("generate", "idol", "-n", 100000, "-o", self.path("in.ply"))
        found = self.check(self.path("in.ply"), 0.002, (1, 2, 3))
        # One rank has all points, and the others learn which arrays there are.
        self.assertEqual([len(piece) for piece in found[3]["first"]][1:], [0, 0])
        self.assert_joined(found[3]["means_of_first"], found[1]["means_of_first"][0])

    def test_pieces_of_lidar(self):
        self.check(shared_data("formats/autzen_trim.laz"), 20, (2,), parts=False)  # few chunks

    def test_pieces_of_a_scan(self):
        self.check(shared_data("office1.pcd"), 0.05, (3,), parts=False)  # compressed


if __name__ == "__main__":
    if not shutil.which("mpirun"):
        print("skipped: mpirun is missing (package openmpi-bin)")
        sys.exit(77)
    unittest.main()
