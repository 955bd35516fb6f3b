/// @file
/// A recorded path of the hand: rows of time and position, read from and written to HIP.csv; read from a
/// table of felt forces, too.
#pragma once

#include "Core/Base/Status.h"
#include "Core/Base/Vector3.h"
#include "Haptics/HapticPort.h"

#include <string>
#include <vector>

namespace pointhaptics
{

/// Place of the HIP at a time.
struct HipPathPoint
{
  double timeSeconds = 0.0;
  Vec3 position; ///< Metres, frame of the transformed cloud.
  /// The hand was found anew here (HandState::isNew): nothing between the point before and this one is
  /// touched.
  bool isNew = false;
};

/// Times strictly ascending, all numbers finite. Plain data; position() may run in any number of threads,
/// each with its own row.
struct HipPath
{
  std::vector<HipPathPoint> points;

  /// Why nobody can follow it, with row, value and cure: it has no point, a number is not finite, or times do
  /// not ascend. Empty: nothing is wrong.
  std::string problem() const;

  double duration() const
  {
    return points.empty() ? 0.0 : points.back().timeSeconds - points.front().timeSeconds;
  }
  /// Interpolates linearly between two points, and holds the position before a new one until its time; before
  /// the first and after the last it holds their positions.
  /// @pre not empty. @p row becomes that of the last point not later.
  Vec3 position(double timeSeconds, std::size_t& row) const noexcept;
  /// As position(); new where a new point lies behind @p row, which is that of the last call, first 0.
  HandState hand(double timeSeconds, std::size_t& row) const noexcept;
};

/// Reads the columns t, x, y and z that the header line names, or t, hip_x, hip_y and hip_z as the tables of
/// felt forces have them: seconds and metres, one row a line, decimal point, spaces about numbers and CRLF
/// line ends allowed, blank lines at the end only. Lines that begin with # are remarks; those of a recording
/// that say `new-hand` or `begins` make the next row new. Other columns are ignored. On an error @p message
/// says file, line, value and cure, and @p path is empty: FileNotReadable, FileMalformed (no row among
/// others).
Status readHipPath(const std::string& fileName, HipPath& path, std::string& message);

} // namespace pointhaptics
