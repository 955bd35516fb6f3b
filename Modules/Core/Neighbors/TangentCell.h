/// @file
/// Cell of a surface about one of its points: the part that is nearer to it than to any other point.
#pragma once

#include "Core/Base/Vector3.h"

namespace pointhaptics
{

/// The part of a plane through the origin that is nearer to it than to the places added: a cell of the
/// Voronoi diagram. A disc as large as the farthest corner of the cell, and one such about each other place,
/// leave no gap between them.
class TangentCell
{
public:
  /// @param normal unit vector. @param largest corners so far away, or farther, belong to the edge of the
  /// cloud or to a hole in it.
  TangentCell(const Vec3& normal, double largest);

  /// Cuts away what is nearer to @p place. False: this and all that are farther away cut nothing any more.
  bool add(const Vec3& place);

  /// Gets the corner that is farthest away. @return its distance.
  double farthestCorner(Vec3& place) const;

  /// Distance of the farthest corner; 0: one is as far away as the largest, or farther, so the cell is open.
  double reach() const;

  /// Whether a side of the cell, or a corner, is half way to @p place, or nearly so: points of a square grid
  /// touch at corners alone.
  bool touches(const Vec3& place) const;

private:
  static constexpr int kMostCorners = 24;
  struct Corner
  {
    double x;
    double y;
  };

  Vec3 u_;
  Vec3 v_;
  double largest_;
  double farthest2_; ///< Largest squared distance of a corner.
  int count_ = 4;
  Corner corners_[kMostCorners];
};

} // namespace pointhaptics
