/// @file
/// Progress of long computations in Core, and how a caller aborts one.
#pragma once

#include <cstdint>

namespace pointhaptics
{

/// Receives the progress of a computation and may abort it.
class ProgressObserver
{
public:
  virtual ~ProgressObserver() = default;
  /// The @p fraction of the work that is done, 0 to 1, never decreases. Called from the thread that started
  /// the work. @return false to abort the work.
  virtual bool report(double fraction) = 0;
};

/// Reports the progress of one part of a computation to the observer of the whole, which may be null.
class SubProgress : public ProgressObserver
{
public:
  /// The part covers the fractions from @p begin to @p end of what @p whole observes.
  SubProgress(ProgressObserver* whole, double begin, double end)
    : whole_(whole)
    , begin_(begin)
    , end_(end)
  {
  }
  bool report(double fraction) override
  {
    return !whole_ || whole_->report(fraction < 1.0 ? begin_ + (end_ - begin_) * fraction : end_);
  }

private:
  ProgressObserver* whole_;
  double begin_;
  double end_;
};

/// The most points that are processed between two reports.
constexpr std::int64_t kPointsPerReport = 1250000;

/// Converts points processed into fractions for an observer, which may be null.
class PointProgress
{
public:
  PointProgress(ProgressObserver* observer, std::int64_t points, int passes)
    : observer_(observer)
    , total_(double(points) * passes)
  {
  }
  /// @return false to abort the work.
  bool add(std::int64_t points)
  {
    done_ += double(points);
    return !observer_ || observer_->report(done_ < total_ ? done_ / total_ : 1.0);
  }

private:
  ProgressObserver* observer_;
  double total_;
  double done_ = 0.0;
};

/// Calls work(first, last) for consecutive slices of @p points points and reports after each slice.
/// @return false where the observer aborted the work.
template <typename Work>
bool forReportedSlices(std::int64_t points, PointProgress& progress, Work&& work)
{
  for (std::int64_t first = 0; first < points; first += kPointsPerReport)
  {
    const std::int64_t last = points - first < kPointsPerReport ? points : first + kPointsPerReport;
    work(first, last);
    if (!progress.add(last - first))
    {
      return false;
    }
  }
  return true;
}

} // namespace pointhaptics
