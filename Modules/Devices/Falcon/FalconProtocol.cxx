#include "Devices/Falcon/FalconProtocol.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pointhaptics
{
namespace
{
/// A hand at 5 m/s turns a joint of 6 cm by 83 rad/s, 131,000 counts a second: faster is a broken answer.
constexpr double kCountsPerSecond = 150000.0;
constexpr double kFewCounts = 150.0;
/// This many answers in a row far from the last good one, each near the one before it, are believed.
constexpr int kBelieved = 5;
constexpr int kTimeoutsToResynchronise = 3;
/// After this many ticks in a row without the newest answer, that answer counts as lost: it comes later than
/// a wait may last.
constexpr int kVainWaits = 10;
constexpr int kTimeoutsToGiveUp = 50;
constexpr int kShutdownAnswers = 3;
constexpr int kMostGoodbyes = 50;
constexpr double kGoodbyeWait = 2e-3;
constexpr int kBytes = 4 * kFtdiPacket;

double largestDifference(
  const std::array<std::int16_t, kFalconLegs>& a, const std::array<std::int16_t, kFalconLegs>& b) noexcept
{
  int result = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    result = std::max(result, std::abs(int(a[i]) - int(b[i])));
  }
  return double(result);
}
}

FalconProtocol::FalconProtocol(const FalconSettings& settings)
  : settings_(settings)
  , chain_(settings.limits)
{
}

void FalconProtocol::transition(FalconEvent event) noexcept
{
  const FalconState before = state();
  const FalconState after = next(before, event);
  if (after != before)
  {
    chain_.restart();
    state_.store(int(after), std::memory_order_relaxed);
  }
}

void FalconProtocol::begin() noexcept
{
  chain_.restart();
  finder_.reset();
  reply_ = FalconReply();
  command_ = FalconCommand();
  positioned_ = false;
  jumps_ = 0;
  timeouts_ = 0;
  unanswered_ = 0;
  vainWaits_ = 0;
  abandoned_ = 0;
  timed_ = false;
  answered_ = false;
  ++count_.connections;
  shown_.write(count_);
  state_.store(int(FalconState::Unhomed), std::memory_order_relaxed);
}

/// Takes answers that have come. True: at least one whole one came; reply_ is the newest.
bool FalconProtocol::receive(FtdiLink& link, double waitSeconds, Status& status) noexcept
{
  std::uint8_t bytes[kBytes];
  int count = 0;
  status = link.poll(bytes, kBytes, count, waitSeconds);
  bool whole = false;
  for (int i = 0; status == Status::Ok && i < count; ++i)
  {
    if (finder_.take(bytes[i]) && decode(finder_.frame(), reply_))
    {
      whole = true;
      ++count_.replies;
      unanswered_ -= unanswered_ > 0 ? 1 : 0;
    }
  }
  count_.droppedBytes = finder_.droppedBytes();
  return whole;
}

Status FalconProtocol::take(const FalconReply& reply, double elapsed) noexcept
{
  if (!reply.allHomed())
  {
    transition(FalconEvent::HomingLost);
    positioned_ = false;
    return Status::DeviceNotReady;
  }
  const double allowed = kFewCounts + kCountsPerSecond * std::max(0.0, elapsed);
  const bool jumped = positioned_ && largestDifference(reply.encoders, encoders_) > allowed;
  const FalconAngles angles = falcon::anglesFromCounts(
    { double(reply.encoders[0]), double(reply.encoders[1]), double(reply.encoders[2]) });
  Vec3 position = position_;
  if (jumped || !falcon::forward(angles, positioned_ ? position_ : falcon::kCenter, position))
  {
    ++count_.badReplies;
    chain_.restart();
    // A hand that stays at a place it cannot have reached has reached it: answers between were lost.
    const bool agrees = jumps_ > 0 && largestDifference(reply.encoders, strange_) <= allowed;
    jumps_ = agrees ? jumps_ + 1 : 1;
    strange_ = reply.encoders;
    positioned_ = positioned_ && jumps_ < kBelieved;
    return Status::DeviceBadReply;
  }
  jumps_ = 0;
  encoders_ = reply.encoders;
  angles_ = angles;
  position_ = position;
  found_ = !positioned_;
  if (!positioned_)
  {
    positioned_ = true;
    chain_.restart();
  }
  transition(FalconEvent::HomedAll);
  return Status::Ok;
}

/// Handles a tick at @p timeSeconds without an answer. Ok: the answer is only late, the last position serves.
Status FalconProtocol::noAnswer(double timeSeconds) noexcept
{
  ++count_.lateReplies;
  if (timeSeconds - lastReply_ < settings_.answerTimeoutSeconds * (timeouts_ + 1))
  {
    const bool serves = timeouts_ == 0 && positioned_;
    return serves ? Status::Ok : timeouts_ > 0 ? Status::DeviceSilent : Status::DeviceNotReady;
  }
  ++count_.timeouts;
  ++timeouts_;
  unanswered_ = 0;
  vainWaits_ = 0;
  chain_.restart();
  // Purging the chip is a control request, which waits, and would drop an answer that is about to come.
  if (timeouts_ % kTimeoutsToResynchronise == 0)
  {
    finder_.reset();
  }
  return timeouts_ >= kTimeoutsToGiveUp ? Status::DeviceLost : Status::DeviceSilent;
}

Status FalconProtocol::read(FtdiLink& link, double timeSeconds, bool wantArmed, HandState& hand) noexcept
{
  answered_ = false;
  found_ = false;
  if (timed_ && timeSeconds < lastReply_)
  {
    // A new loop has begun, with a clock of its own.
    timed_ = false;
    timeouts_ = 0;
    chain_.restart();
  }
  if (!timed_)
  {
    lastReply_ = lastWrite_ = timeSeconds;
  }
  Status status = Status::Ok;
  bool whole = receive(link, 0.0, status);
  // An old answer alone would leave every later position a tick older: wait for the newest one, too.
  if (status == Status::Ok && timed_ && (!whole || unanswered_ > 0))
  {
    whole = receive(link, settings_.replyWaitSeconds, status) || whole;
  }
  timed_ = true;
  if (whole)
  {
    noteDelay();
  }
  if (status == Status::Ok)
  {
    status = whole ? take(reply_, timeSeconds - lastReply_) : noAnswer(timeSeconds);
  }
  if (whole)
  {
    lastReply_ = timeSeconds;
    timeouts_ = 0;
  }
  transition(wantArmed ? FalconEvent::Arm : FalconEvent::Disarm);
  if (status == Status::Ok)
  {
    answered_ = true;
    hand.position = position_ - falcon::kCenter;
    hand.buttons = reply_.buttons;
    hand.isNew = found_;
  }
  return status;
}

/// Counts how many ticks a position is older than the last command's answer.
void FalconProtocol::noteDelay() noexcept
{
  count_.largestUnanswered = std::max(count_.largestUnanswered, std::uint64_t(unanswered_));
  vainWaits_ = unanswered_ > 0 ? vainWaits_ + 1 : 0;
  if (vainWaits_ >= kVainWaits)
  {
    // Further waits would take that time in every tick.
    abandoned_ = unanswered_;
    unanswered_ = 0;
    vainWaits_ = 0;
  }
}

std::uint8_t FalconProtocol::usualLeds() const noexcept
{
  switch (state())
  {
    case FalconState::Unhomed:
      return kFalconLedBlue;
    case FalconState::Homed:
      return kFalconLedBlue | kFalconLedGreen;
    case FalconState::Armed:
      return chain_.ramp() > 0.0 || answered_ ? kFalconLedGreen : kFalconLedRed;
    default:
      return kFalconLedRed;
  }
}

Status FalconProtocol::write(FtdiLink& link, double timeSeconds, const Vec3& force, int leds) noexcept
{
  const bool mayPush = answered_ && state() == FalconState::Armed;
  const double dt = timeSeconds - lastWrite_;
  lastWrite_ = timeSeconds;
  command_.motors = chain_.step(force, position_, angles_, mayPush, dt);
  command_.leds = std::uint8_t((leds >= 0 ? leds : usualLeds()) | kFalconHomingBit);
  const FalconFrame frame = encode(command_);
  const Status status = link.submit(frame.data(), int(frame.size()));
  count_.skippedCommands += status == Status::DeviceNotReady ? 1 : 0;
  unanswered_ += status == Status::Ok ? 1 : 0;
  raw_.write({ reply_, command_, state() });
  shown_.write(count_);
  return status == Status::DeviceNotReady ? Status::Ok : status;
}

void FalconProtocol::shutdown(FtdiLink& link) noexcept
{
  const FalconFrame frame = encode(FalconCommand());
  // Answers to the commands of the last ticks come first.
  const std::uint64_t enough = count_.replies + std::uint64_t(unanswered_ + abandoned_ + kShutdownAnswers);
  for (int i = 0; i < kMostGoodbyes && count_.replies < enough; ++i)
  {
    Status status = link.submit(frame.data(), int(frame.size()));
    if (status != Status::Ok && status != Status::DeviceNotReady)
    {
      return;
    }
    static_cast<void>(receive(link, kGoodbyeWait, status));
    if (status != Status::Ok)
    {
      return;
    }
  }
}

} // namespace pointhaptics
