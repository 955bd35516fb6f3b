/// @file
/// Interface of the SpaceMouse driver to HID, which a test can replace.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{

/// A HID device that is plugged in.
struct HidFound
{
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string path; ///< For open(): "/dev/hidraw3".
  std::string name; ///< For people.
  // Usage in the report descriptor of this interface; 0: unknown.
  std::uint16_t usagePage = 0;
  std::uint16_t usage = 0;

  /// True unless the interface declares itself another thing than a multi-axis controller (generic desktop,
  /// usage 8): a receiver has an interface for each of its devices.
  bool mayHaveSixAxes() const noexcept { return usagePage == 0 || (usagePage == 1 && usage == 8); }
};

/// An open device; closed by its destructor. One thread.
class HidLink
{
public:
  virtual ~HidLink() = default;
  /// Reads the next report. @return its bytes, 0 after the timeout, -1 where the device is gone.
  virtual int read(std::uint8_t* bytes, int capacity, int timeoutMilliseconds) = 0;
  /// Writes an output report, its number first. False: it was not taken.
  virtual bool write(const std::uint8_t* bytes, int count) = 0;
};

/// Finds and opens HID devices; implemented with hidapi, and by tests.
class HidBus
{
public:
  virtual ~HidBus() = default;
  virtual std::vector<HidFound> find() = 0;
  /// Null: @p message says why, with the cure.
  virtual std::unique_ptr<HidLink> open(const HidFound& device, std::string& message) = 0;
};

/// hidapi; null where the package was built without it.
std::unique_ptr<HidBus> makeHidapiBus();

} // namespace pointhaptics
