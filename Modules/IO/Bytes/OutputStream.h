/// @file
/// Core's OutputFile with this module's way to report a fault.
#pragma once

#include "FileProblem.h"

#include "Core/Base/OutputFile.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// A file that appears under its name only when it is complete. Each function @throws FileProblem.
class OutputStream
{
public:
  explicit OutputStream(const std::string& target) { check(file_.open(target)); }

  void write(const char* data, std::size_t size) { check(file_.write({ data, size })); }
  void write(std::string_view text) { check(file_.write(text)); }
  /// Writes bytes at any place, unbuffered: see OutputFile::writeAt().
  void writeAt(std::uint64_t place, std::string_view bytes) { check(file_.writeAt(place, bytes)); }
  /// Throws the fault of an earlier call again, where there was one.
  void checkEarlier() const { check(file_.reason().empty() ? Status::Ok : Status::FileNotWritable); }
  void commit() { check(file_.commit()); }
  /// False for a pipe or a device, which cannot be written by anyone who seeks.
  bool isReplacing() const noexcept { return file_.isReplacing(); }
  /// The unfinished file, for a library that opens it by name.
  const std::string& path() const noexcept { return file_.path(); }

private:
  void check(Status status) const
  {
    if (status != Status::Ok)
    {
      throw FileProblem(
        file_.isDiskFull() ? vtkErrorCode::OutOfDiskSpaceError : vtkErrorCode::CannotOpenFileError,
        file_.reason(), file_.cure());
    }
  }

  OutputFile file_;
};

} // namespace pointhaptics::io
