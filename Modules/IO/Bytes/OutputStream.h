/// @file
/// Core's OutputFile with this module's way to report a fault.
#pragma once

#include "FileProblem.h"

#include "Core/Base/OutputFile.h"

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
  void commit() { check(file_.commit()); }

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
