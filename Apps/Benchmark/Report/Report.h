/// @file
/// What a benchmark found: for the terminal, as JSON, or as a section of a Markdown page with pictures.
#pragma once

#include "Benchmark/Harness/Machine.h"
#include "Benchmark/Report/Chart.h"
#include "Benchmark/Report/Table.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{

/// Told what is being measured, from time to time.
using Progress = std::function<void(const std::string&)>;

/// The page of the documentation that a part belongs to.
enum class Page
{
  Performance, ///< Times: Performance.md.
  Accuracy,    ///< Errors, and what they cost in time: Accuracy.md.
};

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
  Page page = Page::Performance;
};

struct Report
{
  std::string task;           ///< As on the command line: "resample".
  std::string title;          ///< Heading of the sections.
  std::string command;        ///< Repeats it.
  std::string method;         ///< Markdown paragraph on what holds for all parts of Performance.md.
  std::string accuracyMethod; ///< The same for Accuracy.md.
  Machine machine;
  std::vector<ReportPart> parts;
};

std::string toText(const Report& report);
nlohmann::ordered_json toJson(const Report& report);
/// The section of @p page, whose pictures lie in @p imageFolder relative to the page; empty: without
/// pictures. Empty where no part belongs to the page.
std::string toMarkdown(const Report& report, Page page, const std::string& imageFolder);

/// @p content of @p page with the section of @p task replaced by @p section, or with it at the end. The
/// section stands between two comments that name the task; an empty page gets its head first.
std::string withSection(
  const std::string& content, Page page, const std::string& task, const std::string& section);

/// Writes the section and the summary's rows of each page that has parts into FOLDER/Performance.md and
/// FOLDER/Accuracy.md, and where @p withPictures the charts into FOLDER/Images/*.png; makes the folders.
/// False: @p message says what failed.
bool writeReport(const Report& report, const std::string& folder, bool withPictures, std::string& message);

} // namespace bench
} // namespace pointhaptics
