/// @file
/// Which of some files have changed since the last look.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
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
  /// Time of change and size; nothing: there is no such file.
  using Stamp = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;
  std::vector<Stamp> stamps() const;

  std::vector<std::string> files_;
  std::vector<Stamp> known_;
  std::vector<Stamp> last_;
};

} // namespace pointhaptics
