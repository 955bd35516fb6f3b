#include "Benchmark/Report/PageSummary.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

using namespace pointhaptics::bench;

namespace
{

const Table kTimes = { { "who", "points", "ms" },
  { { "ours", "1,000", "2.5" }, { "theirs", "1,000", "10" }, { "ours", "20,000", "9" } } };

/// The parts that a summary quotes, as the documents call them.
const std::map<std::string, std::string> kParts = { { "Against points, order and threads", "points" },
  { "Zooming: only the workspace changed", "zoom" },
  { "The update's time against the size of the cloud", "size" }, { "Reading", "read" },
  { "Bandwidth and radius of every point, beside loops over other libraries' searches", "search" },
  { "From the cloud to the first touch", "touch" }, { "Step time, jitter and deadline misses", "loop" },
  { "Turning the camera", "turning" }, { "From a key to the hand", "response" },
  { "Time to the first picture, and memory", "first_picture" }, { "The default on every shape", "shapes" },
  { "Every method and setting", "methods" }, { "Real scans", "scans" },
  { "Ratio of the force along the surface to that across it", "ratio" },
  { "Size of the neighbourhood: k nearest against a ball", "settling" },
  { "Where the density's Gaussian kernel is cut off", "truncation" },
  { "Scans and machined parts beside their own meshes", "scans" },
  { "Over the edge and the corner of a box", "edges" },
  { "Thin plates, holes, slots, ridges, wedges and a density jump", "thin" } };

std::string contentOf(const std::string& name)
{
  std::ifstream stream(std::string(POINTHAPTICS_DOCUMENTATION) + "/" + name);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

std::vector<std::string> cellsOf(const std::string& line)
{
  std::vector<std::string> cells;
  std::size_t begin = line.find("| ") + 2;
  for (std::size_t end = line.find(" |", begin); end != std::string::npos; end = line.find(" |", begin))
  {
    cells.push_back(line.substr(begin, end - begin));
    begin = end + 3;
    // An empty cell is two blanks.
    if (begin <= line.size() && begin >= 1 && line.compare(begin - 1, 2, " |") == 0)
    {
      --begin;
    }
  }
  return cells;
}

/// The reports that a page was written from, as far as a summary reads them.
std::vector<Report> reportsIn(const std::string& page)
{
  std::vector<Report> reports;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);)
  {
    const bool isTask = line.rfind("<!-- bench ", 0) == 0 && line.find(": begin") != std::string::npos;
    if (isTask)
    {
      reports.emplace_back();
      reports.back().task = line.substr(11, line.find(':') - 11);
    }
    else if (!reports.empty() && line.rfind("## ", 0) == 0)
    {
      reports.back().title = line.substr(3);
    }
    else if (!reports.empty() && line.rfind("### ", 0) == 0)
    {
      reports.back().parts.emplace_back();
      const auto part = kParts.find(line.substr(4));
      reports.back().parts.back().key = part == kParts.end() ? line.substr(4) : part->second;
    }
    else if (!reports.empty() && !reports.back().parts.empty() && line.rfind("| ", 0) == 0)
    {
      Table& table = reports.back().parts.back().table;
      (table.header.empty() ? table.header : table.rows.emplace_back()) = cellsOf(line);
    }
  }
  return reports;
}

/// @p page as its own tables have it.
std::string summarized(std::string page, Page kind)
{
  for (const Report& report : reportsIn(page))
  {
    if (report.task != "summary")
    {
      page = withSummary(page, report.title, summaryOf(report, kind));
    }
  }
  return page;
}

std::string summaryIn(const std::string& page)
{
  const std::size_t begin = page.find("<!-- bench summary: begin -->");
  const std::size_t end = page.find("<!-- bench summary: end -->");
  return begin == std::string::npos ? "" : page.substr(begin, end - begin);
}

} // namespace

TEST(TableRows, QuotesTheCellsOfTheRowsThatMatch)
{
  const TableRows ours = TableRows(kTimes).where("who", "ours");
  EXPECT_EQ(ours.last("ms"), "9");
  EXPECT_EQ(ours.sum("points"), "21,000");
  EXPECT_EQ(ours.range("points"), (std::pair<std::string, std::string>("1,000", "20,000")));
  EXPECT_EQ(TableRows(kTimes).whereNot("who", "ours").last("ms"), "10");
  EXPECT_EQ(rangeText(TableRows(kTimes).range("ms")), "2.5 to 10");
  EXPECT_EQ(rangeText({ "1", "1" }), "1");
}

TEST(TableRows, HasNothingToQuoteWithoutRowsOrColumn)
{
  const TableRows nobody = TableRows(kTimes).where("who", "nobody");
  EXPECT_EQ(nobody.last("ms"), "");
  EXPECT_EQ(nobody.sum("points"), "");
  EXPECT_EQ(nobody.range("points").first, "");
  EXPECT_EQ(TableRows(kTimes).last("hours"), "");
  EXPECT_EQ(TableRows(kTimes).where("hours", "9").last("ms"), "");
}

TEST(Summary, StandsBeforeTheFirstSectionAndReplacesItsOwnRows)
{
  const std::string page = withSection("", Page::Accuracy, "a", "## The first\n");
  const std::string once =
    withSummary(page, "The first", { { "How far?", "1 mm" }, { "How near?", "2 mm" } });
  EXPECT_LT(once.find("| How far? | 1 mm | [The first](#the-first) |"), once.find("<!-- bench a: begin -->"));
  const std::string twice = withSummary(once, "Next, then", { { "How long?", "3 s" } });
  EXPECT_LT(twice.find("How near?"), twice.find("| How long? | 3 s | [Next, then](#next-then) |"));
  const std::string again = withSummary(twice, "The first", { { "How far?", "4 mm" } });
  EXPECT_LT(again.find("4 mm"), again.find("3 s"));
  EXPECT_EQ(again.find("2 mm"), std::string::npos);
  EXPECT_EQ(withSummary(again, "The first", { { "How far?", "4 mm" } }), again);
  EXPECT_EQ(withSummary(page, "The first", {}), page);
}

TEST(Summary, LeavesOutWhatARunDidNotMeasure)
{
  Report report;
  report.task = "io";
  report.parts.emplace_back();
  report.parts.back().key = "read";
  report.parts.back().table = { { "file", "MB", "contestant", "median ms", "x ours" },
    { { "PLY binary", "10", "ours", "4", "1.00" } } };
  EXPECT_TRUE(summaryOf(report, Page::Performance).empty());
}

TEST(Summary, TellsOfHandsThatGoThroughAPlateWhereTheRunHasThem)
{
  Report report;
  report.task = "touch";
  report.parts.emplace_back();
  report.parts.back().key = "thin";
  Table& table = report.parts.back().table;
  table = { { "part", "method", "lost %", "pops", "strokes" },
    { { "plate 0.6 mm", "surface-fit", "0", "0", "60" },
      { "plate 0.6 mm", "gradient-steps-tuned", "2.42", "14", "60" } } };
  EXPECT_TRUE(summaryOf(report, Page::Accuracy).empty());
  table.rows.push_back({ "through plate 0.6 mm", "surface-fit", "0", "1", "60" });
  table.rows.push_back({ "through plate 0.6 mm", "gradient-steps-tuned", "9", "20", "60" });
  ASSERT_EQ(summaryOf(report, Page::Accuracy).size(), 1u);
  EXPECT_EQ(summaryOf(report, Page::Accuracy)[0].answer, "1 of 60; the paper's method 20");
}

TEST(Summary, HasAtMostTenRowsOnAPage)
{
  EXPECT_LE(numberOfSummaryRows(Page::Performance), kMostSummaryRows);
  EXPECT_LE(numberOfSummaryRows(Page::Accuracy), kMostSummaryRows);
}

TEST(Report, HeadsOfNewPagesAreThoseOfTheDocuments)
{
  for (const auto& [kind, name] :
    { std::pair(Page::Performance, "Performance.md"), { Page::Accuracy, "Accuracy.md" } })
  {
    const std::string fresh = withSection("", kind, "a", "one");
    const std::string head = fresh.substr(0, fresh.find("<!-- bench "));
    EXPECT_EQ(contentOf(name).substr(0, head.size()), head);
  }
}

TEST(Summary, OfTheDocumentsQuotesTheirTables)
{
  const std::string performance = contentOf("Performance.md");
  EXPECT_EQ(summaryIn(performance), summaryIn(summarized(performance, Page::Performance)));
  const std::string accuracy = contentOf("Accuracy.md");
  EXPECT_EQ(summaryIn(accuracy), summaryIn(summarized(accuracy, Page::Accuracy)));
}
