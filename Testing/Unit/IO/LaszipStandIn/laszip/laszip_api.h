/// @file
/// The part of LASzip's C interface that PointHaptics calls, for LaszipStandIn.cxx: the same names and types,
/// so that the bridge compiles against it unchanged. A program that reads real LAZ files is built with
/// LASzip's own header instead.
#pragma once

#include <cstdint>

extern "C"
{
  using laszip_POINTER = void*;
  using laszip_BOOL = int;
  using laszip_I32 = std::int32_t;
  using laszip_CHAR = char;

  struct laszip_point_struct
  {
    std::int32_t X, Y, Z;
    std::uint16_t intensity;
    // Point formats 0 to 5; the two flags in the middle serve all formats.
    std::uint8_t return_number : 3, number_of_returns : 3, scan_direction_flag : 1, edge_of_flight_line : 1;
    std::uint8_t classification : 5, synthetic_flag : 1, keypoint_flag : 1, withheld_flag : 1;
    std::int8_t scan_angle_rank;
    std::uint8_t user_data;
    std::uint16_t point_source_ID;
    // Point formats 6 to 10.
    std::int16_t extended_scan_angle;
    std::uint8_t extended_point_type : 2, extended_scanner_channel : 2, extended_classification_flags : 4;
    std::uint8_t extended_classification;
    std::uint8_t extended_return_number : 4, extended_number_of_returns : 4;
    double gps_time;
    std::uint16_t rgb[4];
    std::int32_t num_extra_bytes;
    std::uint8_t* extra_bytes;
  };

  // 0 is success; else laszip_get_error tells more.
  laszip_I32 laszip_create(laszip_POINTER* pointer);
  laszip_I32 laszip_destroy(laszip_POINTER pointer);
  laszip_I32 laszip_get_error(laszip_POINTER pointer, laszip_CHAR** error);
  laszip_I32 laszip_open_reader(
    laszip_POINTER pointer, const laszip_CHAR* file_name, laszip_BOOL* is_compressed);
  laszip_I32 laszip_get_point_pointer(laszip_POINTER pointer, laszip_point_struct** point);
  laszip_I32 laszip_read_point(laszip_POINTER pointer);
}
