/// @file
/// Records and extra bytes of a LAS file, as the file had them that the cloud came from.
#pragma once

#include "IO/Las/LasHeader.h"
#include "IO/WriteTask.h"

#include <cstdint>
#include <string>

class vtkFieldData;

namespace pointhaptics::io
{

/// The records of the file that a cloud came from; those of coordinate system and extra bytes as they are
/// now.
struct LasDescription
{
  std::string bytes; ///< Before the points.
  std::uint32_t count = 0;
  std::string far; ///< Behind them; none where they are packed, as their place is not known before.
  std::uint32_t farCount = 0;
  std::uint16_t encoding = 0; ///< The global one.
  bool isOf14 = false;

  /// @p descriptors: of the extra bytes, kLasExtraDescriptor each. @p packing: the record of LAZ; empty: the
  /// points are not packed. @p isExtended: point format 6 and more.
  LasDescription(const LasOrigin& origin, vtkFieldData* fieldData, const std::string& descriptors,
    const std::string& packing, bool isExtended, std::vector<std::string>& notes);

private:
  void add(const std::string& record)
  {
    bytes += record;
    count += record.empty() ? 0 : 1;
  }
  void keep(const LasRecord& record, bool isPacked, std::vector<std::string>& notes);
};

/// Fills @p stored with the values of @p array as the file had them. @return whether each comes back so: of
/// its type, with its scale, and what it has for none.
bool storeAsBefore(const OutputArray& array, const LasExtraField& field, OutputArray& stored);

/// The variable length record, with its header, that a LAZ file of this point format and record length needs.
std::string lazDescription(int pointFormat, std::size_t recordLength);

/// Writes @p rows records of @p recordLength bytes in chunks of 50,000 behind the offset of their table, and
/// the table behind them, with progress from @p begin to 1. @p pointsOffset: where they begin in the file.
/// Costs the size of the compressed points in memory: a pipe, too, gets the offset of the table before the
/// points.
void writeLazRecords(const std::vector<RecordField>& fields, int pointFormat, std::size_t recordLength,
  std::size_t pointsOffset, vtkIdType rows, WriteTask& task, double begin);

} // namespace pointhaptics::io
