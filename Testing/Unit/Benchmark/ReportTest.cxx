#include "Benchmark/Report.h"

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
  const std::string text = toMarkdown(smallReport(), "Images");
  EXPECT_EQ(text.rfind("## Doing nothing\n\n    pointhaptics bench nothing\n", 0), 0u);
  EXPECT_NE(text.find("| ours | 1 |"), std::string::npos);
  EXPECT_NE(text.find("- It rained\n"), std::string::npos);
  EXPECT_NE(text.find("![Waiting](Images/waiting.png)"), std::string::npos);
  EXPECT_EQ(toMarkdown(smallReport(), "").find("!["), std::string::npos);
}

TEST(Report, ASectionReplacesItselfAndLeavesTheOthers)
{
  std::string page = withSection("", "a", "one");
  EXPECT_EQ(page.rfind("# Performance\n", 0), 0u);
  page = withSection(page, "b", "two");
  const std::string again = withSection(page, "a", "three");
  EXPECT_EQ(again.find("one"), std::string::npos);
  EXPECT_LT(again.find("three"), again.find("two"));
  EXPECT_EQ(withSection(again, "a", "one"), page);
}
