#include "Benchmark/Report/Table.h"

#include <gtest/gtest.h>

using namespace pointhaptics::bench;

TEST(Table, TextLinesUpNumbersToTheRightAndWordsToTheLeft)
{
  const Table table{ { "name", "ms" }, { { "a", "1.5" }, { "longer", "10.25" } } };
  EXPECT_EQ(toText(table),
    "name       ms\n"
    "a         1.5\n"
    "longer  10.25\n");
}

TEST(Table, MarkdownHasARowPerRow)
{
  const Table table{ { "name", "ms" }, { { "a", "1.5" }, { "b" } } };
  EXPECT_EQ(toMarkdown(table), "| name | ms |\n|---|---:|\n| a | 1.5 |\n| b |  |\n");
}

TEST(Table, GroupsDigitsByThree)
{
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(-1234567), "-1,234,567");
  EXPECT_EQ(grouped(-123), "-123");
}

TEST(Table, BriefNumbersKeepThreeDigits)
{
  EXPECT_EQ(brief(0.0), "0");
  EXPECT_EQ(brief(0.01234), "0.0123");
  EXPECT_EQ(brief(1.2345), "1.23");
  EXPECT_EQ(brief(12.345), "12.3");
  EXPECT_EQ(brief(123.45), "123");
  EXPECT_EQ(brief(12345.0), "12345");
  EXPECT_EQ(brief(1.5e-9), "1.50e-09");
  EXPECT_EQ(brief(2.5e7), "2.50e+07");
}
