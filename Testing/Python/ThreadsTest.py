"""Calls from several threads, signals that raise, other threads of Python, and the end of Python with calls inside."""

import os
import signal
import subprocess
import sys
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

from support import TestCase, sphere

import numpy as np
import pointhaptics as ph

#: Seconds after which an exception of a signal handler must have reached the caller, on a machine however busy. The calls go
#: on for a minute; alone it is 0.2 s.
SOON = 5.0
#: Turns of another thread in a second of a call that gives the GIL up; between reports of progress there are 5 to 40.
TURNS = 60
#: Seconds that a call goes on at least, so that it is still there when the signal comes.
LONG = 60.0


def path_of(place):
    return np.array([[0.0, *(0.045 * place)], [0.2, *(0.036 * place)]])


class TimeIsUp(Exception):
    pass


class Threads(TestCase):
    def test_each_thread_feels_its_own_path_on_one_scene(self):
        angles = np.linspace(0.0, 6.0, 64)
        ways = [path_of(np.array([np.cos(a), np.sin(a), 0.0])) for a in angles]
        scene = ph.Scene(sphere(20000))
        expected = [ph.Scene(sphere(20000)).feel(way) for way in ways[:2]] + [scene.feel(way) for way in ways[2:]]
        with ThreadPoolExecutor(8) as pool:
            felt = list(pool.map(ph.Scene(sphere(20000)).feel, ways))
        for left, right in zip(felt, expected):
            self.assertGreater(right["contact"].sum(), 10)
            for name in ph.FELT_COLUMNS[:-1]:
                self.assert_same_bits(left[name], right[name])

    def test_filters_and_files_in_many_threads(self):
        clouds = [sphere(3000, seed) for seed in range(8)]

        def work(i):
            name = self.path(f"{i}.vtp")
            voxels = ph.resample(clouds[i % 8], voxel=0.002, threads=1 + i % 2)
            ph.write(name, voxels)
            return ph.read(name)[0], ph.bandwidth(voxels.points, counts=voxels.counts).radius

        expected = [work(i) for i in range(8)]
        with ThreadPoolExecutor(8) as pool:
            for i, found in enumerate(pool.map(work, range(48))):
                self.assert_same_bits(found[0], expected[i % 8][0])
                self.assert_same_bits(found[1], expected[i % 8][1])

    def test_another_thread_runs_during_every_long_call(self):
        points = sphere(400000)
        scene = ph.Scene(points)
        name = self.path("cloud.ply")
        ph.write(name, points)
        estimator = ph.vtkKernelBandwidthFilter()
        estimator.SetInputData(ph.arrays.Cloud(points).data)
        reader = ph.vtkPointCloudReader()
        reader.SetFileName(name)
        for title, work in (
            ("resample", lambda: [ph.resample(points, voxel=0.0002) for _ in range(3)]),
            ("bandwidth", lambda: ph.bandwidth(points)),
            ("feel", lambda: scene.feel([[0, 0, 0, 0.045], [5, 0, 0, 0.036]])),
            ("write", lambda: [ph.write(self.path("cloud.csv"), points) for _ in range(2)]),
            ("read", lambda: ph.read(self.path("cloud.csv"))),
            ("vtkKernelBandwidthFilter", estimator.Update),
            ("vtkPointCloudReader", lambda: [(reader.Modified(), reader.Update()) for _ in range(30)]),  # 10 ms each
        ):
            with self.subTest(title):
                turns, ends = [], threading.Event()

                def count():
                    while not ends.is_set():
                        turns.append(time.monotonic())
                        time.sleep(0.0005)

                other = threading.Thread(target=count)
                other.start()
                begin = time.monotonic()
                # Not in the main thread, which hands long calls to another one: the GIL itself must be given up.
                caller = threading.Thread(target=work)
                caller.start()
                caller.join()
                end = time.monotonic()
                ends.set()
                other.join()
                inside = [turn for turn in turns if begin <= turn <= end]
                print(f"{title}: {len(inside) / (end - begin):.0f} turns a second")
                self.assertGreater(len(inside), TURNS * (end - begin), title)

    def test_an_observer_runs_in_a_filter_that_gave_up_the_gil(self):
        resampler = ph.vtkVoxelMeanResampler()
        resampler.SetInputData(ph.arrays.Cloud(sphere(5000)).data)
        seen = []
        resampler.AddObserver("ProgressEvent", lambda caller, event: seen.append(caller.GetProgress()))
        resampler.Update()
        self.assertEqual(seen[-1], 1.0)


@unittest.skipUnless(hasattr(signal, "setitimer"), "no timers here")
class Signals(TestCase):
    def setUp(self):
        super().setUp()
        self.scene = ph.Scene(sphere(20000))
        self.scene.feel([[0, 0, 0, 0.045]])

    def feel_long(self):
        self.scene.feel([[0, 0, 0, 0.045], [80000, 0, 0, 0.036]], rate=1000.0)

    def handle(self, number, kind):
        def handler(*unused):
            self.when = time.monotonic()
            raise kind

        self.addCleanup(signal.signal, number, signal.signal(number, handler))

    def soon(self, title):
        late = time.monotonic() - self.when
        print(f"{title}: raised {1e3 * late:.0f} ms after the handler")
        self.assertLess(late, SOON, title)

    def raised(self, number, kind, work):
        self.handle(number, kind)
        sender = threading.Timer(0.3, os.kill, (os.getpid(), number))
        sender.start()
        self.addCleanup(sender.join)
        with self.assertRaises(kind):
            work()
        self.soon(number)

    def test_what_handlers_raise_comes_from_the_call(self):
        for number, kind in (
            (signal.SIGALRM, TimeIsUp),
            (signal.SIGTERM, SystemExit),
            (signal.SIGINT, KeyboardInterrupt),
            (signal.SIGUSR1, TimeIsUp),
        ):
            with self.subTest(kind):
                self.raised(number, kind, self.feel_long)
        self.assertEqual(len(self.scene.feel([[0, 0, 0, 0.045]])), 1)

    def test_a_timer_ends_every_long_call(self):
        self.handle(signal.SIGALRM, TimeIsUp)
        points = sphere(2000000)
        name = self.path("cloud.csv")
        ph.write(name, points[:500000])
        for title, work in (
            ("resample", lambda: [ph.resample(points, voxel=0.0001, covariance=True) for _ in range(50)]),
            ("bandwidth", lambda: ph.bandwidth(points)),
            ("scene", lambda: [ph.Scene(points).feel([[0, 0, 0, 0.045]]) for _ in range(50)]),
            ("write", lambda: [ph.write(self.path("other.csv"), points) for _ in range(50)]),
            ("read", lambda: [ph.read(name) for _ in range(50)]),
            ("info", lambda: [ph.info(name) for _ in range(50)]),
        ):
            with self.subTest(title):
                signal.setitimer(signal.ITIMER_REAL, 0.1)
                with self.assertRaises(TimeIsUp):
                    work()
                self.soon(title)
        deadline = time.monotonic() + LONG
        while ph.calls._running and time.monotonic() < deadline:
            time.sleep(0.01)
        self.assertEqual(sorted(os.listdir(self.folder)), ["cloud.csv"])  # nothing half-written

    def test_a_timer_ends_filters_of_vtk(self):
        self.handle(signal.SIGALRM, TimeIsUp)
        points = sphere(2000000)
        ph.write(self.path("cloud.csv"), points[:500000])
        reader, writer = ph.vtkPointCloudReader(), ph.vtkPointCloudWriter()
        reader.SetFileName(self.path("cloud.csv"))
        cloud = ph.arrays.Cloud(points)
        estimator = ph.vtkKernelBandwidthFilter()
        estimator.SetInputData(cloud.data)
        writer.SetInputData(cloud.data)
        writer.SetFileName(self.path("other.csv"))
        for title, work in (("reader", reader.Update), ("bandwidth", estimator.Update), ("writer", writer.Write)):
            with self.subTest(title):
                signal.setitimer(signal.ITIMER_REAL, 0.1)
                with self.assertRaises(TimeIsUp):
                    work()
                self.soon(title)
        for algorithm in (reader, estimator):
            self.assertEqual(algorithm.GetOutput().GetNumberOfPoints(), 0)  # it did not go on to its end
        self.assertEqual(os.listdir(self.folder), ["cloud.csv"])
        for algorithm, count in ((reader, 500000), (estimator, len(points))):
            algorithm.Update()
            self.assertEqual(algorithm.GetOutput().GetNumberOfPoints(), count)

    def test_a_handler_that_raises_nothing_disturbs_nothing(self):
        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, lambda *unused: None))
        signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
        self.addCleanup(signal.setitimer, signal.ITIMER_REAL, 0)
        felt = self.scene.feel([[0, 0, 0, 0.045], [20, 0, 0, 0.036]])
        signal.setitimer(signal.ITIMER_REAL, 0)
        expected = self.scene.feel([[0, 0, 0, 0.045], [20, 0, 0, 0.036]])
        self.assert_same_bits(felt["force_z"], expected["force_z"])

    def test_a_handler_may_update_a_filter_while_another_is_updated(self):
        ph.write(self.path("cloud.csv"), sphere(500000))
        ph.write(self.path("small.ply"), sphere(1000))
        read = []

        def handler(*unused):
            small = ph.vtkPointCloudReader()
            small.SetFileName(self.path("small.ply"))
            small.Update()
            read.append(small.GetOutput().GetNumberOfPoints())

        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, handler))
        reader = ph.vtkPointCloudReader()
        reader.SetFileName(self.path("cloud.csv"))
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        reader.Update()
        self.assertEqual((read, reader.GetOutput().GetNumberOfPoints()), ([1000], 500000))


class TheEnd(TestCase):
    """Python ends while calls of daemon threads go on."""

    def end_of(self, work):
        code = f"""
import sys, threading, time
sys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})
from support import sphere
import pointhaptics as ph
points = sphere(300000)
scene = ph.Scene(points[:20000])
scene.feel([[0, 0, 0, 0.045]])
def work():
    while True:
        {work}
for _ in range(2):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=LONG)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_inside_feel(self):
        self.end_of("scene.feel([[0, 0, 0, 0.045], [80000, 0, 0, 0.036]])")

    def test_inside_resample(self):
        self.end_of("ph.resample(points, voxel=0.0002)")

    def test_inside_bandwidth(self):
        self.end_of("ph.bandwidth(points)")

    def test_inside_files(self):
        self.end_of(f"ph.write({self.path('cloud.csv')!r}, points); ph.read({self.path('cloud.csv')!r})")

    def test_inside_a_filter_of_vtk(self):
        self.end_of(
            "f = ph.vtkKernelBandwidthFilter(); f.SetInputData(ph.arrays.Cloud(points).data); f.Update()"
        )

    def test_with_a_loop_that_runs(self):
        self.end_of("loop = ph.ServoLoop(scene, start=(0, 0, 0.05), on_tick=lambda *tick: None); time.sleep(9)")


if __name__ == "__main__":
    unittest.main()
