/// @file
/// Layout of VTK's XML format for poly data: arrays lie behind the XML as they are in memory.
#pragma once

#include "vtkAbstractArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

class vtkCellArray;
class vtkFieldData;
class vtkPolyData;

namespace pointhaptics::io
{

/// One array in the file: a number of 8 bytes that counts its bytes, and these.
struct VtpBlock
{
  std::uint64_t place = 0; ///< of the number
  std::uint64_t bytes = 0;
  std::uint64_t tuple = 0;  ///< bytes for each point; 0: the array is not of points
  std::string_view content; ///< all bytes, or of an array of points those of the cloud
};

/// The file of @p cloud, which may be a part of the points: text around blocks.
class VtpFile
{
public:
  static constexpr std::uint64_t kNumber = sizeof(std::uint64_t);

  /// @p points of the file; with @p isShared @p cloud has a part of them, each with a vertex.
  VtpFile(vtkPolyData* cloud, vtkIdType points, bool isShared = false);

  std::string head;
  std::vector<VtpBlock> blocks;
  const std::string tail = "\n</AppendedData>\n</VTKFile>\n";
  std::vector<std::string> leftOut; ///< names of arrays that hold neither numbers nor texts

  std::uint64_t tailAt() const { return end_; }

private:
  void addFields(const char* element, vtkFieldData* data, bool areOfPoints);
  void addCells(const char* element, vtkCellArray* cells, bool areOfPoints);
  void addArray(vtkAbstractArray* array, const std::string& name, vtkIdType firstTuple, bool isOfPoints,
    bool saysTuples = false);

  const vtkIdType points_;
  std::uint64_t end_ = 0; ///< of the blocks so far
  std::vector<vtkSmartPointer<vtkAbstractArray>> copies_;
  std::deque<std::string> texts_;
};

} // namespace pointhaptics::io
