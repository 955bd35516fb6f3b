"""Draws the picture of Documentation/ParaView.md, by the plugin's filters in ParaView, and compares it.

pvpython PictureTest.py PICTURE.png [--record]: --record writes PICTURE.png instead of comparing with it. A picture that differs
is left in the working folder, ParaView.png.
"""

import os
import sys

import numpy as np
from paraview import simple
from support import load_plugin, run_program
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SIZE = [900, 600]
# Fraction of pixels that may differ by more than 16 of 255: other versions of Mesa draw edges otherwise.
MOST_DIFFERING = 0.01


def draw(path, voxel, name):
    """The statue's proxy radii, as large and coloured as they are."""
    means = simple.VoxelMeanResampler(Input=simple.PointHapticsReader(FileNames=[path]), VoxelSize=voxel)
    radii = simple.KernelBandwidth(Input=means)
    view = simple.CreateRenderView(ViewSize=SIZE)
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    shown = simple.Show(radii, view)
    shown.Representation = "Point Gaussian"
    shown.ScaleByArray = 1
    shown.SetScaleArray = ["POINTS", "ProxyRadius"]
    shown.UseScaleFunction = 0
    shown.GaussianRadius = 1.3
    simple.ColorBy(shown, ("POINTS", "ProxyRadius"))
    colors = simple.GetColorTransferFunction("ProxyRadius")
    shown.RescaleTransferFunctionToDataRange(False, True)
    bar = simple.GetScalarBar(colors, view)
    bar.Title, bar.ComponentTitle = "Proxy radius (m)", ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    shown.SetScalarBarVisibility(view, True)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.22, -0.05, 0.08], [0, 0, 0], [0, 0, 1]
    view.ResetCamera()
    view.GetActiveCamera().Dolly(1.4)
    simple.Render(view)
    simple.SaveScreenshot(name, view, ImageResolution=SIZE)
    for proxy in (view, radii, means):
        simple.Delete(proxy)
    return name


def pixels(name):
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    image = reader.GetOutput()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(*image.GetDimensions()[1::-1], -1)[..., :3].astype(int)


def differing(left, right):
    """The part of the pixels that differ visibly."""
    left, right = pixels(left), pixels(right)
    return 1.0 if left.shape != right.shape else np.mean(np.abs(left - right).max(axis=2) > 16)


def main():
    if not os.environ.get("DISPLAY"):
        print("skipped: no display")
        sys.exit(77)
    load_plugin()
    picture = sys.argv[1]
    run_program("generate", "idol", "-n", 100000, "-o", "statue.ply")
    if "--record" in sys.argv[2:]:
        draw("statue.ply", 0.0015, picture)
        return
    found = differing(draw("statue.ply", 0.0015, "ParaView.png"), picture)
    if found > MOST_DIFFERING:
        sys.exit(f"{100 * found:.2f} % of the pixels of {os.path.abspath('ParaView.png')} differ from {picture}")
    # The comparison sees another voxel size.
    wrong = differing(draw("statue.ply", 0.0018, "ParaViewWrong.png"), picture)
    if wrong < 3 * MOST_DIFFERING:
        sys.exit(f"a picture of other voxels differs in {100 * wrong:.2f} % of the pixels only")
    print(f"{100 * found:.3f} % of the pixels differ, with other voxels {100 * wrong:.1f} %")
    os.remove("ParaView.png")
    os.remove("ParaViewWrong.png")


if __name__ == "__main__":
    main()
