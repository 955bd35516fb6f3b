/// @file
/// Records and extra bytes of a LAS file, as the file had them that the cloud came from.
#pragma once

#include "IO/Columns/OutputColumns.h"
#include "IO/Las/LasHeader.h"

#include <cstdint>
#include <string>

class vtkFieldData;

namespace pointhaptics::io
{

/// How the points are written.
struct LasPoints
{
  std::string descriptors; ///< Descriptors of the extra bytes, kLasExtraDescriptor each.
  std::string packing;     ///< The record of LAZ; empty: they are not packed.
  bool isExtended = false; ///< Point format 6 and more.
};

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

  LasDescription(
    const LasOrigin& origin, vtkFieldData* fieldData, const LasPoints& points, WriterNotes& notes);

private:
  void add(const std::string& record)
  {
    bytes += record;
    count += record.empty() ? 0 : 1;
  }
  void keep(const LasRecord& record, bool isPacked, WriterNotes& notes);
};

/// Fills @p stored with the values of @p array as the file had them. @return whether each comes back so: of
/// its type, with its scale, and what it has for none.
bool storeAsBefore(const OutputArray& array, const LasExtraField& field, OutputArray& stored);

} // namespace pointhaptics::io
