#include "UsbipFalcon.h"

#include "../Unit/Eventually.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace pointhaptics
{
namespace trial
{
namespace
{
constexpr const char* kController = "/sys/devices/platform/vhci_hcd.0/";
constexpr int kFullSpeed = 2;
constexpr int kBusAndDevice = 0x10002;
constexpr double kSecondsToWait = 5.0;

// Words of a USB/IP header; those after the endpoint differ between the commands.
enum Word : std::size_t
{
  kCommand,
  kNumber,
  kDevice,
  kDirection,
  kEndpoint,
  kUnlinked = 5, ///< of an unlink: the number of the request to forget
  kStatus = 5,   ///< of an answer
  kLength = 6,   ///< of a request: bytes of its buffer; of an answer: bytes moved
  kSetup = 10,   ///< of a request: eight bytes, as on the wire
};
enum Command : std::uint32_t
{
  kSubmit = 1,
  kUnlink = 2,
  kSubmitAnswer = 3,
  kUnlinkAnswer = 4,
};

/// Device, configuration, interface 0, bulk IN 0x81 and OUT 0x02 of 64 bytes.
const std::vector<std::uint8_t> kDeviceDescriptor = { 0x12, 0x01, 0x00, 0x02, 0x00, 0x00, 0x00, 0x08, 0x03,
  0x04, 0x48, 0xcb, 0x00, 0x04, 0x01, 0x02, 0x00, 0x01 };
const std::vector<std::uint8_t> kConfiguration = { 0x09, 0x02, 0x20, 0x00, 0x01, 0x01, 0x00, 0x80, 0x2d, //
  0x09, 0x04, 0x00, 0x00, 0x02, 0xff, 0xff, 0xff, 0x00,                                                  //
  0x07, 0x05, 0x81, 0x02, 0x40, 0x00, 0x00,                                                              //
  0x07, 0x05, 0x02, 0x02, 0x40, 0x00, 0x00 };
const std::vector<std::uint8_t> kLanguages = { 0x04, 0x03, 0x09, 0x04 };

std::vector<std::uint8_t> stringDescriptor(const std::string& text)
{
  std::vector<std::uint8_t> bytes = { std::uint8_t(2 + 2 * text.size()), 0x03 };
  for (const char c : text)
  {
    bytes.push_back(std::uint8_t(c));
    bytes.push_back(0);
  }
  return bytes;
}

std::vector<std::uint8_t> descriptor(std::uint8_t type, std::uint8_t index)
{
  switch (type)
  {
    case 1:
      return kDeviceDescriptor;
    case 2:
      return kConfiguration;
    case 3:
      return index == 0 ? kLanguages : stringDescriptor(index == 1 ? "Novint" : "Falcon");
    default:
      return {};
  }
}

/// All of @p count bytes. False: the other side is gone.
bool receiveAll(int socket, void* bytes, std::size_t count)
{
  return count == 0 || recv(socket, bytes, count, MSG_WAITALL) == ssize_t(count);
}

bool say(const std::string& file, const std::string& text)
{
  std::ofstream stream(kController + file);
  stream << text << std::flush;
  return bool(stream);
}

/// The first port is in state "not assigned".
bool portIsFree()
{
  std::ifstream stream(kController + std::string("status"));
  std::string line;
  std::getline(stream, line);
  std::getline(stream, line);
  return line.find(" 0000 004 ") != std::string::npos;
}
}

bool UsbipFalcon::plugIn()
{
  int ends[2] = { -1, -1 };
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
  {
    return false;
  }
  socket_ = ends[0];
  configured_ = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    this->powerOn();
  }
  thread_ = std::thread([this] { serve(); });
  const bool taken = say("attach",
    "0 " + std::to_string(ends[1]) + " " + std::to_string(kBusAndDevice) + " " + std::to_string(kFullSpeed));
  close(ends[1]); // the kernel has its own hold on it
  return taken && eventually([this] { return configured_.load(); }, kSecondsToWait);
}

void UsbipFalcon::unplug()
{
  if (socket_ < 0)
  {
    return;
  }
  shutdown(socket_, SHUT_RDWR);
  thread_.join();
  close(socket_);
  socket_ = -1;
  waiting_.clear();
  eventually(portIsFree, kSecondsToWait);
}

void UsbipFalcon::serve()
{
  for (bool goesOn = true; goesOn;)
  {
    pollfd event{ socket_, POLLIN, 0 };
    const int ready = poll(&event, 1, waiting_.empty() ? 100 : 1);
    goesOn = ready <= 0 || takeOne();
    const std::lock_guard<std::mutex> lock(mutex_);
    this->catchUp();
    answerWaiting();
  }
}

bool UsbipFalcon::takeOne()
{
  Request request;
  if (!receiveAll(socket_, request.header.data(), sizeof(Header)))
  {
    return false;
  }
  for (std::size_t i = 0; i < kSetup; ++i)
  {
    request.header[i] = ntohl(request.header[i]);
  }
  request.come = Clock::now();
  const bool isOut = request.header[kCommand] == kSubmit && request.header[kDirection] == 0;
  std::vector<std::uint8_t> data(isOut ? request.header[kLength] : 0);
  if (!receiveAll(socket_, data.data(), data.size()))
  {
    return false;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  this->catchUp();
  if (request.header[kCommand] == kSubmit)
  {
    submit(request, data);
  }
  else if (request.header[kCommand] == kUnlink)
  {
    unlink(request.header);
  }
  return true;
}

void UsbipFalcon::submit(const Request& request, const std::vector<std::uint8_t>& data)
{
  const Header& header = request.header;
  if (header[kEndpoint] == 0)
  {
    std::vector<std::uint8_t> answer;
    const bool understood = control(request, answer);
    answer.resize(std::min<std::size_t>(answer.size(), header[kLength]));
    const std::uint32_t moved = header[kDirection] == 0 ? header[kLength] : std::uint32_t(answer.size());
    reply(header, understood ? 0 : -EPIPE, answer, understood ? moved : 0);
  }
  else if (header[kDirection] == 0)
  {
    model_.write(data.data(), data.size());
    reply(header, 0, {}, header[kLength]);
  }
  else
  {
    waiting_.push_back(request);
  }
}

/// False: not understood, which the wire calls a stall.
bool UsbipFalcon::control(const Request& request, std::vector<std::uint8_t>& answer)
{
  std::uint8_t setup[8];
  std::memcpy(setup, request.header.data() + kSetup, sizeof(setup));
  const std::uint16_t value = std::uint16_t(setup[2] | (setup[3] << 8));
  switch ((setup[0] << 8) | setup[1])
  {
    case 0x8006:
      answer = descriptor(setup[3], setup[2]);
      return !answer.empty();
    case 0x8000: // status of the device: powered by the bus
      answer = { 0, 0 };
      return true;
    case 0x0009: // the configuration
      configured_ = true;
      return true;
    case 0x010b: // an interface, a halt that ends
    case 0x0201:
      return true;
    case 0xc005: // the chip's modem lines
      answer = { 0x01, 0x60 };
      return true;
    case 0xc00a: // its latency timer, ms
      answer = { 16 };
      return true;
    default:
      break;
  }
  if (setup[0] == 0x40)
  {
    model_.control(setup[1], value);
  }
  return setup[0] == 0x40;
}

void UsbipFalcon::unlink(const Header& header)
{
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
    [&](const Request& request) { return request.header[kNumber] == header[kUnlinked]; });
  const bool waited = found != waiting_.end();
  if (waited)
  {
    waiting_.erase(found);
  }
  Header to = header;
  to[kCommand] = kUnlink;
  reply(to, waited ? -ECONNRESET : 0, {}, 0);
}

void UsbipFalcon::answerWaiting()
{
  while (!waiting_.empty())
  {
    const std::vector<std::uint8_t> bytes =
      this->packet(waiting_.front().header[kLength], waiting_.front().come);
    if (bytes.empty())
    {
      return;
    }
    this->reply(waiting_.front().header, 0, bytes, std::uint32_t(bytes.size()));
    waiting_.pop_front();
  }
}

void UsbipFalcon::reply(
  const Header& to, int status, const std::vector<std::uint8_t>& data, std::uint32_t length)
{
  Header header{};
  header[kCommand] = to[kCommand] == kUnlink ? kUnlinkAnswer : kSubmitAnswer;
  header[kNumber] = to[kNumber];
  header[kStatus] = std::uint32_t(status);
  header[kLength] = length;
  for (std::uint32_t& word : header)
  {
    word = htonl(word);
  }
  // Where the wire is broken the thread's next read says so.
  static_cast<void>(send(socket_, header.data(), sizeof(header), MSG_NOSIGNAL));
  if (!data.empty())
  {
    static_cast<void>(send(socket_, data.data(), data.size(), MSG_NOSIGNAL));
  }
}

} // namespace trial
} // namespace pointhaptics
