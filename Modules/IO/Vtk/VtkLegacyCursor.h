/// @file
/// Walks over a legacy VTK file: words, and arrays of numbers as text or as big-endian bytes.
#pragma once

#include "ReadTask.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <string>
#include <string_view>

namespace pointhaptics::io
{

/// Functions @throw FileProblem with the byte offset, before anything is allocated that the file cannot hold.
class VtkLegacyCursor
{
public:
  using Count = unsigned long long;

  explicit VtkLegacyCursor(const ReadTask& task)
    : task_(task)
    , bytes_(task.bytes)
  {
  }
  bool isAtEnd() const { return at_ >= bytes_.size(); }
  bool isBinary() const { return isBinary_; }
  void setBinary(bool isBinary) { isBinary_ = isBinary; }
  std::string where() const { return "byte " + std::to_string(at_) + ": "; }

  /// The rest of the line, without white space at both ends.
  std::string_view line();
  /// The next word, on whatever line; empty at the end.
  std::string_view word();
  std::string_view peek();
  Count count(const char* what);
  /// VTK type of a name such as "unsigned_char".
  int type(std::string_view name) const;

  /// An array whose values begin here or, in binary files, on the next line.
  vtkSmartPointer<vtkDataArray> values(const std::string& name, int vtkType, Count tuples, Count components);
  void skipValues(int vtkType, Count count);

private:
  void checkSize(int vtkType, Count count);
  void readText(vtkDataArray* array, Count count);
  double number();

  const ReadTask& task_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool isBinary_ = false;
};

} // namespace pointhaptics::io
