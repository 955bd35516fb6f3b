"""Proxy and ServoLoop: the forces of Scene.feel, step by step, and a loop in real time."""

import threading
import time
import unittest

from support import TestCase, sphere

import numpy as np
import pointhaptics as ph


class Proxies(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = ph.Scene(sphere(60000).astype(np.float32))
        cls.coarse = ph.Scene(sphere(20000), dims=100)
        t = np.linspace(0, 1.5, 40)
        angle = np.linspace(0, 1, 40)
        depth = 0.045 - 0.01 * np.sin(np.pi * angle)
        cls.path = np.column_stack([t, depth * np.cos(angle), depth * np.sin(angle), 0.001 * angle])

    def compare(self, scene, rate=1000.0, **options):
        felt = scene.feel(self.path, rate=rate, **options)
        proxy = ph.Proxy(scene, **options)
        steps = np.array([proxy.step((row["hip_x"], row["hip_y"], row["hip_z"]), 1.0 / rate) for row in felt])
        self.assertGreater(felt["contact"].sum(), 100)
        for name in ph.FELT_COLUMNS[:-1]:
            self.assert_same_bits(steps[name], felt[name])

    def test_steps_are_the_rows_of_feel(self):
        self.compare(self.scene)
        self.compare(self.scene, stiffness=500, damping=2, rate=500)

    def test_every_method_and_gain(self):
        for options in (
            {"mu_s": 0.5, "mu_d": 0.2},
            {"mu_d": 0.2, "method": "sphere"},
            {"method": "gradient-steps"},
            {"method": "gradient-steps", "preset": "paper"},
            {"method": "gradient-steps", "gains": {"normal_gain": 0.1, "maximum_steps": 20}},
            {"force_limit": 1.0},
            {"force_limit": np.inf, "stiffness": 3000},
            {"stiffness": 0},
        ):
            with self.subTest(options):
                self.compare(self.coarse, **options)

    def test_options_tell(self):
        def felt(**options):
            return self.coarse.feel(self.path, **options)["force_x"]

        usual = felt()
        for options in ({"force_limit": 1.0}, {"stiffness": 0}, {"method": "gradient-steps"}):
            self.assertFalse(np.array_equal(felt(**options), usual))
        self.assertFalse(np.any(felt(stiffness=0)))
        steps = felt(method="gradient-steps")
        self.assertFalse(np.array_equal(felt(method="gradient-steps", preset="paper"), steps))
        self.assertFalse(np.array_equal(felt(method="gradient-steps", gains={"normal_gain": 0.01}), steps))
        limited = self.coarse.feel(self.path, force_limit=1.0)
        self.assertLessEqual(np.hypot(np.hypot(limited["force_x"], limited["force_y"]), limited["force_z"]).max(), 1 + 1e-12)

    def test_a_step_is_kept_when_the_next_ones_come(self):
        proxy = ph.Proxy(self.coarse)
        first = proxy.step([0, 0, 0.038])
        before = first.tobytes()
        for i in range(1000):
            proxy.step([0, 0, 0.045 - 1e-5 * i])
        self.assertEqual(first.tobytes(), before)
        self.assertEqual(float(proxy.step([0, 0, 0.09])["t"]), 1.001)

    def test_many_proxies_share_a_scene(self):
        alone = ph.Proxy(self.scene)
        expected = [alone.step(place).tobytes()[8:-8] for place in self.path[:, 1:]]
        proxies = [ph.Proxy(self.scene) for _ in range(5)]
        for place, row in zip(self.path[:, 1:], expected):
            for proxy in proxies:
                self.assertEqual(proxy.step(place).tobytes()[8:-8], row)

    def test_bad_input(self):
        proxy = ph.Proxy(self.coarse)
        for kind, words, work in (
            (TypeError, "scene", lambda: ph.Proxy(sphere(5))),
            (ValueError, ["stiffness", "-1"], lambda: ph.Proxy(self.coarse, -1)),
            (ValueError, ["force_limit", "0"], lambda: ph.Proxy(self.coarse, force_limit=0)),
            (ValueError, ["preset", "'soft'", "'paper'"], lambda: ph.Proxy(self.coarse, preset="soft")),
            (ValueError, ["gains", "'k'", "normal_gain"], lambda: ph.Proxy(self.coarse, gains={"k": 1})),
            (ValueError, "gain", lambda: ph.Proxy(self.coarse, gains={"normal_gain": 1e9})),
            (ValueError, ["hand", "(2,)"], lambda: proxy.step([0, 0])),
            (TypeError, "hand", lambda: proxy.step("here")),
            (ValueError, "hand", lambda: proxy.step([0.02])),
            ((TypeError, ValueError), "hand", lambda: proxy.step(0.02)),
            (ValueError, ["dt", "0"], lambda: proxy.step([0, 0, 0], 0)),
            (ValueError, "dt", lambda: proxy.step([0, 0, 0], np.nan)),
            (TypeError, "dt", lambda: proxy.step([0, 0, 0], "soon")),
        ):
            with self.subTest(words):
                self.assert_raises(kind, words, work)
        self.assertEqual(proxy.step([np.nan, 0, 0])["force_x"], 0)


class Loops(TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = ph.Scene(sphere(20000))

    def wait_until(self, condition):
        end = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.005)

    def test_a_hand_is_pushed_out(self):
        with ph.ServoLoop(self.scene, start=(0, 0, 0.045)) as loop:
            loop.target((0, 0, 0.03))
            rows = [loop.trace()]
            self.wait_until(lambda: (rows.append(loop.trace()) or sum(map(len, rows))) > 600)
            self.assertTrue(loop.running)
        felt = np.concatenate([*rows, loop.trace()])
        self.assertFalse(loop.running)
        self.assertGreater(felt["force_z"].max(), 0.5)
        self.assertGreater(felt["hip_z"][-1], 0.032)  # the grip alone would hold it at 30 mm
        self.assertTrue((np.diff(felt["t"]) > 0).all())
        self.assertGreater(loop.statistics()["ticks"], 600)

    def test_a_path_ends_it(self):
        path = [[0, 0, 0, 0.045], [0.3, 0, 0, 0.036]]
        loop = ph.ServoLoop(self.scene, path=path, start=(0, 0, 0.045))
        self.assertTrue(loop.wait(60))
        self.assertGreater(loop.trace()["contact"].sum(), 0)
        loop.stop()
        loop.stop()

    def test_a_callback_sees_and_changes_what_is_felt(self):
        seen = []

        def on_tick(t, hand, force):
            seen.append((t, *hand, *force))
            return (0.0, 0.0, 0.0)

        threads = {threading.get_ident()}
        with ph.ServoLoop(self.scene, start=(0, 0, 0.038), on_tick=on_tick) as loop:
            self.wait_until(lambda: len(seen) > 300)
        self.assertTrue(all(abs(row[3] - 0.038) < 1e-9 for row in seen[:300]))  # nothing pushes it
        self.assertEqual(len(threads), 1)
        del loop

    def test_what_a_callback_raises_ends_the_loop(self):
        def on_tick(t, hand, force):
            if t > 0.02:
                raise RuntimeError("enough")

        loop = ph.ServoLoop(self.scene, start=(0, 0, 0.05), on_tick=on_tick)
        with self.assertRaisesRegex(RuntimeError, "enough"):
            loop.wait(60)
        self.assertFalse(loop.running)
        loop.stop()

    def test_bad_input(self):
        for kind, words, options in (
            (ValueError, ["rate", "0"], {"rate": 0}),
            (ValueError, ["mass", "-1"], {"mass": -1}),
            (ValueError, ["start", "(2,)"], {"start": (0, 0)}),
            (TypeError, "on_tick", {"on_tick": 3}),
            (ValueError, "path", {"path": [[1, 0, 0, 0], [0, 0, 0, 0]]}),
            (ValueError, "N/m", {"stiffness": 1e5}),
        ):
            with self.subTest(options):
                self.assert_raises(kind, words, ph.ServoLoop, self.scene, **options)
        self.assert_raises(TypeError, "scene", ph.ServoLoop, None)


if __name__ == "__main__":
    unittest.main()
