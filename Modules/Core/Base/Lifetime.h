/// @file
/// Pointers to objects that somebody else owns and may destroy at any time.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace pointhaptics
{

template <typename T>
class WatchedPointer;

/// A member of a class whose objects others point to by WatchedPointer. It ends with the object; where other
/// threads may work in the object, its destructor calls end() first.
class Lifetime
{
public:
  Lifetime()
    : state_(std::make_shared<State>())
  {
  }
  ~Lifetime() { this->end(); }
  /// A copied object has a life of its own.
  Lifetime(const Lifetime&)
    : Lifetime()
  {
  }
  Lifetime& operator=(const Lifetime&) noexcept { return *this; }

  /// From now on the pointers are null. Waits for those who are in WatchedPointer::use().
  void end() noexcept
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->hasEnded = true;
  }

private:
  template <typename T>
  friend class WatchedPointer;

  struct State
  {
    std::mutex mutex;
    std::atomic<bool> hasEnded{ false };
  };
  std::shared_ptr<State> state_;
};

/// Does not own its object, and is null once that is destroyed. T has lifetime(), which gives its Lifetime.
template <typename T>
class WatchedPointer
{
public:
  WatchedPointer() = default;
  /// Points to an object that lives, or is null.
  WatchedPointer(T* object)
    : object_(object)
    , state_(object ? object->lifetime().state_ : nullptr)
  {
  }

  /// Returns the object, or null. Only for the thread that may destroy the object: others learn nothing about
  /// the next moment.
  T* get() const noexcept { return state_ && !state_->hasEnded ? object_ : nullptr; }
  T* operator->() const noexcept { return this->get(); }
  explicit operator bool() const noexcept { return this->get() != nullptr; }

  /// Calls work(object), in any thread, unless the object is gone; it is not destroyed before @p work
  /// returns. Calls of several threads follow each other. @p work must not destroy the object. False: it is
  /// gone.
  template <typename Work>
  bool use(Work&& work) const
  {
    if (!state_)
    {
      return false;
    }
    const std::lock_guard<std::mutex> lock(state_->mutex);
    if (!state_->hasEnded)
    {
      work(*object_);
    }
    return !state_->hasEnded;
  }

private:
  T* object_ = nullptr;
  std::shared_ptr<Lifetime::State> state_;
};

} // namespace pointhaptics
