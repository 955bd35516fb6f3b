/// @file
/// Clouds in several VTP files and a list of these (PVTP).
#pragma once

#include "IO/Bytes/XmlTree.h"
#include "ReadTask.h"

#include "vtkSmartPointer.h"

#include <string>
#include <string_view>

class vtkPointSet;
class vtkPolyData;

namespace pointhaptics::io
{

/// Points and arrays of the list in task.bytes, all of which are there, with the content @p root: those of
/// all pieces in the order of the list, or this rank's. Each piece must be a VTP file below the folder of the
/// list, so that no list opens what does not belong to it, and none leads to itself. @throws FileProblem,
/// with the piece.
void readVtkPieces(ReadTask& task, const XmlElement& root, vtkPolyData* cloud);

/// The points and arrays of one VTP or VTU file, @p bytes with the content @p root, which lie at @p path.
/// Progress goes from @p begin to @p end of the parsing. @throws FileProblem also where there are no points.
vtkSmartPointer<vtkPointSet> readVtkXmlFile(const ReadTask& task, const std::string& path,
  std::string_view bytes, const XmlElement& root, double begin, double end);

} // namespace pointhaptics::io
