#include "Core/Base/Status.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

using namespace pointhaptics;

TEST(Status, HasAnOwnSentenceForEveryValue)
{
  std::set<std::string> sentences;
  for (int value = 0; value <= int(Status::PointsTooFar); ++value)
  {
    const char* text = message(Status(value));
    ASSERT_NE(text, nullptr) << value;
    EXPECT_FALSE(std::string(text).empty()) << value;
    EXPECT_TRUE(sentences.insert(text).second) << value << " repeats: " << text;
  }
}

TEST(Status, SentencesKnowNoProgram)
{
  for (int value = 0; value <= int(Status::PointsTooFar); ++value)
  {
    EXPECT_EQ(std::string(message(Status(value))).find("--"), std::string::npos)
      << "an option of a program in: " << message(Status(value));
  }
}

TEST(Status, SentenceOfAnUnknownValueSaysSo)
{
  EXPECT_STREQ(message(Status(12345)), "unknown status");
}
