/// @file
/// Fills the columns of a cloud with the records of E57 scans.
#pragma once

#include "IO/Columns/CloudColumns.h"
#include "IO/E57/E57Columns.h"
#include "IO/E57/E57Packets.h"
#include "IO/E57/E57Scan.h"

#include <array>
#include <vector>

namespace pointhaptics::io
{

/// Decodes block after block: a block's values stay in the cache while they are unpacked, placed and turned.
/// Different blocks may be decoded in different threads at once.
class E57Decoder
{
public:
  static constexpr vtkIdType kBlockRows = 4096;

  /// All arguments must outlive it; @p packets has one for each scan. @p first: the row of the cloud where
  /// the scan begins. @p applyPose: coordinates of the file, not of the scanner.
  E57Decoder(const E57Columns& plan, const CloudColumns& columns, const E57Scan& scan, std::size_t scanNumber,
    const E57Packets& packets, vtkIdType first, bool applyPose);

  /// Decodes block @p block of blocks(). Nothing throws.
  void decode(vtkIdType block) const;
  vtkIdType blocks() const { return (rows_ + kBlockRows - 1) / kBlockRows; }

private:
  struct Block;
  using Values = double[kBlockRows];
  void turn(const std::array<double, 3>& shift, vtkIdType count, Values* vectors) const;
  ColumnView target(std::size_t column, int component, const Block& block) const;
  void decodeField(std::size_t field, const Block& block) const;
  void fillMissing(const Block& block) const;
  void placePoints(const Block& block) const;
  void turnNormals(const Block& block) const;
  void makeColors(const Block& block) const;
  std::size_t columnOf(const char* fieldName) const;

  const E57Columns& plan_;
  const CloudColumns& columns_;
  const E57Scan& scan_;
  const std::size_t scanNumber_;
  const E57Packets& packets_;
  const vtkIdType first_;
  const vtkIdType rows_;
  const bool isMoved_; ///< the pose changes something
  const bool isSpherical_;
  std::size_t state_;        ///< column of the invalid state; npos where there is none
  std::size_t spherical_[3]; ///< columns of range, azimuth, elevation; npos
  std::size_t normals_[3];   ///< columns of the normal; npos
  std::vector<std::size_t> missing_;
  double matrix_[3][3];
  double colorLeast_[3];
  double colorFactor_[3];
  bool colorIsInteger_ = false;
};

} // namespace pointhaptics::io
