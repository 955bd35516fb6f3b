/// @file
/// The whole content of one file in memory, unpacked when it is gzip-compressed.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Owns the bytes. Costs the size of the (unpacked) content in memory while it lives, and that of a packed
/// file while it is unpacked.
class FileBytes
{
public:
  /// Receives the fraction that is done, 0..1; may throw to abort the reading.
  using Progress = std::function<void(double)>;
  /// Receives the first unpacked bytes and the size of the whole content (0: not known); throws to reject it.
  using Inspect = std::function<void(std::string_view, std::size_t)>;

  /// Reads @p path, a file or a pipe. A gzip file is unpacked on the way, up to kMostGzipRatio times its size
  /// (or kGzipFloor, where that is more): real clouds stay far below, and a file crafted to fill the memory
  /// is refused. @param salvages whether one that is cut is unpacked as far as it goes.
  /// @throws FileProblem when the file is missing, a folder, a device, empty, unreadable, or its
  /// gzip data are damaged, cut short or beyond the limit; what @p progress and @p inspect throw.
  FileBytes(const std::string& path, const Progress& progress, const Inspect& inspect, bool salvages = false);
  /// Memory for the whole of @p path, a file that is not packed, of which load() reads what is needed.
  explicit FileBytes(const std::string& path);

  /// Reads bytes that lie inside the file; bytes that were never read are zero, and cost no memory. Only for
  /// objects made by FileBytes(path). @throws FileProblem when they cannot be read.
  void load(std::size_t offset, std::size_t size);
  /// Bytes that load() has read.
  std::size_t loaded() const { return loaded_; }
  std::string_view view() const { return { data_.get(), size_ }; }
  /// True if view() is the unpacked content of a gzip file.
  bool wasPacked() const { return wasPacked_; }
  /// Whether that file is cut, and view() what was salvaged.
  bool isCut() const { return isCut_; }

  static constexpr std::size_t kMostGzipRatio = 100;
  static constexpr std::size_t kGzipFloor = std::size_t{ 1 } << 26;

private:
  struct Free
  {
    void operator()(char* data) const { std::free(data); }
  };

  void readStream(const std::string& path, const Progress& progress);
  void readPlain(const std::string& path, const Progress& progress, const Inspect& inspect);
  void unpack(const Progress& progress, const Inspect& inspect, bool salvages);
  void resize(std::size_t size);

  std::unique_ptr<char, Free> data_;
  std::ifstream file_; ///< that load() reads
  std::size_t size_ = 0;
  std::size_t loaded_ = 0;
  bool wasPacked_ = false;
  bool isCut_ = false;
};

/// The first @p size bytes of a file, fewer where it has fewer; empty where it cannot be read.
std::string startOfFile(const std::string& path, std::size_t size);

/// The extension of @p path in lower case without its dot; empty when there is none.
std::string lowerExtension(const std::string& path);

} // namespace pointhaptics::io
