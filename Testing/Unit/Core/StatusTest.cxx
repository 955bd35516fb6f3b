#include "Core/Status.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

using namespace pointhaptics;

TEST(Status, HasAnOwnSentenceForEveryValue)
{
  std::set<std::string> sentences;
  for (int value = 0; value <= int(Status::RateNotSupported); ++value)
  {
    const char* text = sentence(Status(value));
    ASSERT_NE(text, nullptr) << value;
    EXPECT_FALSE(std::string(text).empty()) << value;
    EXPECT_TRUE(sentences.insert(text).second) << value << " repeats: " << text;
  }
}

TEST(Status, SentenceOfAnUnknownValueIsNotNull)
{
  EXPECT_NE(sentence(Status(12345)), nullptr);
}
