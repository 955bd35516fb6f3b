/// @file
/// Markers of a recording from other programs, such as the one that shows a stimulus.
#pragma once

#include "Core/Base/StoppableThread.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace pointhaptics
{

class ServoLoop;

/// Listens on a TCP port of this machine alone (127.0.0.1): each line of text that comes is a marker, at the
/// tick that is the newest when it comes. A thread of its own waits for lines; the servo thread knows nothing
/// of it.
class POINTHAPTICSSCENE_EXPORT MarkerSocket
{
public:
  struct Marker
  {
    std::uint64_t tick = 0;
    std::string text;
  };

  MarkerSocket() = default;
  ~MarkerSocket();
  MarkerSocket(const MarkerSocket&) = delete;
  MarkerSocket& operator=(const MarkerSocket&) = delete;

  /// @param port 1 to 65535; 0: any that is free, see port(). @param loop outlives this. False: @p message
  /// says why not, and the cure.
  bool open(int port, const ServoLoop& loop, std::string& message);
  int port() const { return port_; }
  /// Returns the markers since the last call, oldest first. At most 10,000 are kept. Any thread.
  std::vector<Marker> take();

private:
  void run();
  void keep(std::string& line);
  bool read(int client, std::string& line);

  const ServoLoop* loop_ = nullptr;
  int listener_ = -1;
  int port_ = 0;
  std::mutex mutex_;
  std::vector<Marker> markers_;
  StoppableThread thread_;
};

} // namespace pointhaptics
