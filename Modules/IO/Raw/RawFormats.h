/// @file
/// Plain records of numbers: what robots and learning programs store.
#pragma once

class vtkPolyData;

namespace pointhaptics::io
{

struct ReadTask;

/// Gaussian splats are a cloud of ellipsoids: of one with the arrays "f_dc" and "opacity", adds their colours
/// as "RGB" and leaves out those that can hardly be seen, with a note. Collective where ranks read the file.
void finishSplats(ReadTask& task, vtkPolyData* cloud);

} // namespace pointhaptics::io
