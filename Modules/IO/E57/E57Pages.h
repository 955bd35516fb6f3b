/// @file
/// The pages of an E57 file: 1020 bytes of content and their checksum, again and again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

struct ReadTask;

/// Bytes of the file are counted in two ways: physical offsets count the checksums, logical ones do not. The
/// file's own pointers are physical, its lengths logical. Keeps a view of the bytes, which must outlive it.
/// Reading from many threads at once is safe.
class E57Pages
{
public:
  static constexpr std::size_t kPage = 1024;
  static constexpr std::size_t kChecksum = 4;
  static constexpr std::size_t kContent = kPage - kChecksum;
  static constexpr std::size_t kFileHeader = 48;

  /// Reads the file's header. @throws FileProblem for another version, another size of pages, and lengths
  /// that do not fit the file.
  explicit E57Pages(std::string_view bytes);

  /// Compares the checksums of all pages, on VTK's threads. @throws FileProblem for the first one that is
  /// wrong, StoppedOnRequest. Reports progress from 0 to @p part.
  void check(const ReadTask& task, double part) const;

  std::string version() const;                                            ///< "1.0"
  std::uint64_t size() const { return bytes_.size() / kPage * kContent; } ///< logical
  std::uint64_t xmlOffset() const { return xmlOffset_; }                  ///< logical
  std::uint64_t xmlLength() const { return xmlLength_; }                  ///< logical

  /// The logical offset of a physical one. @throws FileProblem naming @p what where it lies outside of the
  /// file or in a checksum.
  std::uint64_t logical(std::uint64_t physical, const std::string& what) const;
  /// The other way round, for messages.
  static std::uint64_t physical(std::uint64_t logical)
  {
    return logical / kContent * kPage + logical % kContent;
  }

  /// Copies content. The caller has checked that it lies inside the file.
  void copy(std::uint64_t logicalOffset, std::size_t count, char* to) const noexcept;

private:
  std::string_view bytes_; ///< whole pages
  std::uint32_t major_ = 0;
  std::uint32_t minor_ = 0;
  std::uint64_t xmlOffset_ = 0;
  std::uint64_t xmlLength_ = 0;
};

} // namespace pointhaptics::io
