#include "SharedReading.h"

#include "FileProblem.h"

#include <utility>

namespace pointhaptics::io
{

namespace
{

/// Header of each message.
struct Preface
{
  std::uint64_t bytes = 0;  ///< Size of the file.
  std::uint64_t failed = 0; ///< 1: there is no more to come.
};

} // namespace

RowRange SharedReading::rowsOf(std::uint64_t all) const
{
  const auto size = static_cast<std::uint64_t>(ranks_.size());
  const auto rank = static_cast<std::uint64_t>(ranks_.rank());
  // Without a product that could overflow.
  const auto end = [&](std::uint64_t r) { return all / size * r + all % size * r / size; };
  return { end(rank), end(rank + 1) };
}

std::vector<std::string> SharedReading::exchange(std::vector<std::string> messages)
{
  for (std::string& message : messages)
  {
    message.insert(0, bytesOfValues(std::vector<Preface>{ { bytes_, 0 } }));
  }
  messages = ranks_.exchange(std::move(messages));
  bool hasFailed = false;
  bool isSame = true;
  for (std::string& message : messages)
  {
    const Preface preface = valuesOfBytes<Preface>(message.substr(0, sizeof(Preface))).at(0);
    hasFailed = hasFailed || preface.failed != 0;
    isSame = isSame && preface.bytes == bytes_;
    message.erase(0, sizeof(Preface));
  }
  isOver_ = hasFailed || !isSame;
  if (hasFailed)
  {
    throw OtherRankFailed();
  }
  failFormatIf(!isSame, "give all ranks the same file",
    "the file has {} bytes here and another size on another rank", bytes_);
  return messages;
}

void SharedReading::fail()
{
  if (!isOver_)
  {
    isOver_ = true;
    ranks_.gather(bytesOfValues(std::vector<Preface>{ { bytes_, 1 } }));
  }
}

} // namespace pointhaptics::io
