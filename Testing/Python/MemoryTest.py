"""Every call under a limit of the address space, from none to enough: a result or MemoryError, and nothing half-written."""

import os
import resource
import sys
import unittest
import warnings

from support import TestCase, sphere

import numpy as np
import pointhaptics as ph

SIZES = 8
#: Exit codes of a child.
DONE, NO_MEMORY, OTHER = 0, 3, 4


def address_space():
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[0]) * resource.getpagesize()


def tried(work, room):
    """How `work` ends in a child that gets `room` bytes more than it has: a name of its exit, and what it printed."""
    out, into = os.pipe()
    child = os.fork()
    if child == 0:
        os.dup2(into, 2)
        code = OTHER
        try:
            limit = address_space() + room
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
            warnings.simplefilter("ignore")
            work()
            code = DONE
        except MemoryError:
            code = NO_MEMORY
        except BaseException as fault:
            os.write(2, f"{type(fault).__name__}: {fault}\n".encode())
        finally:
            os._exit(code)
    os.close(into)
    with open(out, "rb") as pipe:
        said = pipe.read()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), said.decode(errors="replace")


@unittest.skipUnless(sys.platform == "linux", "needs /proc and RLIMIT_AS")
class Memory(TestCase):
    def check(self, work, enough, written=None):
        """`work` in rooms from none to `enough` bytes; `written`: a file that is complete or is not there."""
        ends = []
        for i in range(SIZES):
            room = enough * i**2 // (SIZES - 1) ** 2
            with self.subTest(room=room):
                before = sorted(os.listdir(self.folder))
                code, said = tried(work, room)
                self.assertIn(code, (DONE, NO_MEMORY), said)
                # VTK's arrays say so themselves, too.
                lines = [line for line in said.splitlines() if "Unable to allocate" not in line]
                self.assertEqual("".join(lines).replace("\x1b[0m", "").strip(), "")
                if written:
                    there = [name for name in sorted(os.listdir(self.folder)) if name not in before]
                    self.assertEqual(there, [written] if code == DONE else [])
                    if there:
                        os.remove(self.path(written))
                ends.append(code)
        self.assertEqual(ends[-1], DONE)
        return ends

    def test_resample(self):
        points = sphere(1500000)
        ends = self.check(lambda: ph.resample(points, voxel=0.0002, covariance=True, threads=2), 900 << 20)
        self.assertIn(NO_MEMORY, ends)

    def test_representatives(self):
        points = sphere(500000)
        labels = {"Label": np.arange(500000, dtype=np.int32) % 7}
        self.check(
            lambda: ph.resample(
                points, voxel=0.0005, attributes=labels, categorical=["Label"], representative="median", voxel_index=True
            ),
            600 << 20,
        )

    def test_bandwidth(self):
        points = sphere(300000)
        self.assertIn(NO_MEMORY, self.check(lambda: ph.bandwidth(points, density=True), 400 << 20))

    def test_scene_and_feel(self):
        points = sphere(500000)
        ends = self.check(lambda: ph.Scene(points).feel([[0, 0, 0, 0.045], [0.5, 0, 0, 0.036]]), 800 << 20)
        self.assertIn(NO_MEMORY, ends)

    def test_info(self):
        ph.write(self.path("cloud.ply"), sphere(300000))
        self.assertIn(NO_MEMORY, self.check(lambda: ph.info(self.path("cloud.ply")), 400 << 20))

    def test_touch_step_by_step(self):
        scene = ph.Scene(sphere(300000))
        scene.feel([[0, 0, 0, 0.045]])

        def steps():
            proxy = ph.Proxy(scene)
            for i in range(1000):
                proxy.step((0, 0, 0.045 - 1e-5 * i))

        def loop():
            with ph.ServoLoop(scene, path=[[0, 0, 0, 0.045], [0.1, 0, 0, 0.038]]) as running:
                running.wait(5)
                running.trace()

        for work in (steps, loop):
            self.assertIn(NO_MEMORY, self.check(work, 300 << 20))

    def test_the_classes_that_draw(self):
        # In some rooms between these VTK's own libraries end the process while they are loaded.
        for room in (0, 4 << 20, 8 << 20):
            with self.subTest(room=room):
                self.assertEqual(tried(lambda: ph.vtkSplatMapper(), room), (NO_MEMORY, ""))
        self.assertEqual(tried(lambda: ph.vtkSplatMapper(), 300 << 20), (DONE, ""))

    def test_read_and_write(self):
        points = sphere(300000)
        attributes = {"Time": np.arange(300000.0)}
        for extension in ("ply", "pcd", "csv", "vtp", "las", "laz"):
            with self.subTest(extension):
                name = self.path("cloud." + extension)
                self.check(lambda: ph.write(name, points, attributes), 500 << 20, "cloud." + extension)
                self.assertEqual(tried(lambda: ph.write(name, points, attributes), 2 << 30), (DONE, ""))
                self.check(lambda: ph.read(name), 500 << 20)
                os.remove(name)


if __name__ == "__main__":
    unittest.main()
