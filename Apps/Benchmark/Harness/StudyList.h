/// @file
/// A task of `pointhaptics bench` is a list of studies; each asks one question and gives one part of the
/// report.
#pragma once

#include "Benchmark/Report/Report.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{

template <class Context>
struct Study
{
  const char* word; ///< On the command line, and the part's key in JSON.
  /// A part with neither rows nor charts is left out of the report: there was nothing to measure with.
  ReportPart (*run)(Context&);
  /// Runs before all others, wherever it stands in the report: its children must come from a process without
  /// threads, and loops leave threads behind.
  bool needsNoThreads = false;
};

template <class Context, std::size_t Count>
std::vector<std::string> wordsOf(const Study<Context> (&studies)[Count])
{
  std::vector<std::string> words;
  std::transform(std::begin(studies), std::end(studies), std::back_inserter(words),
    [](const Study<Context>& study) { return std::string(study.word); });
  return words;
}

/// The parts of the studies whose words are among @p wanted, all where that is empty, in the list's order.
template <class Context, std::size_t Count>
std::vector<ReportPart> runStudies(
  const Study<Context> (&studies)[Count], const std::vector<std::string>& wanted, Context& context)
{
  std::vector<ReportPart> parts(Count);
  for (const bool needsNoThreads : { true, false })
  {
    for (std::size_t i = 0; i < Count; ++i)
    {
      const bool isWanted =
        wanted.empty() || std::find(wanted.begin(), wanted.end(), studies[i].word) != wanted.end();
      if (isWanted && studies[i].needsNoThreads == needsNoThreads)
      {
        parts[i] = studies[i].run(context);
        parts[i].key = studies[i].word;
      }
    }
  }
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                [](const ReportPart& part) { return part.table.rows.empty() && part.charts.empty(); }),
    parts.end());
  return parts;
}

} // namespace bench
} // namespace pointhaptics
