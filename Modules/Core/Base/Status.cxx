#include "Core/Base/Status.h"

#include <cstddef>
#include <iterator>

namespace pointhaptics
{
namespace
{

struct Message
{
  Status status;
  const char* text;
};

constexpr Message kMessages[] = {
  { Status::Ok, "no error" },
  { Status::Empty, "no valid point is left: check the workspace, the transform and the file" },
  { Status::SingularTransform,
    "the transform is singular: use scales other than 0 and a matrix that can be inverted" },
  { Status::NonFiniteTransform, "the transform holds NaN or infinity: use finite numbers" },
  { Status::InvalidWorkspace,
    "the workspace bounds must be finite with maximum above minimum on every axis" },
  { Status::InvalidDimensions, "the lattice dimensions must be between 1 and 2097152 on every axis" },
  { Status::InvalidVoxelSize, "the voxel size must be finite and above 0" },
  { Status::LatticeNotAddressable,
    "the lattice would have more than 2097152 voxels on an axis: use a larger voxel size or a smaller "
    "workspace" },
  { Status::InvalidNeighborhood, "the neighbourhood needs at least 1 neighbour, or a radius above 0" },
  { Status::InvalidRadiusBounds, "the radius bounds must be finite, not negative, and r1 not above r2" },
  { Status::DegenerateSample, "the sample has no spread: give at least two distinct values" },
  { Status::EquationUnsolved,
    "the equation of the rule has no solution in double numbers: scale the values, or use another rule" },
  { Status::InvalidParameter, "a parameter is outside its documented range: give a value within it" },
  { Status::Aborted, "the work was ended before it was done, as asked: start it again for a result" },
  { Status::DeviceNotOpen, "the device is not open: call open() first" },
  { Status::EndOfPath, "the path has come to its end: open the device again to begin anew" },
  { Status::FileNotReadable, "the file cannot be opened for reading: check its name and permissions" },
  { Status::FileMalformed,
    "the file's content does not fit its format: check what wrote it, and write it again" },
  { Status::FileNotWritable,
    "the file cannot be written: check the folder, its permissions and the free space" },
  { Status::DeviceNotFound, "no such device is plugged in: check its cable and its power supply" },
  { Status::DeviceNotPermitted,
    "this user may not open the device: install the udev rule (see Documentation/Devices.md) and plug it in "
    "again" },
  { Status::DeviceNotReady,
    "the device is not ready yet: wait while it starts, then pull its grip out and push it in to home it" },
  { Status::DeviceLost, "the device was unplugged: plug it in again, it starts by itself" },
  { Status::DeviceSilent,
    "the device does not answer: check its power supply, unplug it and plug it in again" },
  { Status::DeviceBadReply,
    "the device reported a position that cannot be: no force until its replies make sense again; check its "
    "cable where that lasts" },
  { Status::FirmwareMissing,
    "the device needs its firmware: name the file that holds it (see Documentation/Devices.md)" },
  { Status::FirmwareNotTaken,
    "the device did not take its firmware: check the file, unplug the device for ten seconds and try again" },
  { Status::NotPassive,
    "stiffness and damping are above what the device can render without shaking: use less of them or a "
    "higher rate" },
  { Status::RateNotSupported, "the device cannot be served that often: use a lower rate" },
  { Status::PointsTooFar,
    "points lie more than 1e9 m from the origin, too far for a hand to feel any: leave out those that are "
    "far "
    "from all others, or scale the cloud" },
  { Status::OutOfMemory,
    "not enough memory: give fewer points or larger voxels, close other programs, or raise the limit (ulimit "
    "-v)" },
};

/// True if each status has its message at its own index.
constexpr bool areInOrder()
{
  for (std::size_t i = 0; i < std::size(kMessages); ++i)
  {
    if (std::size_t(kMessages[i].status) != i)
    {
      return false;
    }
  }
  return std::size(kMessages) == std::size_t(Status::OutOfMemory) + 1;
}
static_assert(areInOrder(), "a status lacks its message");

} // namespace

const char* message(Status status) noexcept
{
  const std::size_t index = std::size_t(status);
  return index < std::size(kMessages) ? kMessages[index].text : "unknown status";
}

} // namespace pointhaptics
