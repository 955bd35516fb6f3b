/// @file
/// The whole content of one file in memory.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Owns the bytes. Costs the file's size in memory while it lives.
class FileBytes
{
public:
  /// Reads @p path. @throws FileProblem when it is missing, a folder, not a regular file, empty or
  /// unreadable.
  explicit FileBytes(const std::string& path);
  std::string_view view() const { return { data_.get(), size_ }; }

private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
};

/// The extension of @p path in lower case without its dot; empty when there is none.
std::string lowerExtension(const std::string& path);

} // namespace pointhaptics::io
