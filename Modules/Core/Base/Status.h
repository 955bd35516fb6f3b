/// @file
/// The errors of Core, Haptics and Devices, each with a message that names the cure.
#pragma once

namespace pointhaptics
{

enum class [[nodiscard]] Status{
  Ok,
  Empty,                 ///< No valid point is left to work on.
  SingularTransform,     ///< Determinant zero, or so small that the inverse overflows.
  NonFiniteTransform,    ///< NaN or infinity among the transform's numbers.
  InvalidWorkspace,      ///< Bounds not finite, or maximum not above minimum.
  InvalidDimensions,     ///< Fewer than 1 or more than kMaximumLatticeDimension voxels on an axis.
  InvalidVoxelSize,      ///< Voxel edge zero, negative or not finite.
  LatticeNotAddressable, ///< The lattice would need more voxels on an axis than a key can hold.
  InvalidNeighborhood,   ///< Number of neighbours below 1, or radius not above 0.
  InvalidRadiusBounds,   ///< r1 > r2, or a bound that is negative or not finite.
  DegenerateSample,      ///< Fewer than two distinct values: no spread to take a bandwidth from.
  EquationUnsolved,      ///< The rule's equation has no solution in double numbers.
  InvalidParameter,      ///< A parameter outside its documented range.
  Aborted,               ///< The caller aborted the work.
  DeviceNotOpen,         ///< Read or write on a device that is not open.
  EndOfPath,             ///< A replayed path has come to its end.
  FileNotReadable,       ///< The file cannot be opened.
  FileMalformed,         ///< The file's content is not what its format asks for.
  FileNotWritable,       ///< The file cannot be created or written.
  DeviceNotFound,        ///< No such device is plugged in.
  DeviceNotPermitted,    ///< The device is there, but this user may not open it.
  DeviceNotReady,        ///< Still starting, homing or taking a moment: no position yet, no force.
  DeviceLost,            ///< The device was unplugged or its connection broke.
  DeviceSilent,          ///< The device is there but does not answer.
  DeviceBadReply,        ///< The device answered what cannot be: held position, no force.
  FirmwareMissing,       ///< The device needs a firmware file that was not named or cannot be used.
  FirmwareNotTaken,      ///< The device did not accept its firmware.
  NotPassive,            ///< Stiffness and damping above what the device can render without giving energy.
  RateNotSupported,      ///< The servo rate is above what the device can do.
  PointsTooFar,          ///< Coordinates so large that double numbers cannot tell what a hand feels.
  OutOfMemory,           ///< The system gave no memory, or no thread, for the work.
};

/// One sentence in plain words: what happened and what to do about it. Never null; static storage.
const char* message(Status status) noexcept;

} // namespace pointhaptics
