#include "Devices/Falcon/FalconFrame.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace pointhaptics;

namespace
{
bool same(const FalconReply& a, const FalconReply& b)
{
  return a.encoders == b.encoders && a.buttons == b.buttons && a.homed == b.homed;
}

FalconReply randomReply(std::mt19937_64& random)
{
  FalconReply reply;
  for (std::int16_t& encoder : reply.encoders)
  {
    encoder = std::int16_t(random());
  }
  reply.buttons = random() & 15;
  reply.homed = random() & 7;
  return reply;
}

std::vector<FalconReply> found(const std::vector<std::uint8_t>& bytes, FalconFrameFinder& finder)
{
  std::vector<FalconReply> replies;
  for (std::uint8_t byte : bytes)
  {
    FalconReply reply;
    if (finder.take(byte))
    {
      EXPECT_TRUE(decode(finder.frame(), reply));
      replies.push_back(reply);
    }
  }
  return replies;
}
}

TEST(FalconFrame, IsTheMessageOfTheProtocol)
{
  // 0x1234 and -2 as nibbles, least significant first, each above 'A'.
  const FalconCommand command{ { 0x1234, -2, 0 }, kFalconHomingBit | kFalconLampRed };
  const FalconFrame expected = { '<', 'A' + 4, 'A' + 3, 'A' + 2, 'A' + 1, 'A' + 14, 'A' + 15, 'A' + 15,
    'A' + 15, 'A', 'A', 'A', 'A', 'A' + 9, 'A', '>' };
  EXPECT_EQ(encode(command), expected);
}

TEST(FalconFrame, CarriesEveryEncoderValueButtonAndHomingBit)
{
  for (int value = -32768; value <= 32767; ++value)
  {
    FalconReply reply;
    reply.encoders = { std::int16_t(value), std::int16_t(-1 - value), std::int16_t(value / 2) };
    reply.buttons = value & 15;
    reply.homed = value & 7;
    FalconReply read;
    ASSERT_TRUE(decode(encode(reply), read));
    ASSERT_TRUE(same(read, reply)) << value;
  }
}

TEST(FalconFrame, RefusesEveryDamagedByte)
{
  std::mt19937_64 random(3);
  const FalconReply original = randomReply(random);
  for (std::size_t place = 0; place < kFalconFrameSize; ++place)
  {
    for (int byte = 0; byte < 256; ++byte)
    {
      FalconFrame frame = encode(original);
      frame[place] = std::uint8_t(byte);
      FalconReply reply = original;
      const bool nibble = place >= 1 && place <= 12 && byte >= 'A' && byte <= 'A' + 15;
      const bool flags = place == 13 && byte >= 'A' && byte <= 'A' + 127;
      const bool unknown = place == 14 && byte != '<';
      const bool mark = (place == 0 && byte == '<') || (place == 15 && byte == '>');
      EXPECT_EQ(decode(frame, reply), nibble || flags || unknown || mark) << place << " " << byte;
    }
  }
}

TEST(FalconFrameFinder, FindsAFrameAfterAnyGarbage)
{
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 2000; ++trial)
  {
    FalconFrameFinder finder;
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = random() % 40; i > 0; --i)
    {
      bytes.push_back(random() % 4 ? std::uint8_t(random()) : '<');
    }
    found(bytes, finder);
    // What was garbage may have swallowed nothing but itself: a '<' always begins anew.
    const FalconReply reply = randomReply(random);
    const FalconFrame frame = encode(reply);
    const std::vector<FalconReply> replies = found({ frame.begin(), frame.end() }, finder);
    ASSERT_EQ(replies.size(), 1u);
    EXPECT_TRUE(same(replies[0], reply));
  }
}

TEST(FalconFrameFinder, LosesOnlyFramesThatWereCutReorderedOrDamaged)
{
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 500; ++trial)
  {
    FalconFrameFinder finder;
    std::vector<std::uint8_t> bytes;
    std::vector<FalconReply> whole;
    std::uint64_t damaged = 0;
    for (int i = 0; i < 20; ++i)
    {
      const FalconReply reply = randomReply(random);
      const FalconFrame frame = encode(reply);
      std::vector<std::uint8_t> piece(frame.begin(), frame.end());
      switch (random() % 6)
      {
        case 0: // Cut short, at least the last byte.
          piece.resize(random() % (kFalconFrameSize - 1));
          damaged += piece.size();
          break;
        case 1: // Two different bytes of the head and the middle swapped: no frame any more.
          std::swap(piece[0], piece[1 + random() % 12]);
          damaged += piece.size();
          break;
        case 2: // Doubled.
          piece.insert(piece.end(), frame.begin(), frame.end());
          whole.push_back(reply);
          whole.push_back(reply);
          break;
        default:
          whole.push_back(reply);
      }
      bytes.insert(bytes.end(), piece.begin(), piece.end());
    }
    const FalconFrame last = encode(FalconReply());
    bytes.insert(bytes.end(), last.begin(), last.end());
    whole.push_back(FalconReply());
    const std::vector<FalconReply> replies = found(bytes, finder);
    ASSERT_EQ(replies.size(), whole.size()) << trial;
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
      EXPECT_TRUE(same(replies[i], whole[i]));
    }
    EXPECT_EQ(finder.droppedBytes(), damaged);
  }
}

TEST(FalconFrameFinder, NeverTakesRandomBytesForWhatTheyAreNot)
{
  // Every frame it reports decodes: 5 million random bytes, marks made frequent.
  std::mt19937_64 random(13);
  FalconFrameFinder finder;
  int frames = 0;
  const std::uint8_t alphabet[] = { '<', '>', 'A', 'B', 'P', 'Q', 0, 255 };
  for (int i = 0; i < 5000000; ++i)
  {
    const std::uint64_t word = random();
    if (finder.take(i % 16 == 0 ? '<' : i % 16 == 15 ? '>' : alphabet[word % 64 < 62 ? 2 + word % 3 : 6]))
    {
      FalconReply reply;
      ASSERT_TRUE(decode(finder.frame(), reply));
      ++frames;
    }
  }
  EXPECT_GT(frames, 10000);
}
