#include "IO/Las/Laz/SymbolModel.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

constexpr std::uint32_t kUnit = 0x80000000u; ///< probability 1 before it is scaled down
constexpr std::uint32_t kMostCounted = 1u << SymbolModel::kProbabilityBits;
constexpr std::uint32_t kMostBitsCounted = 1u << BitModel::kProbabilityBits;
constexpr std::uint32_t kMostBitCycle = 64;

} // namespace

void SymbolModel::start()
{
  std::uint32_t entries = 0;
  if (size_ > kMostWithoutTable)
  {
    unsigned bits = 3;
    while (size_ > 1u << (bits + 2))
    {
      ++bits;
    }
    entries = (1u << bits) + 2;
    tableShift_ = static_cast<std::uint8_t>(kProbabilityBits - bits);
  }
  memory_.reset(new std::uint16_t[2u * size_ + entries]);
  below_ = memory_.get();
  counts_ = below_ + size_;
  table_ = counts_ + size_;
  std::fill_n(counts_, size_, std::uint16_t{ 1 });
  cycle_ = size_;
  update();
  cycle_ = untilUpdate_ = (size_ + 6u) >> 1;
}

void SymbolModel::update()
{
  total_ += cycle_;
  if (total_ > kMostCounted)
  {
    total_ = 0;
    for (unsigned i = 0; i < size_; ++i)
    {
      counts_[i] = static_cast<std::uint16_t>((counts_[i] + 1u) >> 1);
      total_ += counts_[i];
    }
  }
  const std::uint32_t scale = kUnit / total_;
  std::uint32_t sum = 0;
  std::uint32_t entry = 0;
  for (unsigned i = 0; i < size_; ++i)
  {
    below_[i] = static_cast<std::uint16_t>((scale * sum) >> (31 - kProbabilityBits));
    sum += counts_[i];
    for (const std::uint32_t last = hasTable() ? below_[i] >> tableShift_ : 0u; entry < last;)
    {
      table_[++entry] = static_cast<std::uint16_t>(i - 1);
    }
  }
  if (hasTable())
  {
    table_[0] = 0;
    for (const std::uint32_t last = (1u << (kProbabilityBits - tableShift_)) + 1; entry < last;)
    {
      table_[++entry] = static_cast<std::uint16_t>(size_ - 1);
    }
  }
  cycle_ = std::min(5 * cycle_ >> 2, (size_ + 6u) << 3);
  untilUpdate_ = cycle_;
}

void BitModel::update()
{
  total_ += cycle_;
  if (total_ > kMostBitsCounted)
  {
    total_ = (total_ + 1) >> 1;
    zeros_ = (zeros_ + 1) >> 1;
    total_ += zeros_ == total_ ? 1 : 0;
  }
  zeroProbability_ = (zeros_ * (kUnit / total_)) >> (31 - kProbabilityBits);
  cycle_ = std::min(5 * cycle_ >> 2, kMostBitCycle);
  untilUpdate_ = cycle_;
}

} // namespace pointhaptics::io
