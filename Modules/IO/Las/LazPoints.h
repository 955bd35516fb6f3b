/// @file
/// The points of a LAZ or COPC file as the records an uncompressed LAS file would hold. LazPoints.cxx unpacks
/// them through LASzip; NoLazPoints.cxx stands in its place where CMake did not find that library.
#pragma once

#include "vtkType.h"

#include <memory>

namespace pointhaptics::io
{

struct LasHeader;
struct ReadTask;

/// Reads a file from its first point to its last; lives during one read, in one thread. Costs the records of
/// one call of next() beside what LASzip takes.
class LazPoints
{
public:
  /// @throws FileProblem where this build cannot read LAZ (naming a converter), where the file's own account
  /// of its compression cannot be true (checkLazLayout), and with LASzip's message where it refuses the file.
  /// @p header must outlive this object.
  LazPoints(const ReadTask& task, const LasHeader& header);
  ~LazPoints();
  LazPoints(const LazPoints&) = delete;
  LazPoints& operator=(const LazPoints&) = delete;

  /// The next @p count records of header.recordLength bytes each; valid until the next call. @throws
  /// FileProblem with the point's number and LASzip's message where they cannot be unpacked.
  const char* next(vtkIdType count);

private:
  struct Unpacker;
  std::unique_ptr<Unpacker> unpacker_;
};

} // namespace pointhaptics::io
