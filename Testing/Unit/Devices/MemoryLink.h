/// @file
/// A Falcon's wire in memory: every command is answered at once, in the thread that sends it.
#pragma once

#include "FalconModel.h"

#include "Devices/Falcon/FtdiLink.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace pointhaptics
{
namespace trial
{

struct NoGuard
{
};

/// @tparam Guard lives while a tick uses the model, which is not the driver's work.
template <typename Guard = NoGuard>
class MemoryLink : public FtdiLink
{
public:
  using OnCommand = std::function<void(FalconModel&)>;

  /// @param onCommand called before each command of a tick: moves the hand.
  MemoryLink(std::shared_ptr<FalconModel> model, OnCommand onCommand)
    : model_(std::move(model))
    , onCommand_(std::move(onCommand))
  {
  }
  Status control(std::uint8_t request, std::uint16_t value) override
  {
    model_->control(request, value);
    return Status::Ok;
  }
  Status send(const std::uint8_t* bytes, int count, int) override
  {
    model_->write(bytes, std::size_t(count));
    return Status::Ok;
  }
  Status receive(std::uint8_t* bytes, int& count, int) override
  {
    count = int(model_->read(bytes, kFtdiPacket));
    return Status::Ok;
  }
  Status submit(const std::uint8_t* bytes, int count) noexcept override
  {
    [[maybe_unused]] const Guard guard{};
    onCommand_(*model_);
    model_->write(bytes, std::size_t(count));
    return Status::Ok;
  }
  Status poll(std::uint8_t* bytes, int capacity, int& count, double) noexcept override
  {
    [[maybe_unused]] const Guard guard{};
    count = int(model_->read(bytes, std::size_t(capacity)));
    return Status::Ok;
  }

private:
  std::shared_ptr<FalconModel> model_;
  OnCommand onCommand_;
};

template <typename Guard = NoGuard>
class MemoryBus : public FtdiBus
{
public:
  MemoryBus(std::shared_ptr<FalconModel> model, typename MemoryLink<Guard>::OnCommand onCommand)
    : model_(std::move(model))
    , onCommand_(std::move(onCommand))
  {
  }
  std::unique_ptr<FtdiLink> open(Status& status, std::string&) override
  {
    status = Status::Ok;
    return std::make_unique<MemoryLink<Guard>>(model_, onCommand_);
  }

private:
  std::shared_ptr<FalconModel> model_;
  typename MemoryLink<Guard>::OnCommand onCommand_;
};

} // namespace trial
} // namespace pointhaptics
