/// @file
/// The bytes of an E57 file: pages of 1020 bytes and their checksum, and in them the records of a scan, a
/// stream of bits per field, cut into packets.
#pragma once

#include "IO/E57/E57Scan.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

/// Finds where the parts of each stream are; the bytes stay in the file. Reading from many threads at once is
/// safe. Costs 16 bytes for each part of a stream.
class E57Packets
{
public:
  /// Walks over the packets of @p scan until each stream has what its records need. The index packets are not
  /// needed for that. @throws FileProblem with the byte offset of a packet that cannot be, and where the
  /// streams end before the records that the XML promises: nothing need be allocated for those before.
  /// A @p task that salvages lowers the number of records to those that are there, with a note.
  E57Packets(const E57Pages& pages, E57Scan& scan, const std::string& where, ReadTask& task);

  /// Copies bytes of a stream: as many of @p count as there are, behind them zeros.
  void gather(std::size_t field, std::uint64_t first, std::size_t count, char* to) const noexcept;

  /// The logical bytes of the section that holds the packets, from first to one past the last.
  std::uint64_t begin() const { return begin_; }
  std::uint64_t end() const { return end_; }

private:
  struct Part
  {
    std::uint64_t before; ///< bytes of the stream in front of it
    std::uint64_t at;     ///< logical
  };
  struct Stream
  {
    std::vector<Part> parts;
    std::uint64_t size = 0;
    std::uint64_t needed = 0;
  };

  std::uint64_t findSection(const E57Scan& scan);
  void planStreams(const E57Scan& scan);
  void walk(std::uint64_t at);
  void addDataPacket(std::uint64_t at, std::size_t length);
  void endEarly(E57Scan& scan, ReadTask& task) const;

  const E57Pages& pages_;
  const std::string where_;
  std::vector<Stream> streams_;
  std::size_t unfinished_ = 0; ///< streams that need more bytes
  std::uint64_t begin_ = 0;
  std::uint64_t end_ = 0;
};

} // namespace pointhaptics::io
