"""Runs the code blocks in Python of documents and headers. What they need lies in a folder of their own."""

from __future__ import annotations

import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np
import pointhaptics as ph

EXAMPLE = pathlib.Path(__file__).parents[2] / "Documentation/Examples/python/touch.py"
BLOCKS = pathlib.Path(os.environ["POINTHAPTICS_BLOCKS"])


def run(name: str, **names: object) -> dict:
    """Returns what the block has defined."""
    exec(compile((BLOCKS / name).read_text(), name, "exec"), names)
    return names


def ball(count: int = 20000, radius: float = 0.02) -> np.ndarray:
    directions = np.random.default_rng(1).normal(size=(count, 3))
    return radius * directions / np.linalg.norm(directions, axis=1)[:, None]


class Blocks(unittest.TestCase):
    def setUp(self) -> None:
        self.former = os.getcwd()
        self.folder = tempfile.TemporaryDirectory()
        os.chdir(self.folder.name)

    def tearDown(self) -> None:
        os.chdir(self.former)
        self.folder.cleanup()

    def test_readme(self) -> None:
        ph.write("scan.ply", ball())
        np.savetxt("hip.csv", [[0, 0, 0, 0.03], [0.2, 0, 0, 0.015]], delimiter=",", header="t,x,y,z", comments="")
        names = run("README.py")
        self.assertGreater(len(names["voxels"].points), 1000)
        self.assertTrue((names["radii"] > 0).all())
        self.assertGreater(np.abs(names["felt"]["force_z"]).max(), 0.5)

    def test_touch(self) -> None:
        if not os.environ.get("DISPLAY"):
            self.skipTest("no display")
        import touch_fixture

        style, window, interactor = touch_fixture.styled_window(ball())
        seen = touch_fixture.close_soon(interactor)
        touch = run("vtkHapticTouch.py", ph=ph, style=style)["touch"]
        self.assertFalse(touch.IsOn())
        self.assertEqual(touch.GetMessage(), "")
        self.assertGreater(len(seen), 5)

    def test_touch_example(self) -> None:
        """The example as it is, but that the hand moves onto the ball from within and the window is closed."""
        if not os.environ.get("DISPLAY"):
            self.skipTest("no display")
        import touch_fixture

        self.assertLessEqual(len(EXAMPLE.read_text().splitlines()), 15)
        ph.write("ball.ply", ball())
        before, last = EXAMPLE.read_text().rsplit("touch.Run", 1)
        names: dict = {}
        arguments, sys.argv = sys.argv, ["touch.py", "ball.ply"]
        exec(compile(before, str(EXAMPLE), "exec"), names)
        sys.argv = arguments
        touch = names["touch"]
        forces = []

        def feel(event: int) -> bool:
            touch.MoveHand(min(0.001 * event, 0.0215), 0, 0)  # from within
            force = [0.0, 0.0, 0.0]
            touch.GetForce(force)
            forces.append(abs(force[0]))
            return forces[-1] > 0.1

        touch_fixture.close_soon(names["window"].GetInteractor(), 1000, feel)
        exec("touch.Run" + last, names)
        self.assertGreater(max(forces), 0.1)
        self.assertGreater(touch_fixture.lit(names["window"]), 1000)
        colors = touch_fixture.pixels(names["window"])
        self.assertLess(int((colors.min(axis=1) > 240).sum()), 200, "a cloud without normals is no white spot")

    def test_touch_says_what_is_wrong(self) -> None:
        if not os.environ.get("DISPLAY"):
            self.skipTest("no display")
        import touch_fixture

        touch = ph.vtkHapticTouch()
        self.assertFalse(touch.Start(None))
        self.assertIn("there is no style", touch.GetMessage())
        style, window, interactor = touch_fixture.styled_window(5 + ball(radius=1.0))
        self.assertFalse(touch.Start(style))
        self.assertIn("the hand cannot reach the model", touch.GetMessage())
        self.assertIn("SetModelMatrix", touch.GetMessage())
        style, window, interactor = touch_fixture.styled_window(ball())
        self.assertTrue(touch.Start(style), touch.GetMessage())
        self.assertFalse(touch.Start(style))
        self.assertIn("on already", touch.GetMessage())
        self.assertTrue(touch.IsOn())
        touch.SetDeviceName("hammer")
        self.assertFalse(touch.IsOn())
        self.assertFalse(touch.Start(style))
        self.assertIn("hammer", touch.GetMessage())

    def test_help_shows_templates(self) -> None:
        for name in ("vtkVoxelMeanResampler", "vtkHapticFeel", "vtkInteractorStyleHaptic"):
            self.assertRegex(getattr(ph, name).__doc__, rf"\nvtkNew< {name} > \w+;", name)

    def test_study(self) -> None:
        """Run by View.AStudyIsRunAndAnalysed, in windows."""
        for name, lines in (("Study.py", 25), ("Study.2.py", 40)):
            text = (BLOCKS / name).read_text()
            compile(text, name, "exec")
            self.assertLessEqual(len(text.splitlines()), lines)

    def test_paraview(self) -> None:
        """Run by ParaView.Splats, where there is a ParaView."""
        text = (BLOCKS / "ParaView.py").read_text()
        compile(text, "ParaView.py", "exec")
        self.assertIn("LoadPlugin", text)


if __name__ == "__main__":
    unittest.main()
