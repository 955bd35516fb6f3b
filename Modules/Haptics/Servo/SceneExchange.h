/// @file
/// Passes scenes from the thread that builds them to the servo thread, which never waits and never frees.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointhaptics
{

class HapticScene;

/// Two threads: one publishes, the other acquires. A mailbox of one entry goes from the first to the second;
/// a number goes back that says which entries are out of use. At most four scenes are kept alive: the one in
/// the mailbox, the one in use, its predecessor and one not yet collected. Memory is given back on the
/// publishing thread only.
class SceneExchange
{
public:
  SceneExchange();
  /// Frees all scenes: the acquiring thread must have ended.
  ~SceneExchange();
  SceneExchange(const SceneExchange&) = delete;
  SceneExchange& operator=(const SceneExchange&) = delete;

  /// Publishing thread. The next acquire() gives @p scene (null: no scene). Frees what is out of use.
  void publish(std::shared_ptr<const HapticScene> scene);
  /// Publishing thread. Frees what is out of use; publish() does the same.
  void collect();
  /// Publishing thread. Scenes kept alive now, null ones included.
  std::size_t numberOfKeptScenes() const noexcept { return kept_.size(); }

  /// Acquiring thread; wait-free, frees nothing. The newest scene, or null. The scene that the call before
  /// returned stays valid until the next call, so that its user can compare the two.
  const HapticScene* acquire() noexcept;

private:
  struct Entry;

  std::atomic<Entry*> mailbox_{ nullptr };
  std::atomic<std::uint64_t> oldestInUse_{ 0 }; ///< Entries with a smaller number are out of use.
  Entry* current_ = nullptr;                    ///< Acquiring thread's.
  std::vector<std::unique_ptr<Entry>> kept_;    ///< Publishing thread's.
  std::uint64_t published_ = 0;                 ///< Publishing thread's.
};

} // namespace pointhaptics
