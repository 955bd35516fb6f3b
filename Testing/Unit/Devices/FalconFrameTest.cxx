#include "Devices/Falcon/FalconFrame.h"

#include "FalconReplies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

using namespace pointhaptics;
using trial::encode;

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

struct Found
{
  std::size_t end; ///< The place of its last byte.
  FalconReply reply;
};

bool isBetween(int byte, int low, int high)
{
  return byte >= low && byte <= high;
}

/// The frames in all of @p bytes, by looking at every place for one, from the protocol's own words.
std::vector<Found> scanned(const std::vector<std::uint8_t>& bytes)
{
  std::vector<Found> result;
  for (std::size_t begin = 0; begin + 16 <= bytes.size(); ++begin)
  {
    const std::uint8_t* const b = bytes.data() + begin;
    bool whole = b[0] == '<' && b[15] == '>' && b[14] != '<' && isBetween(b[13], 0x41, 0xc0);
    int words[3] = { 0, 0, 0 };
    for (int digit = 11; digit >= 0; --digit)
    {
      whole = whole && isBetween(b[1 + digit], 'A', 'P');
      words[digit / 4] = 16 * words[digit / 4] + b[1 + digit] - 'A';
    }
    if (whole)
    {
      FalconReply reply;
      for (std::size_t leg = 0; leg < 3; ++leg)
      {
        reply.encoders[leg] = std::int16_t(words[leg] < 32768 ? words[leg] : words[leg] - 65536);
      }
      reply.buttons = std::uint8_t((b[13] - 'A') % 16);
      reply.homed = std::uint8_t((b[13] - 'A') / 16);
      result.push_back({ begin + 15, reply });
    }
  }
  return result;
}

/// Frames, any bytes between them, some cut, doubled, or with a byte that is another; then pieces of any
/// length that have changed their places. The last bytes end what has begun.
std::vector<std::uint8_t> damagedStream(std::mt19937_64& random)
{
  std::vector<std::uint8_t> stream;
  for (int i = 0; i < 200; ++i)
  {
    FalconFrame frame = encode(randomReply(random));
    frame[14] = random() % 4 ? frame[14] : std::uint8_t(random());
    std::size_t size = frame.size();
    int times = 1;
    switch (random() % 8)
    {
      case 0:
        size = random() % size;
        break;
      case 1:
        frame[random() % size] = std::uint8_t(random());
        break;
      case 2:
        std::swap(frame[random() % size], frame[random() % size]);
        break;
      case 3:
        times = 2;
        break;
      case 4:
        for (std::size_t k = random() % 40; k > 0; --k)
        {
          stream.push_back(random() % 8 ? std::uint8_t(random()) : '<');
        }
        break;
      default:
        break;
    }
    for (; times > 0; --times)
    {
      stream.insert(stream.end(), frame.begin(), frame.begin() + std::ptrdiff_t(size));
    }
  }
  for (int k = 0; k < 20; ++k)
  {
    // [a, b) and [b, c) change their places.
    std::size_t places[3] = { random() % stream.size(), random() % stream.size(), random() % stream.size() };
    std::sort(places, places + 3);
    std::rotate(stream.begin() + std::ptrdiff_t(places[0]), stream.begin() + std::ptrdiff_t(places[1]),
      stream.begin() + std::ptrdiff_t(places[2]));
  }
  stream.insert(stream.end(), 2, 0); // one alone may stand before the last place
  return stream;
}
}

TEST(FalconFrame, IsTheMessageOfTheProtocol)
{
  // 0x1234 and -2 as nibbles, least significant first, each above 'A'.
  const FalconCommand command{ { 0x1234, -2, 0 }, kFalconHomingBit | kFalconLedRed };
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

TEST(FalconFrameFinder, FindsExactlyTheFramesThatAPlainScanFinds)
{
  std::mt19937_64 random(13);
  std::size_t frames = 0;
  std::uint64_t dropped = 0;
  for (int trial = 0; trial < 400; ++trial)
  {
    const std::vector<std::uint8_t> bytes = damagedStream(random);
    FalconFrameFinder finder;
    std::vector<Found> taken;
    for (std::size_t i = 0; i < bytes.size(); ++i)
    {
      FalconReply reply;
      if (finder.take(bytes[i]))
      {
        ASSERT_TRUE(decode(finder.frame(), reply));
        taken.push_back({ i, reply });
      }
    }
    const std::vector<Found> expected = scanned(bytes);
    ASSERT_EQ(taken.size(), expected.size()) << trial;
    for (std::size_t k = 0; k < taken.size(); ++k)
    {
      ASSERT_EQ(taken[k].end, expected[k].end) << trial;
      ASSERT_TRUE(same(taken[k].reply, expected[k].reply)) << trial;
    }
    ASSERT_EQ(finder.droppedBytes(), bytes.size() - kFalconFrameSize * taken.size()) << trial;
    frames += taken.size();
    dropped += finder.droppedBytes();
  }
  EXPECT_GT(frames, 30000u);
  EXPECT_GT(dropped, 300000u);
}
