/// @file
/// From the properties of a resampler to Core's values, and what to say where they are of no use.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/Status.h"

#include <string>

class vtkAbstractTransform;

namespace pointhaptics
{

/// Null gives the identity. @return empty, or why @p transform is of no use.
std::string readTransform(vtkAbstractTransform* transform, AffineTransform& result);
/// Why makeLattice() gave @p status for @p settings.
std::string latticeProblem(const LatticeSettings& settings, Status status);

} // namespace pointhaptics
