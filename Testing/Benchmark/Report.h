/// @file
/// What a benchmark found: for the terminal, as JSON, or as a section of a Markdown page with pictures.
#pragma once

#include "Benchmark/Chart.h"
#include "Benchmark/Machine.h"
#include "Benchmark/Table.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{

/// One question and its answer.
struct ReportPart
{
  std::string key;   ///< In JSON.
  std::string title; ///< Sentence case, no full stop.
  std::string text;  ///< How it was measured; Markdown, one paragraph.
  Table table;
  nlohmann::ordered_json rows = nlohmann::ordered_json::array(); ///< The same as numbers.
  std::vector<std::string> remarks; ///< What the reader must know: faults of rivals, what was left out.
  std::vector<Chart> charts;
};

struct Report
{
  std::string task;    ///< As on the command line: "resample".
  std::string title;   ///< Heading of the section.
  std::string command; ///< Repeats it.
  std::string method;  ///< Markdown paragraph on what holds for all parts.
  Machine machine;
  std::vector<ReportPart> parts;
};

std::string toText(const Report& report);
nlohmann::ordered_json toJson(const Report& report);
/// The section, whose pictures lie in @p imageFolder relative to the page; empty: without pictures.
std::string toMarkdown(const Report& report, const std::string& imageFolder);

/// @p page with the section of @p task replaced by @p section, or with it at the end. The section stands
/// between two comments that name the task; an empty page gets a heading first.
std::string withSection(const std::string& page, const std::string& task, const std::string& section);

/// Writes FOLDER/Performance.md and, where @p withPictures, FOLDER/Images/*.png; makes the folders. False:
/// @p message says what failed.
bool writeReport(const Report& report, const std::string& folder, bool withPictures, std::string& message);

} // namespace bench
} // namespace pointhaptics
