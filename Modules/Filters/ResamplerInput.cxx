#include "ResamplerInput.h"

#include "PolyDataAccess.h"

#include "vtkAbstractTransform.h"
#include "vtkHomogeneousTransform.h"
#include "vtkMatrix4x4.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace pointhaptics
{
namespace
{

std::string latticeText(const LatticeSettings& lattice)
{
  std::ostringstream text;
  if (lattice.voxelSize != 0.0)
  {
    text << "Lattice of voxel size " << lattice.voxelSize;
  }
  else
  {
    const std::array<std::int64_t, 3>& n = lattice.dimensions;
    text << "Lattice of " << n[0] << " x " << n[1] << " x " << n[2] << " voxels";
  }
  return text.str();
}

/// Such a matrix is often not affine either: NaN times 0 is NaN.
bool holdsNonFinite(vtkAbstractTransform* transform)
{
  auto* homogeneous = vtkHomogeneousTransform::SafeDownCast(transform);
  const double* elements = homogeneous ? homogeneous->GetMatrix()->GetData() : nullptr;
  return elements && !std::all_of(elements, elements + 16, [](double e) { return std::isfinite(e); });
}

}

std::string readTransform(vtkAbstractTransform* transform, AffineTransform& result)
{
  const auto problem = [](Status status) { return std::string("SetTransform: ") + message(status) + "."; };
  if (!affineFromTransform(transform, result))
  {
    return holdsNonFinite(transform) ? problem(Status::NonFiniteTransform)
                                     : std::string("SetTransform: ") + transform->GetClassName() +
        " is not affine; use a vtkTransform or vtkMatrixToLinearTransform whose matrix has the last row 0, "
        "0, "
        "0, 1.";
  }
  const Status status = result.check();
  return status == Status::Ok ? std::string() : problem(status);
}

std::string latticeProblem(const LatticeSettings& settings, Status status)
{
  return latticeText(settings) + ": " + message(status) + ".";
}

} // namespace pointhaptics
