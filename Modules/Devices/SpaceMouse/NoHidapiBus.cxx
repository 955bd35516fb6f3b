// Replaces HidapiBus.cxx where hidapi is not installed.
#include "Devices/SpaceMouse/HidBus.h"

namespace pointhaptics
{

std::unique_ptr<HidBus> makeHidapiBus()
{
  return nullptr;
}

} // namespace pointhaptics
