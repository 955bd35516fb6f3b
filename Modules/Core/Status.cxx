#include "Core/Status.h"

namespace pointhaptics
{

const char* sentence(Status status) noexcept
{
  switch (status)
  {
    case Status::Ok:
      return "no error";
    case Status::Empty:
      return "no valid point is left: check the workspace, the transform and the file";
    case Status::SingularTransform:
      return "the transform is singular: use scales other than 0 and a matrix that can be inverted";
    case Status::NonFiniteTransform:
      return "the transform holds NaN or infinity: use finite numbers";
    case Status::InvalidWorkspace:
      return "the workspace bounds must be finite with maximum above minimum on every axis";
    case Status::InvalidDimensions:
      return "the lattice dimensions must be between 1 and 2097152 on every axis";
    case Status::InvalidVoxelSize:
      return "the voxel size must be finite and above 0";
    case Status::LatticeNotAddressable:
      return "the lattice would have more than 2097152 voxels on an axis: use a larger voxel size or a "
             "smaller workspace";
    case Status::InvalidNeighborhood:
      return "the neighbourhood needs at least 1 neighbour, or a radius above 0";
    case Status::InvalidRadiusBounds:
      return "the radius bounds must be finite, not negative, and r1 not above r2";
    case Status::DegenerateSample:
      return "the sample has no spread: fewer than two distinct values";
    case Status::EquationUnsolved:
      return "the equation of the rule has no solution in double numbers: scale the values, or use another "
             "rule";
    case Status::InvalidParameter:
      return "a parameter is outside its documented range";
    case Status::Aborted:
      return "the work was ended before it was done, as asked";
    case Status::DeviceNotOpen:
      return "the device is not open: call open() first";
    case Status::EndOfPath:
      return "the path has come to its end";
    case Status::FileNotReadable:
      return "the file cannot be opened for reading: check its name and permissions";
    case Status::FileMalformed:
      return "the file's content does not fit its format";
    case Status::FileNotWritable:
      return "the file cannot be written: check the folder, its permissions and the free space";
  }
  return "unknown status";
}

} // namespace pointhaptics
