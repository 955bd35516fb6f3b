/// @file
/// The interface between Core's distributed steps and what carries their messages (VTK's MPI in Parallel).
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pointhaptics
{

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
  /// As gather(), for plain values.
  template <typename T>
  std::vector<T> gatherValues(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>, "its bytes are sent");
    std::vector<T> values;
    for (const std::string& bytes : this->gather({ reinterpret_cast<const char*>(&value), sizeof value }))
    {
      T ofRank = value;
      std::memcpy(static_cast<void*>(&ofRank), bytes.data(), sizeof ofRank);
      values.push_back(ofRank);
    }
    return values;
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
};

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

} // namespace pointhaptics
