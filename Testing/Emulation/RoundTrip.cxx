// Times commands and their answers between the driver's USB link and an emulated Falcon, one a millisecond,
// for the given number of seconds. `pointhaptics bench servo` starts it: umockdev's library must be loaded
// before all others. Prints one object of JSON, times in seconds.
#include "EmulatedFalcon.h"
#include "UnderUmockdev.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/Falcon/FtdiLink.h"
#include "Haptics/Servo/LatencyHistogram.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

using namespace pointhaptics;

namespace
{

using Clock = std::chrono::steady_clock;
constexpr std::uint8_t kSetDivisor = 3;   ///< the chip's vendor request
constexpr std::uint16_t kFastDivisor = 2; ///< 1.5 megabaud
constexpr auto kPeriod = std::chrono::milliseconds(1);
constexpr auto kLost = std::chrono::milliseconds(100);

struct Exchanges
{
  LatencyHistogram times;
  long long lost = 0;  ///< no answer within kLost
  long long wrong = 0; ///< answers that are none
};

/// One command, until its answer is whole. @return false when the link is gone.
bool exchange(FtdiLink& link, const FalconFrame& command, FalconFrameFinder& finder, Exchanges& all)
{
  std::uint8_t bytes[2 * kFtdiPacket];
  const Clock::time_point begin = Clock::now();
  if (link.submit(command.data(), kFalconFrameSize) != Status::Ok)
  {
    return false;
  }
  while (Clock::now() - begin < kLost)
  {
    int count = 0;
    if (link.poll(bytes, int(sizeof(bytes)), count, 1e-3) != Status::Ok)
    {
      return false;
    }
    bool answered = false;
    for (int i = 0; i < count; ++i)
    {
      answered = finder.take(bytes[i]) || answered;
    }
    if (answered)
    {
      all.times.record(std::chrono::duration<double>(Clock::now() - begin).count());
      FalconReply reply;
      all.wrong += decode(finder.frame(), reply) && reply.allHomed() ? 0 : 1;
      return true;
    }
  }
  ++all.lost;
  return true;
}

int measure(double seconds, trial::EmulatedFalcon& falcon)
{
  Status status = Status::Ok;
  std::string message;
  const std::unique_ptr<FtdiBus> bus = makeUsbFtdiBus();
  const std::unique_ptr<FtdiLink> link = bus ? bus->open(status, message) : nullptr;
  if (!link)
  {
    std::fprintf(stderr, "the emulated Falcon cannot be opened: %s\n", message.c_str());
    return 1;
  }
  // As starting it leaves it: the firmware runs, at 1.5 megabaud.
  falcon.with([](trial::FalconModel& model) { model.runs = true; });
  if (link->control(kSetDivisor, kFastDivisor) != Status::Ok)
  {
    std::fprintf(stderr, "the emulated Falcon does not take its baud rate\n");
    return 1;
  }
  FalconCommand command;
  command.leds = kFalconHomingBit;
  const FalconFrame frame = encode(command);
  FalconFrameFinder finder;
  Exchanges warmUp;
  Exchanges all;
  bool goesOn = exchange(*link, frame, finder, warmUp);
  Clock::time_point next = Clock::now();
  const Clock::time_point end =
    next + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  while (goesOn && next < end)
  {
    std::this_thread::sleep_until(next);
    goesOn = exchange(*link, frame, finder, all);
    next = std::max(next + kPeriod, Clock::now());
  }
  if (!goesOn)
  {
    std::fprintf(stderr, "the emulated Falcon was lost\n");
    return 1;
  }
  const LatencyHistogram::Summary s = all.times.summary();
  std::printf(
    "{\"exchanges\": %llu, \"lost\": %lld, \"wrong\": %lld, \"dropped_bytes\": %llu, \"p50\": %.9g, "
    "\"p99\": %.9g, \"p999\": %.9g, \"max\": %.9g}\n",
    static_cast<unsigned long long>(s.count), all.lost, all.wrong,
    static_cast<unsigned long long>(finder.droppedBytes()), s.p50, s.p99, s.p999, s.maximum);
  return 0;
}

} // namespace

int main(int argc, char* argv[])
{
  const double seconds = argc == 2 ? std::atof(argv[1]) : 0.0;
  if (!(seconds > 0.0))
  {
    std::fprintf(stderr, "usage: %s SECONDS\n", argv[0]);
    return 2;
  }
  if (!trial::startUnderUmockdev(argv))
  {
    return 1;
  }
  UMockdevTestbed* const bed = umockdev_testbed_new();
  int result = 1;
  {
    trial::EmulatedFalcon falcon(bed);
    falcon.plugIn();
    result = measure(seconds, falcon);
  }
  g_object_unref(bed);
  return result;
}
