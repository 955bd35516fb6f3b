/// @file
/// A device that knows where the hand is and pushes it.
#pragma once

#include "Haptics/HandPort.h"

#include "Core/PointView.h"

namespace pointhaptics
{

/// What a device can do. Metres, newtons, hertz.
struct DeviceCapabilities
{
  Bounds workspace;              ///< Where the hand can be, workspace frame.
  double maximumForce = 0.0;     ///< Newtons the device can hold.
  double maximumStiffness = 0.0; ///< N/m a passive spring may have.
  int numberOfButtons = 0;
};

/// open() and close() belong to the thread that owns the device; read() and write() to the servo thread.
class HapticDevice : public HandPort
{
public:
  /// Short name for people: "simulated", "path".
  virtual const char* name() const noexcept = 0;
  virtual DeviceCapabilities capabilities() const noexcept = 0;
  virtual Status open() = 0;
  /// Zero force, then release. Safe on a closed device.
  virtual void close() = 0;
};

} // namespace pointhaptics
