#include "Benchmark/Report/Report.h"

#include <gtest/gtest.h>

using namespace pointhaptics::bench;

namespace
{

Report smallReport()
{
  Report report;
  report.task = "nothing";
  report.title = "Doing nothing";
  report.command = "pointhaptics bench nothing";
  report.method = "Waited.";
  ReportPart part;
  part.key = "waiting";
  part.title = "Waiting";
  part.text = "For a while.";
  part.table = { { "who", "ms" }, { { "ours", "1" } } };
  part.rows.push_back({ { "who", "ours" }, { "ms", 1 } });
  part.remarks = { "It rained" };
  Chart chart;
  chart.fileName = "waiting";
  chart.title = "Waiting";
  part.charts.push_back(chart);
  report.parts.push_back(part);
  return report;
}

} // namespace

TEST(Report, JsonHasTheRowsOfEachPart)
{
  const nlohmann::ordered_json json = toJson(smallReport());
  EXPECT_EQ(json["task"], "nothing");
  EXPECT_EQ(json["waiting"]["rows"][0]["ms"], 1);
  EXPECT_EQ(json["waiting"]["remarks"][0], "It rained");
  EXPECT_TRUE(json["machine"].contains("processor"));
}

TEST(Report, MarkdownNamesTheCommandAndThePictures)
{
  const std::string text = toMarkdown(smallReport(), Page::Performance, "Images");
  EXPECT_EQ(text.rfind("## Doing nothing\n\n    pointhaptics bench nothing\n", 0), 0u);
  EXPECT_NE(text.find("| ours | 1 |"), std::string::npos);
  EXPECT_NE(text.find("- It rained\n"), std::string::npos);
  EXPECT_NE(text.find("![Waiting](Images/waiting.png)"), std::string::npos);
  EXPECT_EQ(toMarkdown(smallReport(), Page::Performance, "").find("!["), std::string::npos);
}

TEST(Report, ASectionReplacesItselfAndLeavesTheOthers)
{
  std::string page = withSection("", Page::Performance, "a", "one");
  EXPECT_EQ(page.rfind("# Performance\n", 0), 0u);
  page = withSection(page, Page::Performance, "b", "two");
  const std::string again = withSection(page, Page::Performance, "a", "three");
  EXPECT_EQ(again.find("one"), std::string::npos);
  EXPECT_LT(again.find("three"), again.find("two"));
  EXPECT_EQ(withSection(again, Page::Performance, "a", "one"), page);
}

TEST(Report, APageHoldsItsOwnPartsOnly)
{
  Report report = smallReport();
  report.accuracyMethod = "Compared.";
  EXPECT_EQ(toMarkdown(report, Page::Accuracy, ""), "");
  report.parts.push_back(report.parts.front());
  report.parts.back().title = "Being wrong";
  report.parts.back().page = Page::Accuracy;
  const std::string times = toMarkdown(report, Page::Performance, "");
  const std::string errors = toMarkdown(report, Page::Accuracy, "");
  EXPECT_NE(times.find("### Waiting"), std::string::npos);
  EXPECT_EQ(times.find("### Being wrong"), std::string::npos);
  EXPECT_EQ(errors.find("### Waiting"), std::string::npos);
  EXPECT_NE(errors.find("### Being wrong"), std::string::npos);
  EXPECT_NE(errors.find("Compared."), std::string::npos);
  EXPECT_EQ(errors.find("Waited."), std::string::npos);
  EXPECT_EQ(withSection("", Page::Accuracy, "nothing", errors).rfind("# Accuracy\n", 0), 0u);
}
