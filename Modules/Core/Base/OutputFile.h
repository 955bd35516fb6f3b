/// @file
/// A file that appears under its name only when it is complete. All files are written through it.
#pragma once

#include "Core/Base/Status.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pointhaptics
{

/// Writes a temporary file beside the target; commit() renames it. Without commit() the target is unchanged
/// and the temporary file is removed.
/// - A symbolic link stays one: the file it points to is replaced, or created where there is none yet.
/// - The new file takes the permissions of the file that it replaces.
/// - A pipe or a device (/dev/stdout) cannot be replaced: it is written directly.
/// Functions return Ok or FileNotWritable; then reason() and cure() explain it. One object serves one thread.
class OutputFile
{
public:
  OutputFile() = default;
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// FileNotWritable: a folder, a loop of links, a folder that does not exist or must not be written in.
  Status open(const std::string& target);
  /// Buffered. A fault is kept: later calls do nothing, commit() returns it.
  Status write(std::string_view bytes);
  /// Opens the unfinished file, path(), that an OutputFile of another process has open and will commit: this
  /// one adds parts to it with writeAt(), and its own commit() only closes.
  Status join(const std::string& unfinished);
  /// Writes @p bytes to a place of the file, unbuffered; files may have several writers then, and each place
  /// one of them. Not for pipes and devices, nor together with write().
  Status writeAt(std::uint64_t place, std::string_view bytes);
  /// Writes the buffer, closes, renames.
  Status commit();

  /// False for a pipe or a device, true after any other open().
  bool isReplacing() const noexcept { return !temporary_.empty(); }
  /// The temporary file, empty after open(): other code may write it before commit(), instead of write().
  const std::string& path() const noexcept { return isReplacing() ? temporary_ : target_; }
  /// The system's message, such as "No space left on device", and what to do about it. Empty without an
  /// error.
  const std::string& reason() const noexcept { return reason_; }
  const std::string& cure() const noexcept { return cure_; }
  bool isDiskFull() const noexcept { return diskFull_; }

private:
  Status fail(int error);
  Status fail(const std::string& reason, const std::string& cure);
  void flush();
  void discard() noexcept;

  std::string target_;
  std::string temporary_;
  std::string buffer_;
  std::string reason_;
  std::string cure_;
  int descriptor_ = -1;
  bool diskFull_ = false;
};

} // namespace pointhaptics
