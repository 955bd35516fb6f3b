/// @file
/// Which figures of a task's tables stand in the summary of its page.
#pragma once

#include "Benchmark/Report/Report.h"
#include "Benchmark/Report/Summary.h"

#include <vector>

namespace pointhaptics
{
namespace bench
{

/// The rows of @p report in the summary of @p page; without those whose part or cells it does not have.
std::vector<SummaryRow> summaryOf(const Report& report, Page page);

/// How many rows the summary of @p page has once every task has run: at most kMostSummaryRows.
std::size_t numberOfSummaryRows(Page page);

} // namespace bench
} // namespace pointhaptics
