/// @file
/// The readers behind vtkPointCloudReader, one per format. Each fills an empty vtkPolyData with points,
/// arrays and vertices, names the format in task.format, and throws FileProblem, StoppedOnRequest or
/// std::bad_alloc. Sizes that a file claims are checked against its length before anything is allocated.
#pragma once

#include "ReadTask.h"

class vtkPolyData;

namespace pointhaptics::io
{

/// ASCII and binary PLY: every scalar property of the element vertex; lists and other elements are skipped.
void readPly(ReadTask& task, vtkPolyData* cloud);

/// ASCII, binary and binary_compressed PCD.
void readPcd(ReadTask& task, vtkPolyData* cloud);

/// VTK's XML PolyData and UnstructuredGrid: points, point data and field data; cells are dropped.
void readVtkXml(ReadTask& task, vtkPolyData* cloud);

/// VTK's legacy format, ASCII and binary: POINTS and POINT_DATA of grids with a list of points.
void readVtkLegacy(ReadTask& task, vtkPolyData* cloud);

/// OFF, NOFF, COFF, CNOFF as text: vertices with normals and colours; faces are dropped.
void readOff(ReadTask& task, vtkPolyData* cloud);

/// STL, ASCII and binary: each distinct vertex once, as float; normals of faces are dropped.
void readStl(ReadTask& task, vtkPolyData* cloud);

/// Wavefront OBJ: vertices, their colours, and normals when there is one per vertex.
void readObj(ReadTask& task, vtkPolyData* cloud);

/// LAS 1.0 to 1.4, point formats 0 to 10, uncompressed, LAZ and COPC.
void readLas(ReadTask& task, vtkPolyData* cloud);

/// E57 1.0: all scans of the file as one cloud, their poses applied unless the task says otherwise.
void readE57(ReadTask& task, vtkPolyData* cloud);

/// Columns of numbers (XYZ, TXT, CSV, PTS): separator and header are found by looking.
void readText(ReadTask& task, vtkPolyData* cloud);

} // namespace pointhaptics::io
