#include "Devices/Falcon/FalconBoot.h"

#include "Devices/Falcon/FalconFrame.h"

#include <algorithm>
#include <array>

namespace pointhaptics
{
namespace
{
/// Vendor requests of the FTDI chip.
enum Request : std::uint8_t
{
  kReset = 0,
  kModem = 1,
  kFlow = 2,
  kDivisor = 3,
  kData = 4,
  kLatency = 9,
};
constexpr std::uint16_t kResetAll = 0;
constexpr std::uint16_t kPurgeReceived = 1;
constexpr std::uint16_t kPurgeSent = 2;
constexpr std::uint16_t kDtrLow = 0x0100;
constexpr std::uint16_t kDtrHigh = 0x0101;
constexpr std::uint16_t kRtsLow = 0x0200;
constexpr std::uint16_t kNoFlowControl = 0;
constexpr std::uint16_t kEightBitsNoParity = 0x0008;
constexpr std::uint16_t k9600Baud = 0x4138;
constexpr std::uint16_t k142857Baud = 0x15;
constexpr std::uint16_t k1500000Baud = 0x2;
constexpr std::uint16_t kBootLatency = 16;
constexpr std::uint16_t kRunLatency = 1;

constexpr std::uint8_t kGreeting[] = { 0x0A, 0x43, 0x0D };
constexpr std::uint8_t kGreetingReply[] = { 0x0A, 0x44, 0x2C, 0x0D };
constexpr std::uint8_t kReady = 0x41;
constexpr int kBlock = 62;
constexpr int kProbes = 3;
/// After this many tries in a row without an answer to any greeting no device is there.
constexpr int kSilentTries = 2;
}

FalconBoot::FalconBoot(FtdiLink& link, const FalconBootSettings& settings, const std::atomic<bool>& cancelled)
  : link_(link)
  , settings_(settings)
  , cancelled_(cancelled)
{
}

Status FalconBoot::control(std::initializer_list<ControlRequest> requests)
{
  Status status = Status::Ok;
  for (const auto& [request, value] : requests)
  {
    status = status != Status::Ok ? status : cancelled_ ? Status::Aborted : link_.control(request, value);
  }
  return status;
}

Status FalconBoot::serialForBoot()
{
  return control({ { kReset, kResetAll }, { kReset, kPurgeReceived }, { kReset, kPurgeSent },
    { kLatency, kBootLatency }, { kDivisor, k9600Baud }, { kData, kEightBitsNoParity },
    { kFlow, kNoFlowControl }, { kModem, kRtsLow }, { kModem, kDtrLow }, { kModem, kDtrHigh } });
}

Status FalconBoot::serialForRun()
{
  return control({ { kLatency, kRunLatency }, { kDivisor, k1500000Baud }, { kReset, kPurgeReceived },
    { kReset, kPurgeSent } });
}

/// Collects bytes until @p bytes have come. Bytes before them, such as a 00, are skipped.
Status FalconBoot::expect(const std::uint8_t* bytes, int count, int timeoutMilliseconds, bool& found)
{
  found = false;
  std::vector<std::uint8_t> all;
  for (;;)
  {
    std::uint8_t packet[kFtdiPacket];
    int size = 0;
    const Status status = cancelled_ ? Status::Aborted : link_.receive(packet, size, timeoutMilliseconds);
    if (status != Status::Ok || size == 0)
    {
      return status;
    }
    all.insert(all.end(), packet, packet + size);
    found = std::search(all.begin(), all.end(), bytes, bytes + count) != all.end();
    if (found || int(all.size()) > count + kFtdiPacket)
    {
      return Status::Ok;
    }
  }
}

Status FalconBoot::probe()
{
  Status status = control({ { kData, kEightBitsNoParity }, { kFlow, kNoFlowControl } });
  status = status == Status::Ok ? serialForRun() : status;
  FalconFrameFinder finder;
  for (int i = 0; i < kProbes && status == Status::Ok; ++i)
  {
    const FalconFrame frame = encode(FalconCommand());
    status = link_.send(frame.data(), int(frame.size()), settings_.replyMilliseconds);
    std::uint8_t packet[kFtdiPacket];
    int size = 0;
    status =
      status == Status::Ok ? link_.receive(packet, size, settings_.probeMilliseconds / kProbes) : status;
    FalconReply reply;
    for (int k = 0; k < size; ++k)
    {
      if (finder.take(packet[k]) && decode(finder.frame(), reply))
      {
        return Status::Ok;
      }
    }
  }
  return status == Status::Ok ? Status::DeviceSilent : status;
}

Status FalconBoot::greet()
{
  Status status = serialForBoot();
  bool found = false;
  for (int i = 0; i < settings_.greetings && status == Status::Ok && !found; ++i)
  {
    status = link_.send(kGreeting, int(sizeof(kGreeting)), settings_.replyMilliseconds);
    status = status == Status::Ok
      ? expect(kGreetingReply, int(sizeof(kGreetingReply)), settings_.replyMilliseconds, found)
      : status;
  }
  return status == Status::Ok && !found ? Status::DeviceSilent : status;
}

Status FalconBoot::load(const std::vector<std::uint8_t>& firmware)
{
  Status status = control({ { kModem, kDtrLow }, { kDivisor, k142857Baud } });
  status = status == Status::Ok ? link_.send(&kReady, 1, settings_.replyMilliseconds) : status;
  bool echoed = false;
  status = status == Status::Ok ? expect(&kReady, 1, settings_.replyMilliseconds, echoed) : status;
  for (std::size_t sent = 0; status == Status::Ok && echoed && sent < firmware.size();)
  {
    const int count = int(std::min<std::size_t>(kBlock, firmware.size() - sent));
    status = link_.send(firmware.data() + sent, count, settings_.blockMilliseconds);
    status = status == Status::Ok ? expect(firmware.data() + sent, count, settings_.blockMilliseconds, echoed)
                                  : status;
    sent += std::size_t(count);
  }
  if (status == Status::Ok && !echoed)
  {
    return Status::FirmwareNotTaken;
  }
  return status == Status::Ok ? serialForRun() : status;
}

Status bootFalcon(FtdiLink& link, const FalconBootSettings& settings,
  const std::vector<std::uint8_t>& firmware, const std::atomic<bool>& cancelled,
  const std::function<void()>& onLoading)
{
  FalconBoot boot(link, settings, cancelled);
  Status status = boot.probe();
  if (status != Status::DeviceSilent)
  {
    return status;
  }
  if (firmware.empty())
  {
    return Status::FirmwareMissing;
  }
  onLoading();
  int timeouts = 0;
  for (int attempt = 0; attempt < settings.loads && timeouts < kSilentTries; ++attempt)
  {
    status = boot.greet();
    timeouts = status == Status::DeviceSilent ? timeouts + 1 : 0;
    status = status == Status::Ok ? boot.load(firmware) : status;
    status = status == Status::Ok ? boot.probe() : status;
    // A silent device may wake at the next try; one that is gone will not.
    if (status == Status::Ok || status == Status::DeviceLost || status == Status::Aborted)
    {
      return status;
    }
  }
  return status == Status::DeviceSilent ? Status::DeviceSilent : Status::FirmwareNotTaken;
}

} // namespace pointhaptics
