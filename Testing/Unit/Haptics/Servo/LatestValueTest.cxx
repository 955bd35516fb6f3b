#include "Haptics/Servo/LatestValue.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

using namespace pointhaptics;

namespace
{
/// All members equal, or it was torn.
struct Record
{
  std::uint64_t numbers[25] = {};
  std::uint16_t last = 0; ///< Makes the size no multiple of a word's.
};

Record record(std::uint64_t number)
{
  Record result;
  for (std::uint64_t& entry : result.numbers)
  {
    entry = number;
  }
  result.last = std::uint16_t(number);
  return result;
}

bool whole(const Record& value)
{
  for (std::uint64_t entry : value.numbers)
  {
    if (entry != value.numbers[0])
    {
      return false;
    }
  }
  return value.last == std::uint16_t(value.numbers[0]);
}
}

TEST(LatestValue, StartsWithADefaultValue)
{
  const LatestValue<Record> value;
  EXPECT_EQ(value.read().numbers[7], 0u);
  EXPECT_EQ(value.version(), 0u);
}

TEST(LatestValue, GivesTheNewestWriteAndItsVersion)
{
  LatestValue<Record> value;
  value.write(record(5));
  const std::uint64_t first = value.version();
  value.write(record(6));
  Record read;
  std::uint64_t version = 0;
  ASSERT_TRUE(value.tryRead(read, &version));
  EXPECT_TRUE(whole(read));
  EXPECT_EQ(read.numbers[0], 6u);
  EXPECT_GT(version, first);
  EXPECT_EQ(version, value.version());
}

TEST(LatestValue, NeverGivesATornValueToAnyReader)
{
  constexpr std::uint64_t kWrites = 100000;
  LatestValue<Record> value;
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i)
  {
    readers.emplace_back(
      [&]
      {
        std::uint64_t last = 0;
        while (last < kWrites)
        {
          const Record read = value.read();
          ASSERT_TRUE(whole(read));
          ASSERT_GE(read.numbers[0], last) << "an older value came after a newer one";
          last = read.numbers[0];
        }
      });
  }
  for (std::uint64_t i = 1; i <= kWrites; ++i)
  {
    value.write(record(i));
  }
  for (std::thread& reader : readers)
  {
    reader.join();
  }
}
