/// @file
/// Plain records of numbers: what robots and learning programs store.
#pragma once

class vtkPolyData;

namespace pointhaptics::io
{

struct FormatStart;
struct ReadTask;

using Look = bool(const FormatStart&);
/// Float32 x y z intensity (KITTI), and the same with a ring (nuScenes): by size and values, as there is no
/// mark.
Look looksLikeKitti, looksLikeNuScenes;
/// NumPy's .npy.
Look looksLikeNumpy;
/// Gaussian splats of 32 bytes: place, size, colour, rotation.
Look looksLikeSplat;

/// Gaussian splats are a cloud of ellipsoids: of one with the arrays "f_dc" and "opacity", adds their colours
/// as "RGB" and leaves out those that can hardly be seen, with a note. Collective where ranks read the file.
void finishSplats(ReadTask& task, vtkPolyData* cloud);

} // namespace pointhaptics::io
