"""Writes the piece of each rank: mpirun -np N pvbatch --sym PieceOfRank.py FOLDER CLOUD VOXEL, started by RanksTest.py.

Rank R leaves FOLDER/NAME.R.npz: points and point arrays of its piece, for each step NAME of a pipeline.
"""

import os
import sys

import numpy as np
from paraview import simple
from support import arrays_of, load_plugin
from vtkmodules.vtkParallelCore import vtkMultiProcessController

load_plugin()
folder, path, voxel = sys.argv[1:4]
controller = vtkMultiProcessController.GetGlobalController()


def save(name, proxy, **more):
    proxy.UpdatePipeline()
    piece = arrays_of(proxy.GetClientSideObject().GetOutputDataObject(0))
    np.savez(os.path.join(folder, f"{name}.{controller.GetLocalProcessId()}.npz"), **piece, **more)
    return proxy


def resampled(cloud):
    return simple.VoxelMeanResampler(Input=cloud, VoxelSize=float(voxel), ComputeCovariance=1)


cloud = simple.PointHapticsReader(FileNames=[path])
cloud.UpdatePipeline()
cloud.UpdatePropertyInformation()
save("cloud", cloud, bytes_read=[cloud.GetPropertyValue("NumberOfBytesRead")])
save("radii", simple.KernelBandwidth(Input=save("means", resampled(cloud)), ComputeDensity=1))
# ParaView's own reader of .ply knows no pieces: the first rank has all points, the others not even the arrays.
if path.endswith(".ply"):
    save("means_of_first", resampled(save("first", simple.PLYReader(FileNames=[path]))))
