#include "Core/Base/Status.h"

namespace pointhaptics
{

const char* message(Status status) noexcept
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
      return "the sample has no spread: give at least two distinct values";
    case Status::EquationUnsolved:
      return "the equation of the rule has no solution in double numbers: scale the values, or use another "
             "rule";
    case Status::InvalidParameter:
      return "a parameter is outside its documented range: give a value within it";
    case Status::Aborted:
      return "the work was ended before it was done, as asked: start it again for a result";
    case Status::DeviceNotOpen:
      return "the device is not open: call open() first";
    case Status::EndOfPath:
      return "the path has come to its end: open the device again to begin anew";
    case Status::FileNotReadable:
      return "the file cannot be opened for reading: check its name and permissions";
    case Status::FileMalformed:
      return "the file's content does not fit its format: check what wrote it, and write it again";
    case Status::FileNotWritable:
      return "the file cannot be written: check the folder, its permissions and the free space";
    case Status::DeviceNotFound:
      return "no such device is plugged in: check its cable and its power supply";
    case Status::DeviceNotPermitted:
      return "this user may not open the device: install the udev rule (see Documentation/Devices.md) and "
             "plug "
             "it in again";
    case Status::DeviceNotReady:
      return "the device is not ready yet: wait while it starts, then pull its grip out and push it in to "
             "home it";
    case Status::DeviceLost:
      return "the device was unplugged: plug it in again, it starts by itself";
    case Status::DeviceSilent:
      return "the device does not answer: check its power supply, unplug it and plug it in again";
    case Status::DeviceBadReply:
      return "the device reported a position that cannot be: no force until its replies make sense again; "
             "check its "
             "cable where that lasts";
    case Status::FirmwareMissing:
      return "the device needs its firmware: name the file that holds it (see Documentation/Devices.md)";
    case Status::FirmwareNotTaken:
      return "the device did not take its firmware: check the file, unplug the device for ten seconds and "
             "try "
             "again";
    case Status::NotPassive:
      return "stiffness and damping are above what the device can render without shaking: use less of them "
             "or "
             "a higher rate";
    case Status::RateNotSupported:
      return "the device cannot be served that often: use a lower rate";
  }
  return "unknown status";
}

} // namespace pointhaptics
