/// @file
/// A Falcon without hardware: its serial chip, its boot loader, its firmware, and a hand in its grip. The
/// same model stands behind the in-process tests and the emulated USB device.
#pragma once

#include "FalconReplies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// The hand: a mass between the person's spring and the motors, in the device frame.
struct FalconHand
{
  double mass = 0.15;
  double gripStiffness = 200.0;
  double gripDamping = 11.0;
  Vec3 wanted = falcon::kCenter;
  Vec3 position = falcon::kCenter;
  Vec3 velocity;
};

/// A vendor request of the host to the serial chip.
struct FalconControl
{
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::size_t bytesBefore = 0; ///< Bytes that the host had sent by then.
};

/// Bytes in, bytes out, time by the caller. One thread at a time.
class FalconModel
{
public:
  // How it behaves; change at will.
  int deafGreetings = 0; ///< The boot loader ignores so many.
  int wrongEchoes = 0;   ///< So many blocks of firmware are echoed wrongly.
  bool zeroBeforeReply = false;
  bool silent = false;       ///< Takes everything, says nothing.
  double motorSign = 1.0;    ///< -1: motors wired the wrong way round.
  bool homesByItself = true; ///< Homed from the first frame with the homing bit; else see home().
  FalconHand hand;
  std::vector<std::uint8_t> expectedFirmware;

  // Log of the host's requests.
  std::vector<FalconControl> controls; ///< Controls since the start.
  std::size_t bytesTaken = 0;          ///< Bytes that the host has sent.
  std::vector<std::uint8_t> firmware;
  int framesWithoutHomingBit = 0;
  int frames = 0;
  int frozenFrames = 0; ///< Newest frames in a row without any torque.
  FalconCommand command;
  Vec3 force; ///< On the hand, device frame.
  double largestForce = 0.0;
  bool runs = false; ///< The firmware runs. Loses it by powerOff().

  void powerOff()
  {
    runs = false;
    homed_ = false;
    ready_ = false;
    firmware.clear();
    out_.clear();
    in_.clear();
    command = FalconCommand();
    force = Vec3();
  }
  /// The person pulled the grip out and pushed it in: from now on the counts are true.
  void home() { homed_ = true; }
  void loseHoming() { homed_ = false; }

  void control(std::uint8_t request, std::uint16_t value)
  {
    controls.push_back({ request, value, bytesTaken });
    if (request == 0 && (value == 0 || value == 1))
    {
      out_.clear();
    }
    if (request == 0 && (value == 0 || value == 2))
    {
      in_.clear();
      finder_.reset();
    }
    if (request == 1 && value == 0x0101)
    {
      ready_ = false; // DTR up: the boot loader begins anew, and the program is gone.
      runs = false;
      firmware.clear();
    }
    if (request == 3)
    {
      divisor_ = value;
    }
  }

  void write(const std::uint8_t* bytes, std::size_t count)
  {
    bytesTaken += count;
    for (std::size_t i = 0; i < count; ++i)
    {
      take(bytes[i]);
    }
  }

  /// Payload waiting for the host, at most @p capacity bytes.
  std::size_t read(std::uint8_t* bytes, std::size_t capacity)
  {
    std::size_t count = 0;
    for (; count < capacity && !out_.empty(); ++count)
    {
      bytes[count] = out_.front();
      out_.pop_front();
    }
    return count;
  }
  std::deque<std::uint8_t>& pending() { return out_; }

  /// The hand under the person's spring and the last command's torques.
  void move(double seconds)
  {
    const int steps = std::max(1, int(std::ceil(seconds / 1e-4)));
    const double h = seconds / steps;
    for (int i = 0; i < steps; ++i)
    {
      force = forceOfMotors();
      const Vec3 pull =
        hand.gripStiffness * (hand.wanted - hand.position) - hand.gripDamping * hand.velocity + force;
      hand.velocity += h / hand.mass * pull;
      hand.position += h * hand.velocity;
    }
    largestForce = std::max(largestForce, norm(force));
  }

private:
  Vec3 forceOfMotors() const
  {
    FalconAngles angles;
    if (!runs || !falcon::inverse(hand.position, angles))
    {
      return {};
    }
    // F = sum torque_i d(angle_i)/d(position): central differences of the closed form, not the driver's
    // matrix.
    Vec3 result;
    constexpr double h = 1e-6;
    for (int axis = 0; axis < 3; ++axis)
    {
      Vec3 offset;
      offset[axis] = h;
      FalconAngles low;
      FalconAngles high;
      if (!falcon::inverse(hand.position - offset, low) || !falcon::inverse(hand.position + offset, high))
      {
        return {};
      }
      for (std::size_t i = 0; i < 3; ++i)
      {
        result[axis] += motorSign * double(command.motors[i]) / -10000.0 * (high[i] - low[i]) / (2.0 * h);
      }
    }
    return result;
  }

  void take(std::uint8_t byte)
  {
    if (silent)
    {
      return;
    }
    if (!runs && divisor_ == 0x4138)
    {
      in_.push_back(byte);
      const std::uint8_t greeting[] = { 0x0A, 0x43, 0x0D };
      if (in_.size() >= 3 && std::equal(greeting, greeting + 3, in_.end() - 3))
      {
        in_.clear();
        if (deafGreetings-- > 0)
        {
          return;
        }
        ready_ = true;
        if (zeroBeforeReply)
        {
          out_.push_back(0);
        }
        out_.insert(out_.end(), { 0x0A, 0x44, 0x2C, 0x0D });
      }
    }
    else if (!runs && divisor_ == 0x15 && ready_)
    {
      load(byte);
    }
    else if (runs && divisor_ == 0x2 && finder_.take(byte))
    {
      answer();
    }
  }

  void load(std::uint8_t byte)
  {
    if (!heardReady_)
    {
      heardReady_ = byte == 0x41;
      out_.push_back(byte);
      firmware.clear();
      return;
    }
    firmware.push_back(byte);
    const bool wrong = firmware.size() % 62 == 1 && wrongEchoes > 0;
    wrongEchoes -= wrong ? 1 : 0;
    out_.push_back(wrong ? std::uint8_t(~byte) : byte);
    if (firmware == expectedFirmware)
    {
      runs = true;
      heardReady_ = false;
      homed_ = false;
    }
    else if (wrong)
    {
      ready_ = false;
      heardReady_ = false;
    }
  }

  void answer()
  {
    FalconCommand received;
    if (!decode(finder_.frame(), received))
    {
      return;
    }
    command = received;
    ++frames;
    const bool still = command.motors == std::array<std::int16_t, kFalconLegs>{};
    frozenFrames = still ? frozenFrames + 1 : 0;
    framesWithoutHomingBit += (command.leds & kFalconHomingBit) ? 0 : 1;
    homed_ = homed_ || (homesByItself && (command.leds & kFalconHomingBit));
    FalconReply reply;
    FalconAngles angles{};
    falcon::inverse(hand.position, angles);
    for (std::size_t i = 0; i < 3; ++i)
    {
      // Before homing the counts begin wherever the arm was when the power came on.
      reply.encoders[i] = std::int16_t(std::lround(countOf(angles[i]))) + (homed_ ? 0 : 977);
    }
    reply.homed = homed_ ? 7 : 0;
    reply.buttons = buttons;
    const FalconFrame frame = encode(reply);
    out_.insert(out_.end(), frame.begin(), frame.end());
  }

public:
  std::uint8_t buttons = 0;

private:
  std::uint16_t divisor_ = 0;
  bool ready_ = false;
  bool heardReady_ = false;
  bool homed_ = false;
  std::vector<std::uint8_t> in_;
  std::deque<std::uint8_t> out_;
  FalconFrameFinder finder_;
};

} // namespace trial
} // namespace pointhaptics
