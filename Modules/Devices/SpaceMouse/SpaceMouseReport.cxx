#include "Devices/SpaceMouse/SpaceMouseReport.h"

#include <algorithm>
#include <iterator>

namespace pointhaptics
{
namespace
{
constexpr double kRange = 350.0;
constexpr double kLargestDeadZone = 0.9;
constexpr std::uint16_t kLogitech = 0x046d;
constexpr std::uint16_t k3Dconnexion = 0x256f;
constexpr std::uint16_t kOfLogitech[] = { 0xc603, 0xc605, 0xc606, 0xc621, 0xc623, 0xc625, 0xc626, 0xc627,
  0xc628, 0xc629, 0xc62b, 0xc640 };
constexpr std::uint16_t kOf3Dconnexion[] = { 0xc62e, 0xc62f, 0xc631, 0xc632, 0xc633, 0xc635, 0xc636, 0xc638,
  0xc63a, 0xc652, 0xc65a, 0xc65c };

enum Report : std::uint8_t
{
  kShift = 1,
  kTurn = 2,
  kButtons = 3,
};
constexpr int kThreeAxes = 7;
constexpr int kSixAxes = 13;
constexpr int kButtonBytes = 4;

template <std::size_t N>
bool holds(const std::uint16_t (&list)[N], std::uint16_t product) noexcept
{
  return std::find(std::begin(list), std::end(list), product) != std::end(list);
}

double axis(const std::uint8_t* bytes) noexcept
{
  const auto value = std::int16_t(std::uint16_t(bytes[0] | (bytes[1] << 8)));
  return std::min(std::max(value / kRange, -1.0), 1.0);
}

/// Turns the device's axes into the workspace's.
Vec3 inWorkspace(const std::uint8_t* bytes) noexcept
{
  return { axis(bytes), -axis(bytes + 4), axis(bytes + 2) };
}

Vec3 beyond(const Vec3& v, double deadZone) noexcept
{
  Vec3 result;
  for (int i = 0; i < 3; ++i)
  {
    const double size = std::max(0.0, std::abs(v[i]) - deadZone) / (1.0 - deadZone);
    result[i] = size > 0.0 ? std::copysign(size, v[i]) : 0.0;
  }
  return result;
}
}

bool isSpaceMouse(std::uint16_t vendor, std::uint16_t product) noexcept
{
  return (vendor == kLogitech && holds(kOfLogitech, product)) ||
    (vendor == k3Dconnexion && holds(kOf3Dconnexion, product));
}

SpaceMouseDecoder::SpaceMouseDecoder(const SpaceMouseSettings& settings)
  : settings_(settings)
{
  settings_.deadZone = std::min(std::max(settings.deadZone, 0.0), kLargestDeadZone);
}

bool SpaceMouseDecoder::take(const std::uint8_t* bytes, int count, double timeSeconds) noexcept
{
  const int kind = count > 1 ? bytes[0] : -1;
  if ((kind == kShift || kind == kTurn) && count < kThreeAxes)
  {
    return false;
  }
  switch (kind)
  {
    case kShift:
      shift_ = inWorkspace(bytes + 1);
      shiftTime_ = timeSeconds;
      if (count >= kSixAxes)
      {
        turn_ = inWorkspace(bytes + kThreeAxes);
        turnTime_ = timeSeconds;
      }
      return true;
    case kTurn:
      turn_ = inWorkspace(bytes + 1);
      turnTime_ = timeSeconds;
      return true;
    case kButtons:
      buttons_ = 0;
      for (int i = 0; i < std::min(count - 1, kButtonBytes); ++i)
      {
        buttons_ |= std::uint32_t(bytes[1 + i]) << (8 * i);
      }
      return true;
    default:
      return false;
  }
}

SpaceMouseMotion SpaceMouseDecoder::motion(double timeSeconds) const noexcept
{
  SpaceMouseMotion result;
  const auto fresh = [&](double time) { return timeSeconds - time <= settings_.staleSeconds; };
  result.shift = fresh(shiftTime_) ? beyond(shift_, settings_.deadZone) : Vec3();
  result.turn = fresh(turnTime_) ? beyond(turn_, settings_.deadZone) : Vec3();
  result.buttons = buttons_;
  return result;
}

} // namespace pointhaptics
