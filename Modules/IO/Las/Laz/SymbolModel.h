/// @file
/// The adaptive models of LAZ's arithmetic coder: how likely each symbol is, learned from those before.
/// Source: A. Said, Introduction to Arithmetic Coding (HPL-2004-76), with the constants of LASzip: 15 bits of
/// probability for symbols, 13 for bits. Decoder and encoder share them: both sides learn the same.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace pointhaptics::io
{

/// Symbols 0..size-1; 2 <= size <= 2048. Costs 4 to 6 bytes a symbol. One thread.
class SymbolModel
{
public:
  static constexpr unsigned kProbabilityBits = 15;
  /// Alphabets up to this size are searched without a table.
  static constexpr unsigned kMostWithoutTable = 16;

  explicit SymbolModel(unsigned size)
    : size_(static_cast<std::uint16_t>(size))
  {
  }
  /// Takes memory at the first call, with all symbols equally likely: a coder calls it for each symbol.
  void startIfNew() { untilUpdate_ == 0 ? start() : void(); }

  unsigned lastSymbol() const { return size_ - 1u; }
  bool hasTable() const { return tableShift_ != 0; }
  /// Sum of the probabilities of the symbols before @p symbol.
  std::uint32_t below(unsigned symbol) const { return below_[symbol]; }
  /// The last symbol that may have @p quotient at or above its below(), found by a table and bisection.
  /// @pre hasTable(), quotient < 2^15 + 2^6.
  unsigned find(std::uint32_t quotient) const
  {
    const std::uint32_t entry = quotient >> tableShift_;
    unsigned symbol = table_[entry];
    unsigned end = table_[entry + 1] + 1u;
    while (end > symbol + 1)
    {
      const unsigned middle = (symbol + end) >> 1;
      (below_[middle] > quotient ? end : symbol) = middle;
    }
    return symbol;
  }
  void count(unsigned symbol)
  {
    ++counts_[symbol];
    if (--untilUpdate_ == 0)
    {
      update();
    }
  }

private:
  void start();
  void update();

  std::uint16_t* below_ = nullptr;
  std::uint16_t* counts_ = nullptr;
  std::uint16_t* table_ = nullptr;
  std::uint32_t untilUpdate_ = 0; ///< 0: not started
  std::uint32_t cycle_ = 0;
  std::uint32_t total_ = 0;
  std::uint16_t size_ = 0;
  std::uint8_t tableShift_ = 0;
  std::unique_ptr<std::uint16_t[]> memory_;
};

/// Two symbols, with 13 bits of probability and updates of their own.
class BitModel
{
public:
  static constexpr unsigned kProbabilityBits = 13;

  std::uint32_t zeroProbability() const { return zeroProbability_; }
  void count(unsigned bit)
  {
    zeros_ += bit == 0 ? 1u : 0u;
    if (--untilUpdate_ == 0)
    {
      update();
    }
  }

private:
  void update();

  std::uint32_t zeroProbability_ = 1u << (kProbabilityBits - 1);
  std::uint32_t zeros_ = 1;
  std::uint32_t total_ = 2;
  std::uint32_t cycle_ = 4;
  std::uint32_t untilUpdate_ = 4;
};

/// As many models as there are contexts.
class ModelBank
{
public:
  ModelBank(unsigned models, unsigned symbols)
  {
    models_.reserve(models);
    for (unsigned i = 0; i < models; ++i)
    {
      models_.emplace_back(symbols);
    }
  }
  SymbolModel& operator[](unsigned context) { return models_[context]; }

private:
  std::vector<SymbolModel> models_;
};

} // namespace pointhaptics::io
