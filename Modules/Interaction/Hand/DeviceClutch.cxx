#include "DeviceClutch.h"

#include "ModelTransform.h"
#include "ScreenView.h"

namespace pointhaptics
{
namespace
{

constexpr int kButtons = 4;

} // namespace

void DeviceClutch::setServo(ServoLoop* servo)
{
  if (isClutched_ && servo_)
  {
    servo_->setClutched(false);
  }
  isClutched_ = false;
  if (this->isHolding())
  {
    hold_.clear();
    model_.endGesture();
  }
  servo_ = servo;
}

bool DeviceClutch::take(const std::vector<ServoSample>& samples)
{
  bool hasRun = false;
  for (const ServoSample& sample : samples)
  {
    hasRun = this->take(sample) || hasRun;
  }
  this->moveModel();
  return hasRun;
}

bool DeviceClutch::take(const ServoSample& sample)
{
  // A device without an answer counts as holding nothing: the hand may be anywhere when it answers again.
  const bool isReadable = sample.device == Status::Ok && isFinite(sample.state.hip);
  const std::uint32_t buttons = isReadable ? sample.buttons : 0;
  // A button that is held through a moment without answers is not pressed again.
  const std::uint32_t pressed = buttons & ~buttons_;
  buttons_ = isReadable ? buttons : buttons_;
  std::string held; // a name: a command that is run may change the registry
  bool hasRun = false;
  for (int i = kButtons - 1; i >= 0; --i)
  {
    const std::uint32_t bit = std::uint32_t(1) << i;
    const Command* command = buttons & bit ? commands_.find("hand" + std::to_string(i + 1)) : nullptr;
    if (command && std::holds_alternative<GripAction>(command->action))
    {
      held = command->name;
    }
    else if (pressed & bit)
    {
      hasRun = runOnce(command) || hasRun;
    }
  }
  if (held != hold_)
  {
    this->end();
    this->begin(commands_.get(held), sample.state.hip);
  }
  else if (this->isHolding())
  {
    to_ = sample.state.hip;
  }
  return hasRun;
}

void DeviceClutch::begin(const Command* command, const Vec3& hip)
{
  const auto* grip = command ? std::get_if<GripAction>(&command->action) : nullptr;
  if (!grip)
  {
    return;
  }
  hold_ = command->name;
  grip_ = *grip;
  from_ = hip;
  to_ = hip;
  isClutched_ = true;
  model_.beginGesture();
  if (servo_)
  {
    servo_->setClutched(true);
  }
}

void DeviceClutch::end()
{
  if (!this->isHolding())
  {
    return;
  }
  this->moveModel();
  hold_.clear();
  model_.endGesture();
  if (grip_.end)
  {
    grip_.end();
  }
}

void DeviceClutch::moveModel()
{
  const Vec3 way = to_ - from_;
  if (this->isHolding() && screen_.renderer() && way != Vec3())
  {
    from_ = to_;
    grip_.move(way);
  }
}

void DeviceClutch::letGo()
{
  if (isClutched_ && !this->isHolding())
  {
    isClutched_ = false;
    if (servo_)
    {
      servo_->setClutched(false);
    }
  }
}

} // namespace pointhaptics
