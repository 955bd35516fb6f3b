/// @file
/// From LAS's point records to the arrays of a cloud.
#pragma once

#include "IO/Columns/CloudColumns.h"
#include "IO/Las/LasHeader.h"
#include "SharedReading.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <atomic>
#include <vector>

class vtkPolyData;

namespace pointhaptics::io
{

/// Records that lie one behind the other.
struct LasBlock
{
  const char* first = nullptr;
  vtkIdType row = 0; ///< of the first one in the cloud
  vtkIdType count = 0;
};

/// An array for bits that most files leave at zero. It becomes part of the cloud where a bit is set; until
/// then its memory costs nothing.
struct RareBits
{
  vtkSmartPointer<vtkUnsignedCharArray> array; ///< Null: the files have no such field.
  std::atomic<bool> isSet{ false };

  /// Values of the records of @p block, @p stride bytes each, at @p place. Blocks may come from several
  /// threads at once.
  void fill(const LasBlock& block, std::size_t stride, const LasPlace& place);
};

/// Owns the arrays and fills them block by block; one object per file.
class LasRecords
{
public:
  /// @p header must outlive this object. With @p onlyPositions there is no array beside the points.
  LasRecords(const LasHeader& header, bool onlyPositions);
  /// Blocks of different rows may be filled by several threads at once.
  void fill(const LasBlock& block);
  /// Gives the arrays to @p cloud when all blocks are filled that are there. Collective where ranks read a
  /// file together: the same arrays on each.
  void moveTo(vtkPolyData* cloud, ReadTask& task);

private:
  /// The columns, and which of them holds what.
  struct Columns
  {
    std::vector<Column> all{ { "x", VTK_DOUBLE }, { "y", VTK_DOUBLE }, { "z", VTK_DOUBLE } };
    std::array<std::size_t, kNumberOfLasFields> fields{};
    std::size_t firstExtra = 0;

    Columns(const LasHeader& header, bool onlyPositions);
  };

  template <typename From, typename To, typename Change>
  void fillColumn(
    const LasBlock& block, std::size_t column, std::size_t offset, Change change, int component = 0) const;
  void copyColumn(
    const LasBlock& block, std::size_t column, std::size_t offset, int type, int component) const;
  void fillPosition(const LasBlock& block) const;
  void fillField(const LasBlock& block, std::size_t field);
  void fillExtra(const LasBlock& block) const;

  const LasHeader& header_;
  const bool onlyPositions_;
  const Columns names_;
  vtkIdType rows_;
  CloudColumns columns_;
  std::array<RareBits, kNumberOfLasFields> rare_; ///< of those fields that are
};

} // namespace pointhaptics::io
