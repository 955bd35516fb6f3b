/// @file
/// A file that appears under its name only when it is complete. All files are written through it.
#pragma once

#include "Core/Base/Status.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

struct stat;

namespace pointhaptics
{

/// Writes a hidden part file beside the target, `.NAME.1.part`; commit() renames it. Without commit() the
/// target is unchanged and the part is removed. Parts are locked (flock): open() removes those of the same
/// target that a killed process left.
/// - A symbolic link stays one: the file it points to is replaced, or created where there is none yet.
/// - The new file takes permissions and owner of the file that it replaces. A file that is write-protected is
///   not replaced.
/// - A pipe or a device cannot be replaced: it is written directly, as is standard output (/dev/stdout).
/// - A target that is the part of another OutputFile, its path(), is written in place: the other one commits
/// it. Functions return Ok or FileNotWritable; then reason() and cure() explain it. One object serves one
/// thread.
class OutputFile
{
public:
  OutputFile();
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// FileNotWritable: a folder, a loop of links, a write-protected file, a folder that does not exist or must
  /// not be written in.
  /// @param isKept for what cannot be made again: the part is called NAME.part and stays unless commit() or
  /// abandon() end it, whatever happens to this process. commit() replaces only a file that was there at the
  /// beginning. FileNotWritable also where there is such a part; forgetKept() removes it.
  Status open(const std::string& target, bool isKept = false);
  /// Removes the NAME.part of @p target that no process writes any more.
  static void forgetKept(const std::string& target);
  static std::string keptPartOf(const std::string& target);
  /// The fault of a reader that missed @p target where its NAME.part is there; empty: it is not.
  static std::string missedPart(const std::string& target);
  /// Returns what open() would, as far as can be told without touching anything.
  Status check(const std::string& target);
  /// Adds bytes to a buffer. A fault is kept: later calls do nothing, commit() returns it.
  Status write(std::string_view bytes);
  /// Hands the buffer to the system, so that its bytes survive the end of this process.
  Status flush();
  /// Writes @p bytes to a place of the file, unbuffered. Not for pipes and devices. A place that write() has
  /// filled needs a flush() before.
  Status writeAt(std::uint64_t place, std::string_view bytes);
  /// Writes the buffer, closes, renames.
  Status commit();
  /// Closes and removes the part: the target is not replaced.
  void abandon() noexcept;

  /// Removes the parts of all objects of this process, which are of no use then: for a process that a library
  /// aborts. Waits for nobody.
  static void discardAll() noexcept;

  /// False for a pipe, a device and standard output, true after any other open().
  bool isReplacing() const noexcept { return isRegular_; }
  /// The part file, empty after open(): other code may write it before commit(), instead of write().
  const std::string& path() const noexcept { return temporary_.empty() ? target_ : temporary_; }
  /// The system's message, such as "No space left on device", and what to do about it. Empty without an
  /// error.
  const std::string& reason() const noexcept { return reason_; }
  const std::string& cure() const noexcept { return cure_; }
  bool isDiskFull() const noexcept { return diskFull_; }
  /// True if the reader of a pipe is gone.
  bool isReaderGone() const noexcept { return readerGone_; }

private:
  Status fail(int error);
  Status fail(const std::string& reason, const std::string& cure);
  Status openInPlace(int descriptor);
  Status openPart(const struct stat* replaced);
  bool renamePart() noexcept;
  void discard() noexcept;

  OutputFile* next_ = nullptr; ///< Next in the list of all output files of this process.
  std::string target_;
  std::string temporary_;
  std::string buffer_;
  std::string reason_;
  std::string cure_;
  int descriptor_ = -1;
  bool diskFull_ = false;
  bool readerGone_ = false;
  bool isRegular_ = false;
  bool isKept_ = false;   ///< The part is not to be removed.
  bool replaces_ = false; ///< True if there was a file when this one was opened.
};

} // namespace pointhaptics
