/// @file
/// Tells a room from an object by where its points lie.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Base/Vector3.h"
#include "Core/Neighbors/LocalShape.h"

namespace pointhaptics
{

/// True if most points lie on the floor, the walls and the ceiling of a box with a vertical axis along @p up,
/// and some, which nobody sees from outside, stand within it.
bool isFurnishedBox(const PointView& cloud, const LocalShape& shape, const Vec3& up);

} // namespace pointhaptics
