/// @file
/// A job whose ranks are threads of one process: Core's distributed steps without MPI.
#pragma once

#include "Core/Distributed/Ranks.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// The letter boxes of a job, and how many bytes went from one rank to another.
class ThreadJob
{
public:
  explicit ThreadJob(int size)
    : size_(size)
    , boxes_(std::size_t(size * size))
  {
  }

  /// Runs @p work on each rank; returns when all have ended.
  void run(const std::function<void(Ranks&)>& work)
  {
    std::vector<std::thread> threads;
    for (int rank = 0; rank < size_; ++rank)
    {
      threads.emplace_back(
        [this, rank, &work]
        {
          Member member(*this, rank);
          work(member);
        });
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
  }
  std::int64_t bytesSent() const { return sent_; }

private:
  class Member : public Ranks
  {
  public:
    Member(ThreadJob& job, int rank)
      : job_(job)
      , rank_(rank)
    {
    }
    int rank() const override { return rank_; }
    int size() const override { return job_.size_; }
    std::vector<std::string> exchange(std::vector<std::string> messages) override
    {
      return job_.exchange(rank_, std::move(messages));
    }

  private:
    ThreadJob& job_;
    int rank_;
  };

  std::vector<std::string> exchange(int rank, std::vector<std::string> messages)
  {
    for (int to = 0; to < size_; ++to)
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      sent_ += to == rank ? 0 : std::int64_t(messages[std::size_t(to)].size());
      boxes_[std::size_t(to * size_ + rank)] = std::move(messages[std::size_t(to)]);
    }
    this->waitForAll();
    std::vector<std::string> received;
    for (int from = 0; from < size_; ++from)
    {
      received.push_back(std::move(boxes_[std::size_t(rank * size_ + from)]));
    }
    this->waitForAll();
    return received;
  }
  void waitForAll()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::int64_t round = round_;
    if (++waiting_ == size_)
    {
      waiting_ = 0;
      ++round_;
      all_.notify_all();
      return;
    }
    all_.wait(lock, [&] { return round_ != round; });
  }

  const int size_;
  std::vector<std::string> boxes_; ///< [to][from]
  std::mutex mutex_;
  std::condition_variable all_;
  int waiting_ = 0;
  std::int64_t round_ = 0;
  std::int64_t sent_ = 0;
};

} // namespace trial
} // namespace pointhaptics
