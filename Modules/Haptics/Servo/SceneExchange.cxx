#include "Haptics/Servo/SceneExchange.h"

#include "Haptics/HapticScene.h"

#include <algorithm>

namespace pointhaptics
{

struct SceneExchange::Entry
{
  std::uint64_t number = 0;
  std::shared_ptr<const HapticScene> scene;
};

SceneExchange::SceneExchange() = default;
SceneExchange::~SceneExchange() = default;

void SceneExchange::publish(std::shared_ptr<const HapticScene> scene)
{
  collect();
  kept_.push_back(std::make_unique<Entry>());
  Entry* entry = kept_.back().get();
  entry->number = ++published_;
  entry->scene = std::move(scene);
  Entry* const untaken = mailbox_.exchange(entry, std::memory_order_acq_rel);
  if (untaken)
  {
    // The acquiring thread has never seen it.
    const auto found = std::find_if(kept_.begin(), kept_.end(),
      [untaken](const std::unique_ptr<Entry>& kept) { return kept.get() == untaken; });
    kept_.erase(found);
  }
}

void SceneExchange::collect()
{
  const std::uint64_t oldest = oldestInUse_.load(std::memory_order_acquire);
  kept_.erase(std::remove_if(kept_.begin(), kept_.end(),
                [oldest](const std::unique_ptr<Entry>& entry) { return entry->number < oldest; }),
    kept_.end());
}

const HapticScene* SceneExchange::acquire() noexcept
{
  if (current_)
  {
    // The caller is done with whatever came before the entry it got from the call before this one.
    oldestInUse_.store(current_->number, std::memory_order_release);
  }
  if (mailbox_.load(std::memory_order_relaxed))
  {
    // Only this thread empties the mailbox, so the exchange gives an entry, the newest one.
    current_ = mailbox_.exchange(nullptr, std::memory_order_acq_rel);
  }
  return current_ ? current_->scene.get() : nullptr;
}

} // namespace pointhaptics
