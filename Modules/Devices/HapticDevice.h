/// @file
/// A device that knows where the hand is and pushes it.
#pragma once

#include "Haptics/HapticPort.h"

#include "Core/Base/PointView.h"

#include <string>

namespace pointhaptics
{

/// Capabilities of a device. Metres, newtons; workspace frame: x right, y up, z towards the person.
struct DeviceCapabilities
{
  Bounds workspace;          ///< Where the hand can be.
  double maximumForce = 0.0; ///< N the device can hold.
};

/// Life: open(), then read() and write() in turn, once a tick, then close(). open() and close() belong to the
/// thread that owns the device; read() and write() to the servo thread, between the two, and never wait
/// longer than a tick. limits() (see HapticPort) says which springs the device can render.
///
/// Positions and forces are in the workspace frame: metres and newtons, x right, y up, z towards the person,
/// the origin in the middle of the workspace.
class HapticDevice : public HapticPort
{
public:
  /// Short name for people: "simulated", "path", "falcon".
  virtual const char* name() const noexcept = 0;
  /// Capabilities, equal before and after open().
  virtual DeviceCapabilities capabilities() const noexcept = 0;
  /// Largest force of the capabilities; 0 there: not known, and no limit.
  double maximumForce() const noexcept override
  {
    const double declared = this->capabilities().maximumForce;
    return declared > 0.0 ? declared : HapticPort::maximumForce();
  }
  /// Opens the device. Ok, or a status whose message says what to do; message() may say more.
  virtual Status open() = 0;
  /// Sends zero force and releases the device. Safe on a closed one.
  virtual void close() = 0;
  /// Message of open() or of the device to the user: empty, or one sentence with problem and cure. Any thread
  /// but the servo thread.
  virtual std::string message() const { return {}; }
};

} // namespace pointhaptics
