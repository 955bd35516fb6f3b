"""The representation Point Haptics Splats: points close to a surface, and are coloured, saved and selected as others."""

import os
import pathlib
import re
import unittest

import numpy as np
from paraview import simple, smstate
from support import TestCase, load_plugin, run_program
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
SPLATS = "Point Haptics Splats"
SIZE = 300


def new_view():
    view = simple.CreateRenderView(ViewSize=[SIZE, SIZE])
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0, 0, 0]
    return view


def pixels(view):
    """The picture as numbers of 0 to 255, rows from below."""
    simple.Render(view)
    image = view.CaptureWindow(1)
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(SIZE, SIZE, -1)[..., :3].astype(int)


def lit(picture):
    return picture.max(axis=2) > 0


class Splats(TestCase):
    def setUp(self):
        super().setUp()
        simple.ResetSession()
        load_plugin()
        # A view that is there at the end is an error of X.
        self.addCleanup(lambda: [simple.Delete(view) for view in simple.GetViews()])

    def cloud(self, points=3000):
        run_program("generate", "sphere", "-n", points, "-o", self.path("in.ply"))
        return simple.PointHapticsReader(registrationName="cloud", FileNames=[self.path("in.ply")])

    def show(self, source, representation=SPLATS):
        view = new_view()
        shown = simple.Show(source, view)
        shown.SetRepresentationType(representation)
        shown.ColorArrayName = [None, ""]
        view.ResetCamera()
        return view, shown

    def test_points_close_to_a_surface_that_is_lit(self):
        view, shown = self.show(self.cloud())
        splats = pixels(view)
        y, x = np.mgrid[:SIZE, :SIZE] - 0.5 * (SIZE - 1)
        disc = np.hypot(x, y) < 0.9 * np.hypot(x, y)[lit(splats)].max()
        self.assertGreater(lit(splats)[disc].mean(), 0.99)
        self.assertGreater(splats[lit(splats)].std(axis=0).max(), 5, "light shows the shape")
        shown.SetRepresentationType("Points")
        points = pixels(view)
        self.assertGreater(lit(splats).sum(), 2 * lit(points).sum())
        shown.SetRepresentationType(SPLATS)
        self.assertTrue((pixels(view) == splats).all())

    def test_scale_light_and_opacity(self):
        view, shown = self.show(self.cloud(300))
        before = pixels(view)
        shown.SplatScale = 0.3
        self.assertLess(lit(pixels(view)).sum(), 0.7 * lit(before).sum())
        shown.SplatScale, shown.SplatLight = 1, 0
        plain = pixels(view)
        middle = plain[SIZE // 2 - 20 : SIZE // 2 + 20, SIZE // 2 - 20 : SIZE // 2 + 20]
        self.assertEqual(len(np.unique(middle[lit(middle)], axis=0)), 1)
        shown.Opacity = 0.1
        self.assertLess(pixels(view).max(), plain.max())

    def test_colors_of_an_array(self):
        source = simple.Calculator(Input=self.cloud(), Function="coordsX", ResultArrayName="side")
        view, shown = self.show(source)
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 1], [0, 0, 0], [0, 1, 0]
        view.ResetCamera()
        shown.SplatLight = 0
        simple.ColorBy(shown, ("POINTS", "side"))
        shown.RescaleTransferFunctionToDataRange(False, True)
        simple.GetColorTransferFunction("side").ApplyPreset("Cool to Warm", True)
        picture = pixels(view)
        left, right = picture[SIZE // 2, SIZE // 4], picture[SIZE // 2, 3 * SIZE // 4]
        self.assertGreater(left[2], left[0])
        self.assertGreater(right[0], right[2])

    def test_grids_blocks_and_invalid_points(self):
        cloud = self.cloud()
        alone = pixels(self.show(cloud)[0])
        grid = simple.AppendDatasets(Input=[cloud])
        beside = simple.Transform(Input=cloud)
        beside.Transform.Translate = [0.2, 0, 0]
        self.assertGreater(lit(pixels(self.show(grid)[0])).sum(), 0.95 * lit(alone).sum())
        blocks = lit(pixels(self.show(simple.GroupDatasets(Input=[cloud, beside]))[0])).sum(axis=0)
        self.assertGreater(blocks[: SIZE // 2].max(), 0.1 * SIZE)
        self.assertGreater(blocks[SIZE // 2 :].max(), 0.1 * SIZE)
        with open(self.path("some.csv"), "w") as file:
            file.write("x,y,z\n" + "".join(f"{i % 30},{i // 30},{i % 2 / 10}\nnan,1,inf\n" for i in range(900)))
        some = simple.PointHapticsReader(FileNames=[self.path("some.csv")])
        for source in (some, simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script="")):
            pixels(self.show(source)[0])

    def test_new_points_are_measured(self):
        source = self.cloud(300)
        view, _ = self.show(source)
        few = pixels(view)
        run_program("generate", "sphere", "-n", 3000, "-o", self.path("more.ply"))
        source.FileNames = [self.path("more.ply")]
        self.assertFalse((pixels(view) == few).all())

    def test_selected_points_are_those_of_the_input(self):
        cloud = self.cloud()
        part = [SIZE // 3, SIZE // 3, 2 * SIZE // 3, 2 * SIZE // 3]
        # Of two blocks in one place, which is selected depends on which is drawn first, and ParaView's order varies.
        beside = simple.Transform(Input=cloud)
        beside.Transform.Translate = [0.05, 0, 0]
        for source in (cloud, simple.GroupDatasets(Input=[cloud, beside])):
            view, shown = self.show(source)
            found = {}
            for representation in ("Points", SPLATS):
                shown.SetRepresentationType(representation)
                before = pixels(view)
                simple.SelectSurfacePoints(Rectangle=part, View=view)
                ids = source.GetSelectionInput(0).Input[0].IDs
                width = 2 if source is cloud else 3  # process and point, and the block before them
                found[representation] = {tuple(ids[i : i + width]) for i in range(0, len(ids), width)}
                self.assertFalse((pixels(view) == before).all(), "they are marked")
                simple.ClearSelection(source)
                self.assertTrue((pixels(view) == before).all())
            # Splats hide the far side, which is seen between points, and are wider at the rim.
            self.assertLess(len(found[SPLATS]), 0.8 * len(found["Points"]))
            self.assertGreater(len(found[SPLATS] & found["Points"]), 0.5 * len(found[SPLATS]))
            simple.Hide(source, view)

    def test_a_saved_state_shows_the_same_picture(self):
        view, shown = self.show(self.cloud())
        shown.SplatScale = 1.5
        expected = pixels(view)
        simple.SaveState(self.path("state.pvsm"))
        script = smstate.get_state()
        for load in (lambda: simple.LoadState(self.path("state.pvsm")), lambda: exec(script, {})):
            simple.ResetSession()
            load_plugin()
            load()
            (view,) = simple.GetViews(viewtype="RenderView")
            (source,) = simple.GetSources().values()
            shown = simple.GetRepresentation(source, view)
            self.assertEqual((shown.Representation, shown.SplatScale), (SPLATS, 1.5))
            self.assertTrue((pixels(view) == expected).all())

    def test_the_document_runs(self):
        """The Python of ParaView.md, with the plugin where it is."""
        text = (pathlib.Path(__file__).parents[2] / "Documentation/ParaView.md").read_text()
        block = text.split("```python\n")[1].split("```")[0]
        block = re.sub(r'LoadPlugin\(".*?"', f'LoadPlugin("{os.environ["POINTHAPTICS_PLUGIN"]}"', block)
        run_program("generate", "idol", "-n", 20000, "-o", self.path("scan.laz"))
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        names = {}
        exec(block, names)
        self.assertIn("PCD", run_program("info", "radii.pcd"))
        self.assertEqual(simple.GetRepresentation(names["cloud"]).Representation, SPLATS)


if __name__ == "__main__":
    unittest.main()
