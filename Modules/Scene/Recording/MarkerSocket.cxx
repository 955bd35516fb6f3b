#include "MarkerSocket.h"

#include "Haptics/ServoLoop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
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
  int following = 0;
  for (const char character : text)
  {
    const auto byte = static_cast<unsigned char>(character);
    const bool continues = byte >> 6 == 2;
    if (continues != (following > 0))
    {
      return false;
    }
    following = continues ? following - 1
      : byte < 128        ? 0
      : byte >> 5 == 6    ? 1
      : byte >> 4 == 14   ? 2
      : byte >> 3 == 30   ? 3
                          : 5;
    if (following == 5)
    {
      return false;
    }
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

/// The line of @p client is a marker, of UTF-8 as the recording is.
void MarkerSocket::keep(Client& client)
{
  if (!client.line.empty() && client.line.back() == '\r')
  {
    client.line.pop_back();
  }
  if (!isUtf8(client.line))
  {
    std::replace_if(
      client.line.begin(), client.line.end(), [](char c) { return static_cast<unsigned char>(c) > 127; },
      '?');
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (markers_.size() < kMostMarkers)
  {
    markers_.push_back({ loop_->latest().tick, client.line });
  }
  client.line.clear();
}

/// False: the client has ended.
bool MarkerSocket::read(Client& client)
{
  char bytes[4096];
  const ssize_t count = ::recv(client.socket, bytes, sizeof bytes, 0);
  for (ssize_t i = 0; i < count; ++i)
  {
    if (bytes[i] == '\n')
    {
      this->keep(client);
      continue;
    }
    client.line.append(client.line.size() < kLongestMarker ? 1 : 0, bytes[i]);
  }
  if (count == 0 && !client.line.empty())
  {
    this->keep(client); // its last line has no end
  }
  return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
}

void MarkerSocket::run()
{
  std::vector<Client> clients;
  while (!thread_.stopIsRequested())
  {
    std::vector<pollfd> waits = { { listener_, POLLIN, 0 } };
    for (const Client& client : clients)
    {
      waits.push_back({ client.socket, POLLIN, 0 });
    }
    if (::poll(waits.data(), waits.size(), kLookMilliseconds) <= 0)
    {
      continue;
    }
    for (std::size_t i = 0; i < clients.size(); ++i)
    {
      if (waits[i + 1].revents != 0 && !this->read(clients[i]))
      {
        ::close(clients[i].socket);
        clients[i].socket = -1;
      }
    }
    clients.erase(
      std::remove_if(clients.begin(), clients.end(), [](const Client& client) { return client.socket < 0; }),
      clients.end());
    const int accepted =
      waits[0].revents != 0 ? ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK) : -1;
    if (accepted >= 0 && clients.size() < kMostClients)
    {
      clients.push_back({ accepted, {} });
    }
    else if (accepted >= 0)
    {
      ::close(accepted);
    }
    else if (waits[0].revents != 0)
    {
      ::poll(nullptr, 0, kLookMilliseconds); // without descriptors it stays readable
    }
  }
  for (const Client& client : clients)
  {
    ::close(client.socket);
  }
}

} // namespace pointhaptics
