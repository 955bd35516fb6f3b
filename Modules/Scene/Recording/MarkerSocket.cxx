#include "MarkerSocket.h"

#include "Haptics/ServoLoop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace pointhaptics
{
namespace
{

constexpr int kLookMilliseconds = 100; ///< Between two looks whether it is to end.
constexpr std::size_t kMostClients = 16;
constexpr std::size_t kLongestMarker = 1000;
constexpr std::size_t kMostMarkers = 10000;

bool isUtf8(const std::string& text)
{
  int following = 0; // bytes that go on with a character
  for (const char character : text)
  {
    const auto byte = static_cast<unsigned char>(character);
    if ((byte >> 6 == 2) != (following > 0))
    {
      return false;
    }
    following = following > 0 ? following - 1
      : byte < 128            ? 0
      : byte >> 5 == 6        ? 1
      : byte >> 4 == 14       ? 2
      : byte >> 3 == 30       ? 3
                              : 4;
  }
  return following == 0;
}

} // namespace

MarkerSocket::~MarkerSocket()
{
  thread_.stop();
  if (listener_ >= 0)
  {
    ::close(listener_);
  }
}

bool MarkerSocket::open(int port, const ServoLoop& loop, std::string& message)
{
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const int yes = 1;
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (listener_ < 0 || ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
    ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
    ::listen(listener_, int(kMostClients)) != 0 ||
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
  {
    message = fmt::format(
      "no markers can be taken at port {}: {}; give another port, 1024 to 65535", port, std::strerror(errno));
    return false;
  }
  port_ = ntohs(address.sin_port);
  loop_ = &loop;
  thread_.start([this] { this->run(); });
  return true;
}

std::vector<MarkerSocket::Marker> MarkerSocket::take()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(markers_, {});
}

/// @p line is a marker, of UTF-8 as the recording is; the next one begins.
void MarkerSocket::keep(std::string& line)
{
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  if (!isUtf8(line))
  {
    std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }, '?');
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (markers_.size() < kMostMarkers)
  {
    markers_.push_back({ loop_->latest().tick, line });
  }
  line.clear();
}

/// @p line: as far as it has come. False: the client has ended.
bool MarkerSocket::read(int client, std::string& line)
{
  char bytes[4096];
  const ssize_t count = ::recv(client, bytes, sizeof bytes, 0);
  for (ssize_t i = 0; i < count; ++i)
  {
    if (bytes[i] == '\n')
    {
      this->keep(line);
      continue;
    }
    line.append(line.size() < kLongestMarker ? 1 : 0, bytes[i]);
  }
  if (count == 0 && !line.empty())
  {
    this->keep(line); // the last line has no end
  }
  return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
}

void MarkerSocket::run()
{
  std::map<int, std::string> clients; // sockets with their lines
  while (!thread_.stopIsRequested())
  {
    std::vector<pollfd> waits = { { listener_, POLLIN, 0 } };
    for (const auto& client : clients)
    {
      waits.push_back({ client.first, POLLIN, 0 });
    }
    if (::poll(waits.data(), waits.size(), kLookMilliseconds) <= 0)
    {
      continue;
    }
    for (std::size_t i = 1; i < waits.size(); ++i)
    {
      if (waits[i].revents != 0 && !this->read(waits[i].fd, clients[waits[i].fd]))
      {
        ::close(waits[i].fd);
        clients.erase(waits[i].fd);
      }
    }
    if (waits[0].revents == 0)
    {
      continue;
    }
    const int accepted = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (accepted < 0)
    {
      ::poll(nullptr, 0, kLookMilliseconds); // without descriptors it stays readable
    }
    else if (clients.size() < kMostClients)
    {
      clients[accepted];
    }
    else
    {
      ::close(accepted);
    }
  }
  for (const auto& client : clients)
  {
    ::close(client.first);
  }
}

} // namespace pointhaptics
