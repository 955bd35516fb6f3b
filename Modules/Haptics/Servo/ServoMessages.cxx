#include "Haptics/Servo/ServoMessages.h"

#include "Haptics/ServoLoop.h"

#include <system_error>

namespace pointhaptics
{
namespace
{
/// Three digits are enough for a limit.
std::string number(double value)
{
  std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + (value < 100.0 ? 3 : 0));
}
}

Status checkSpring(bool isValid, const HandLimits& limits, const HapticParameters& parameters, double rateHz,
  std::string* message)
{
  const ContactParameters& contact = parameters.contact;
  const Status status = isValid && parameters.check() == Status::Ok
    ? checkPassive(limits, contact.stiffness, contact.damping, rateHz)
    : Status::InvalidParameter;
  if (message && status == Status::RateNotSupported)
  {
    *message = "the device cannot be served at " + number(rateHz) + " Hz; use at most " +
      number(limits.maximumRateHz) + " Hz";
  }
  else if (message && status == Status::NotPassive)
  {
    *message = "stiffness " + number(contact.stiffness) + " N/m with damping " + number(contact.damping) +
      " N s/m at " + number(rateHz) + " Hz would make the hand shake; use a stiffness of at most " +
      number(largestPassiveStiffness(limits, contact.damping, rateHz)) + " N/m beside this damping (" +
      number(largestPassiveStiffness(limits, 0.0, rateHz)) + " N/m without damping)";
  }
  else if (message)
  {
    *message = status == Status::Ok ? "" : pointhaptics::message(status);
  }
  return status;
}

std::string describeRefusals(const ServoStatistics& statistics)
{
  std::string text;
  const auto add = [&](int error, const std::string& what, const std::string& cure)
  {
    if (error != 0)
    {
      text += (text.empty() ? "" : "\n") + what + " (" + std::generic_category().message(error) + ")" + cure;
    }
  };
  add(statistics.realtimeRefusal, "the servo thread got no real-time priority",
    ": ticks may come late on a busy machine; allow rtprio 40 for this user in /etc/security/limits.d");
  add(statistics.memoryRefusal, "the program may be swapped out",
    "; allow memlock unlimited for this user in /etc/security/limits.d");
  add(statistics.awakeRefusal, "the processor may fall asleep between ticks",
    ": they may come some hundreds of microseconds late; let this user write /dev/cpu_dma_latency, as "
    "70-pointhaptics.rules does for group plugdev after `sudo udevadm trigger "
    "--sysname-match=cpu_dma_latency`");
  return text;
}

} // namespace pointhaptics
