/// @file
/// The coordinate system of a LAS file.
#pragma once

#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Takes the records of the user LASF_Projection; well-known text is preferred to GeoTIFF keys.
class LasCoordinateSystem
{
public:
  /// @p id 2112: well-known text; 34735: GeoTIFF keys. Others are ignored, and so is what is damaged.
  void addRecord(int id, std::string_view content);
  /// Well-known text as the file has it, or "EPSG:26917"; empty when the file names none.
  const std::string& name() const { return text_.empty() ? code_ : text_; }
  /// The unit of a projected system ("metre", "US survey foot"), empty when the file names none.
  std::string lengthUnit() const;

private:
  void addKeys(std::string_view content);

  std::string text_;
  std::string code_;
  std::string unit_;
};

} // namespace pointhaptics::io
