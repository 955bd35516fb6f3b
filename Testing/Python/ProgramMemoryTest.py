"""The program under a limit of the address space, from none to enough: done, or one line and exit code 1."""

import os
import resource
import subprocess
import sys
import unittest

from support import PROGRAM, TestCase, run_program

SIZES = 8
ENOUGH = 4 << 30


@unittest.skipUnless(sys.platform == "linux", "needs RLIMIT_AS")
class ProgramMemory(TestCase):
    def tried(self, arguments, limit):
        def before():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))

        return subprocess.run([PROGRAM, *arguments], preexec_fn=before, capture_output=True, text=True, cwd=self.folder)

    def least(self):
        """Bytes in which the program can be loaded."""
        low, high = 1 << 20, ENOUGH
        while high - low > 1 << 20:
            middle = (low + high) // 2
            low, high = (low, middle) if self.tried(["--version"], middle).returncode == 0 else (middle, high)
        return high

    def check(self, arguments, room, output=None):
        ends = []
        least = self.least()
        for i in range(SIZES):
            limit = least + room * i**2 // (SIZES - 1) ** 2 if i < SIZES - 1 else ENOUGH
            with self.subTest(limit=limit):
                before = sorted(os.listdir(self.folder))
                done = self.tried(arguments, limit)
                said = done.stderr.splitlines()
                self.assertIn(done.returncode, (0, 1), done.stderr)
                if done.returncode == 1:
                    self.assertEqual(len(said), 1, done.stderr)
                    self.assertRegex(said[0], "^pointhaptics .*(memory|threads)")
                there = [name for name in sorted(os.listdir(self.folder)) if name not in before]
                self.assertEqual(there, [output] if output and done.returncode == 0 else [])
                for name in there:
                    os.remove(self.path(name))
                ends.append(done.returncode)
        self.assertEqual((ends[0], ends[-1]), (1, 0))

    def setUp(self):
        super().setUp()
        run_program("generate", "sphere", "-n", 200000, "-o", self.path("c.vtp"))

    def test_resample(self):
        self.check(["resample", "c.vtp", "-o", "out.vtp", "--voxel", "0.0003", "--covariance"], 200 << 20, "out.vtp")

    def test_bandwidth(self):
        self.check(["bandwidth", "c.vtp", "-o", "out.ply"], 200 << 20, "out.ply")

    def test_feel(self):
        with open(self.path("h.csv"), "w") as file:
            file.write("t,x,y,z\n0,0,0,0.06\n0.3,0,0,0.04\n")
        self.check(["feel", "c.vtp", "--path", "h.csv", "-o", "out.csv"], 300 << 20, "out.csv")

    def test_view(self):
        if not os.environ.get("DISPLAY"):
            self.skipTest("no display")
        self.check(["view", "c.vtp", "--screenshot", "out.png"], 1300 << 20, "out.png")

    def test_window(self):
        """Ended by SIGTERM where it is shown."""
        if not os.environ.get("DISPLAY"):
            self.skipTest("no display")
        least = self.least()
        for i in range(SIZES):
            limit = least + (1300 << 20) * i**2 // (SIZES - 1) ** 2 if i < SIZES - 1 else ENOUGH
            with self.subTest(limit=limit):
                window = subprocess.Popen(
                    ["prlimit", f"--as={limit}", "--core=0", PROGRAM, "view", "c.vtp"],
                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=self.folder,
                )  # fmt: skip
                try:
                    said = window.communicate(timeout=10)[1]
                    self.assertEqual((window.returncode, len(said.splitlines())), (1, 1), said)
                    self.assertRegex(said, "^pointhaptics view: .*(memory|threads)")
                except subprocess.TimeoutExpired:
                    window.terminate()
                    window.communicate(timeout=60)
                    self.assertIn(window.returncode, (1, 143, -15))  # -15: a slow machine was still loading it
        self.assertIn(window.returncode, (143, -15))

    def test_read_and_write(self):
        run_program("convert", self.path("c.vtp"), self.path("c.csv"))
        self.check(["info", "c.csv"], 200 << 20)
        self.check(["convert", "c.csv", "out.laz"], 200 << 20, "out.laz")


if __name__ == "__main__":
    unittest.main()
