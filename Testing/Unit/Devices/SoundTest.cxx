#include "Devices/SimulatedDevice.h"
#include "Devices/Sound/ContactTone.h"
#include "Devices/Sound/SoundOutput.h"
#include "Devices/Sound/SoundPlayer.h"
#include "Devices/Sound/TouchSoundFile.h"
#include "Haptics/ServoLoop.h"

#include "../Eventually.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

using namespace pointhaptics;
using pointhaptics::trial::eventually;

namespace
{

constexpr std::size_t kSecond = static_cast<std::size_t>(ContactTone::kSamplesPerSecond);

void play(ContactTone& tone, const HeardTouch& touch, std::size_t count, std::vector<float>& samples)
{
  samples.resize(samples.size() + count);
  tone.render(touch, samples.data() + samples.size() - count, count);
}

float loudest(const std::vector<float>& samples, std::size_t begin = 0)
{
  float most = 0.0F;
  for (std::size_t i = begin; i < samples.size(); ++i)
  {
    most = std::max(most, std::abs(samples[i]));
  }
  return most;
}

TEST(Sound, IsSilentWithoutContactAndAgainAfterIt)
{
  ContactTone tone;
  std::vector<float> samples;
  play(tone, { 5.0, false }, kSecond, samples);
  EXPECT_EQ(loudest(samples), 0.0F) << "a force without contact is none that one touches";
  play(tone, { 5.0, true }, kSecond, samples);
  EXPECT_GT(loudest(samples), 0.1F);
  const std::size_t released = samples.size();
  play(tone, { 0.0, false }, kSecond, samples);
  EXPECT_GT(loudest(samples, released), 0.0F) << "it fades";
  EXPECT_EQ(loudest(samples, released + kSecond / 20), 0.0F);
}

TEST(Sound, IsAsLoudAsTheForceAndNeverLouderThanItsLimit)
{
  float before = 0.0F;
  for (const double newtons : { 0.1, 0.5, 2.0, 8.0 })
  {
    ContactTone tone;
    std::vector<float> samples;
    play(tone, { newtons, true }, kSecond, samples);
    const float level = loudest(samples, kSecond / 10); // after the click
    EXPECT_NEAR(level, ContactTone::loudnessOf(newtons), 0.01 * level) << newtons;
    EXPECT_GT(level, 1.2F * before) << newtons;
    before = level;
  }
  const double inf = std::numeric_limits<double>::infinity();
  for (const double newtons : { 1e300, inf, -inf, std::nan("") })
  {
    ContactTone tone;
    std::vector<float> samples;
    for (int i = 0; i < 20; ++i)
    {
      play(tone, { newtons, i % 2 == 0 }, kSecond / 7, samples);
    }
    EXPECT_LE(loudest(samples), float(ContactTone::kLoudest)) << newtons;
    EXPECT_TRUE(std::all_of(samples.begin(), samples.end(), [](float s) { return std::isfinite(s); }));
  }
}

TEST(Sound, HasOnePitch)
{
  ContactTone tone;
  std::vector<float> samples;
  play(tone, { 2.0, true }, 2 * kSecond, samples);
  int rises = 0; // in the second second
  for (std::size_t i = kSecond; i + 1 < samples.size(); ++i)
  {
    rises += samples[i] < 0.0F && samples[i + 1] >= 0.0F;
  }
  EXPECT_NEAR(rises, ContactTone::kHertz, 1.0);
}

TEST(Sound, IsTheSameHoweverItIsCutIntoBlocks)
{
  const HeardTouch touches[] = { { 0.0, false }, { 3.0, true }, { 0.2, true }, { 0.0, false },
    { 1.0, true } };
  std::vector<std::vector<float>> all;
  for (const std::size_t block : { std::size_t(1), std::size_t(7), std::size_t(240), kSecond })
  {
    ContactTone tone;
    std::vector<float> samples;
    for (const HeardTouch& touch : touches)
    {
      for (std::size_t done = 0; done < kSecond / 4; done += std::min(block, kSecond / 4 - done))
      {
        play(tone, touch, std::min(block, kSecond / 4 - done), samples);
      }
    }
    all.push_back(samples);
    EXPECT_EQ(samples, all.front()) << block;
  }
}

/// From sample to sample no more than the tone and the click themselves change: a jump would crack.
TEST(Sound, NeverJumps)
{
  ContactTone tone;
  std::vector<float> samples;
  for (int i = 0; i < 1000; ++i)
  {
    const double newtons = i % 7 == 0 ? 8.0 : i % 3 == 0 ? 0.0 : 0.5;
    play(tone, { newtons, i % 5 != 0 }, 48 + std::size_t(i) % 11, samples);
  }
  float most = 0.0F;
  for (std::size_t i = 1; i < samples.size(); ++i)
  {
    most = std::max(most, std::abs(samples[i] - samples[i - 1]));
  }
  EXPECT_GT(most, 0.01F);
  EXPECT_LT(most, 0.075F); // 2 pi 1500 Hz / 48 kHz of the click's 0.3, and the tone's part
}

TEST(Sound, ClicksWhereContactBeginsHoweverShortItIs)
{
  ContactTone tone;
  std::vector<float> samples;
  play(tone, { 0.0, true }, kSecond / 10, samples);
  EXPECT_GT(loudest(samples), 0.1F) << "without force";
  const std::size_t later = samples.size();
  play(tone, { 0.0, true }, kSecond / 10, samples);
  EXPECT_EQ(loudest(samples, later), 0.0F) << "once";
  play(tone, { 0.0, false }, kSecond / 10, samples);
  tone.render({ 0.0, true }, nullptr, 0); // a tick shorter than a sample
  const std::size_t again = samples.size();
  play(tone, { 0.0, false }, kSecond / 10, samples);
  EXPECT_GT(loudest(samples, again), 0.1F);
}

TEST(Sound, IsWrittenAsAWavFile)
{
  const std::string name =
    (std::filesystem::temp_directory_path() / ("SoundTest-" + std::to_string(getpid()) + ".wav")).string();
  std::string message;
  {
    TouchSoundFile file;
    ASSERT_TRUE(file.open(name, message)) << message;
    for (const double time : { 0.0, 2.0 / 48000.0 })
    {
      file.add(time, { 1e9, true }); // two samples, until the next one
    }
    EXPECT_FALSE(std::filesystem::exists(name)) << "it appears when it is complete";
    ASSERT_TRUE(file.close(message)) << message;
  }
  std::ifstream stream(name, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::filesystem::remove(name);
  ASSERT_EQ(bytes.size(), 52u);
  EXPECT_EQ(bytes.substr(0, 8), std::string("RIFF\x2c\0\0\0", 8));
  EXPECT_EQ(bytes.substr(8, 8), "WAVEfmt ");
  EXPECT_EQ(bytes.substr(24, 4), std::string("\x80\xbb\0\0", 4)) << "48,000 a second";
  EXPECT_EQ(bytes.substr(36, 8), std::string("data\x08\0\0\0", 8));
  EXPECT_EQ(bytes.substr(44, 2), std::string("\0\0", 2)) << "it begins without a crack";
  EXPECT_NE(bytes.substr(50), std::string("\0\0", 2));
  TouchSoundFile nowhere;
  EXPECT_FALSE(nowhere.open("/no/such/folder/a.wav", message));
  EXPECT_NE(message.find("/no/such/folder/a.wav: cannot be written"), std::string::npos) << message;
}

TEST(Sound, SaysWhatIsMissingWithoutALibrary)
{
  std::string message;
  EXPECT_EQ(openLoudspeaker(message, "libthere-is-none.so.2"), nullptr);
#if defined(__linux__)
  EXPECT_EQ(message.find("sound needs libthere-is-none.so.2, which is not there; install "), 0u) << message;
#endif
  EXPECT_NE(message.find("feel --sound-file"), std::string::npos) << message;
}

/// Records how loud the played blocks are; it waits as a loudspeaker does.
struct Heard : SoundOutput
{
  Heard(std::atomic<int>& all, std::atomic<float>& most, bool fails)
    : blocks(all)
    , level(most)
    , breaks(fails)
  {
  }
  bool write(const float* samples, std::size_t count, std::string& message) override
  {
    float most = 0.0F;
    std::for_each(samples, samples + count, [&most](float s) { most = std::max(most, std::abs(s)); });
    level = most;
    ++blocks;
    message = breaks ? "it broke; mend it" : "";
    if (waits)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return !breaks;
  }
  std::atomic<int>& blocks;
  std::atomic<float>& level;
  bool breaks;
  bool waits = true;
};

ServoSample touching(double newtons)
{
  ServoSample sample;
  sample.tick = 1;
  sample.state.contact = true;
  sample.state.force = { 0.0, 0.0, newtons };
  return sample;
}

TEST(Sound, FollowsTheNewestTickOfALoop)
{
  std::atomic<int> blocks{ 0 };
  std::atomic<float> level{ 0.0F };
  ServoLoop loop;
  ASSERT_EQ(loop.startFed(ServoStepSettings()), Status::Ok);
  SoundPlayer player;
  player.start(loop, std::make_unique<Heard>(blocks, level, false));
  EXPECT_TRUE(eventually([&] { return blocks > 10; }));
  EXPECT_EQ(level, 0.0F);
  loop.feed(touching(2.0));
  const float wanted = float(ContactTone::loudnessOf(2.0));
  EXPECT_TRUE(eventually([&] { return std::abs(level - wanted) < 0.1F * wanted; })) << level;
  loop.stop();
  EXPECT_TRUE(eventually([&] { return level == 0.0F; })) << "a loop that stopped is not felt";
  EXPECT_TRUE(player.isPlaying());
  player.stop();
  EXPECT_FALSE(player.isPlaying());
  EXPECT_EQ(player.takeProblem(), "");
}

/// Such as a file: it would fill the disk with the sound of one moment.
TEST(Sound, DoesNotRunAheadOfAnOutputThatNeverWaits)
{
  std::atomic<int> blocks{ 0 };
  std::atomic<float> level{ 0.0F };
  ServoLoop loop;
  SoundPlayer player;
  auto output = std::make_unique<Heard>(blocks, level, false);
  output->waits = false;
  const auto begin = std::chrono::steady_clock::now();
  player.start(loop, std::move(output));
  EXPECT_TRUE(eventually([&] { return blocks > 40; }));
  player.stop();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(blocks * SoundPlayer::kBlockSeconds, seconds.count() + 0.15);
}

TEST(Sound, TellsOnceWhyItEnded)
{
  std::atomic<int> blocks{ 0 };
  std::atomic<float> level{ 0.0F };
  ServoLoop loop;
  SoundPlayer player;
  player.start(loop, std::make_unique<Heard>(blocks, level, true));
  EXPECT_TRUE(eventually([&] { return player.takeProblem() == "it broke; mend it"; }));
  EXPECT_EQ(blocks, 1);
  EXPECT_EQ(player.takeProblem(), "");
  player.stop();
}

} // namespace
