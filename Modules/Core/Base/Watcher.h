/// @file
/// The seam between Core's long work and whoever waits for it: progress, and the wish to end it.
#pragma once

#include <cstdint>

namespace pointhaptics
{

/// Hears how far long work is and may end it.
class Watcher
{
public:
  virtual ~Watcher() = default;
  /// @p fraction of the work is done, 0 to 1, never less than before. Called from the thread that the work
  /// was begun from. @return false to end the work.
  virtual bool proceed(double fraction) = 0;
};

/// Tells another, or nobody, how far a part of its work is.
class PartWatcher : public Watcher
{
public:
  /// The part is that from @p begin to @p end of the work of @p whole.
  PartWatcher(Watcher* whole, double begin, double end)
    : whole_(whole)
    , begin_(begin)
    , end_(end)
  {
  }
  bool proceed(double fraction) override
  {
    return !whole_ || whole_->proceed(fraction < 1.0 ? begin_ + (end_ - begin_) * fraction : end_);
  }

private:
  Watcher* whole_;
  double begin_;
  double end_;
};

/// A watcher is told at least each time so many points have been looked at.
constexpr std::int64_t kWatchedPoints = 1250000;

/// Counts what passes over a cloud have looked at, for a watcher, which may be null.
class WatchedPoints
{
public:
  WatchedPoints(Watcher* watcher, std::int64_t points, int passes)
    : watcher_(watcher)
    , all_(double(points) * passes)
  {
  }
  /// @return false to end the work.
  bool add(std::int64_t points)
  {
    seen_ += double(points);
    return !watcher_ || watcher_->proceed(seen_ < all_ ? seen_ / all_ : 1.0);
  }

private:
  Watcher* watcher_;
  double all_;
  double seen_ = 0.0;
};

/// Calls work(first, last) for slices of @p points points, of which @p watched hears one after the other.
/// @return false where it ended the work.
template <typename Work>
bool forWatchedSlices(std::int64_t points, WatchedPoints& watched, Work&& work)
{
  for (std::int64_t first = 0; first < points; first += kWatchedPoints)
  {
    const std::int64_t last = points - first < kWatchedPoints ? points : first + kWatchedPoints;
    work(first, last);
    if (!watched.add(last - first))
    {
      return false;
    }
  }
  return true;
}

} // namespace pointhaptics
