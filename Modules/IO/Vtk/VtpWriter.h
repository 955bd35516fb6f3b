/// @file
/// Writes VTK's XML format for poly data, by VTK.
#pragma once

#include <string>

class vtkPointSet;
class vtkPolyData;

namespace pointhaptics::io
{

struct WriteTask;

/// Writes points, arrays and cells; a cloud without cells gets a vertex for each point. @throws FileProblem,
/// StoppedOnRequest.
void writeVtp(WriteTask& task);

/// Bytes of the file for a small cloud.
std::string vtpText(vtkPolyData* cloud);

} // namespace pointhaptics::io
