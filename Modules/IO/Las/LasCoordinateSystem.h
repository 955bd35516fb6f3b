/// @file
/// The coordinate system of a LAS file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

class vtkFieldData;

namespace pointhaptics::io
{

constexpr std::uint16_t kLasWellKnownTextBit = 16; ///< of the header's global encoding

/// Takes the records of the user LASF_Projection; well-known text is preferred to GeoTIFF keys.
class LasCoordinateSystem
{
public:
  /// @p id 2112: well-known text; 34735: GeoTIFF keys. Others are ignored, and so is what is damaged.
  void addRecord(int id, std::string_view content);
  /// Well-known text as the file has it, or "EPSG:26917"; empty when the file names none.
  std::string name() const;
  /// The unit of a projected system ("metre", "US survey foot"), "degree" of a geographic one, empty when the
  /// file names none.
  std::string lengthUnit() const;
  /// The unit of heights of a compound system; empty when the file names none.
  std::string heightUnit() const;

private:
  void addKeys(std::string_view content);

  /// The value of a GeoTIFF key; 0: the file has none.
  int keyOf(int key) const;

  std::string text_;
  std::map<int, int> keys_;
};

/// True if @p unit is one of the names of a metre, as files write them.
bool isMetre(const std::string& unit);

/// True if lengths in @p unit and @p other, both known, differ by more than feet do; degrees go with metres.
bool isOtherUnit(const std::string& unit, const std::string& other);

/// True if that record says the field data's LengthUnit.
bool lasSaysUnit(vtkFieldData* fieldData);

/// The record that says what the field data's CoordinateSystem and LengthUnit say, empty when they say
/// nothing; well-known text, which has its own unit, sets its bit in @p encoding.
std::string lasCoordinateSystemRecord(vtkFieldData* fieldData, std::uint16_t& encoding);

} // namespace pointhaptics::io
