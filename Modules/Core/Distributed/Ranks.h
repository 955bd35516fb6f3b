/// @file
/// The interface between Core's distributed steps and what carries their messages (VTK's MPI in Parallel).
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pointhaptics
{

///@{
/// Trivial values one after the other, as bytes.
template <typename T>
std::string bytesOfValues(const std::vector<T>& values)
{
  static_assert(std::is_trivially_copyable_v<T>, "its bytes are sent");
  return { reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T) };
}
template <typename T>
std::vector<T> valuesOfBytes(const std::string& bytes)
{
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty())
  {
    std::memcpy(static_cast<void*>(values.data()), bytes.data(), values.size() * sizeof(T));
  }
  return values;
}
///@}

/// The processes of a job, which each have a part of a cloud. All calls are collective: each rank makes the
/// same ones in the same order. The base class is a job of one rank. Messages are in the order of bytes of
/// the machine: all ranks run on machines of one kind.
class Ranks
{
public:
  virtual ~Ranks() = default;
  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }
  /// Gives messages[r] to rank r. @return what each rank gave to this one, by rank. @pre size() messages.
  virtual std::vector<std::string> exchange(std::vector<std::string> messages) { return messages; }

  /// Gives every rank the messages of all ranks, by rank.
  std::vector<std::string> gather(const std::string& message)
  {
    return this->exchange(std::vector<std::string>(std::size_t(this->size()), message));
  }
  /// Gives values[r], which are trivial, to rank r. @return what all ranks gave to this one, one rank after
  /// the other. @pre size() lists.
  template <typename T>
  std::vector<T> exchangeValues(const std::vector<std::vector<T>>& values)
  {
    std::vector<std::string> messages;
    for (const std::vector<T>& forRank : values)
    {
      messages.push_back(bytesOfValues(forRank));
    }
    std::vector<T> received;
    for (const std::string& bytes : this->exchange(std::move(messages)))
    {
      const std::vector<T> more = valuesOfBytes<T>(bytes);
      received.insert(received.end(), more.begin(), more.end());
    }
    return received;
  }
  /// Gives every rank the values of all ranks, one rank after the other.
  template <typename T>
  std::vector<T> gatherAll(const std::vector<T>& own)
  {
    return this->exchangeValues(std::vector<std::vector<T>>(std::size_t(this->size()), own));
  }
  /// The values of all ranks, by rank.
  template <typename T>
  std::vector<T> gatherValues(const T& own)
  {
    return this->gatherAll(std::vector<T>{ own });
  }
  /// From the values of all ranks, one after the other, what @p join(a, b) makes of them: on all ranks the
  /// same.
  template <typename T, typename Join>
  T reduce(const T& value, Join&& join)
  {
    const std::vector<T> values = this->gatherValues(value);
    T result = values.front();
    for (std::size_t r = 1; r < values.size(); ++r)
    {
      result = join(result, values[r]);
    }
    return result;
  }
  /// True where it is on every rank.
  bool all(bool own)
  {
    return this->reduce(char(own), [](char a, char b) { return char(a && b); }) != 0;
  }
  std::int64_t sum(std::int64_t own) { return this->reduce(own, std::plus<>()); }
  /// The sum of the numbers of the ranks before this one.
  std::int64_t sumBefore(std::int64_t own)
  {
    const std::vector<std::int64_t> all = this->gatherValues(own);
    return std::accumulate(all.begin(), all.begin() + this->rank(), std::int64_t(0));
  }
};

/// Collective: values that cut those of all ranks into size() parts with about as many each; none where no
/// rank has a value. Every rank shows each n-th of its @p own, the same n on all: about @p samplesPerRank.
template <typename T>
std::vector<T> cutsOf(Ranks& ranks, const std::vector<T>& own, std::int64_t samplesPerRank)
{
  const auto size = std::size_t(ranks.size());
  const std::int64_t all = ranks.sum(std::int64_t(own.size()));
  const auto step = std::size_t(std::max<std::int64_t>(1, all / (samplesPerRank * std::int64_t(size))));
  std::vector<T> shown;
  for (std::size_t i = 0; i < own.size(); i += step)
  {
    shown.push_back(own[i]);
  }
  std::vector<T> sample = ranks.gatherAll(shown);
  std::sort(sample.begin(), sample.end());
  std::vector<T> cuts;
  for (std::size_t r = 1; r < size && !sample.empty(); ++r)
  {
    cuts.push_back(sample[sample.size() * r / size]);
  }
  return cuts;
}

} // namespace pointhaptics
