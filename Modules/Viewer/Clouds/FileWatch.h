/// @file
/// Which of some files have changed since the last look.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pointhaptics
{

/// Compares size and time of change. A file that is being written is waited for: it counts as changed once
/// two looks in a row find it equal, and different from the file at the start. A missing file counts as
/// unchanged until it comes back. One thread.
class FileWatch
{
public:
  /// Watches these files from now on.
  void watch(const std::vector<std::string>& files);
  /// True once for each change, at a look after it has settled.
  bool look();

private:
  struct Stamp
  {
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
    bool exists = false;
    bool operator==(const Stamp& other) const
    {
      return time == other.time && size == other.size && exists == other.exists;
    }
  };
  struct Watched
  {
    std::string name;
    Stamp known;
    Stamp last;
  };
  static Stamp stampOf(const std::string& name);

  std::vector<Watched> files_;
};

} // namespace pointhaptics
