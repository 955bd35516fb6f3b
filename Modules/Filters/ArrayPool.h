/// @file
/// Memory of output arrays, reused once the arrays are deleted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

class vtkDataArray;

namespace pointhaptics
{

/// A filter makes arrays of much the same size at each update, and the first touch of fresh memory takes
/// longer than filling it. The pool gives arrays the memory of deleted ones. An array, and whatever shares
/// its buffer, may outlive the pool and be deleted in any thread.
class ArrayPool
{
public:
  ArrayPool();
  ~ArrayPool();
  ArrayPool(const ArrayPool&) = delete;
  ArrayPool& operator=(const ArrayPool&) = delete;

  /// Gives @p array, of VTK's usual layout and with its components set, memory for so many tuples, not
  /// initialised.
  void allocate(vtkDataArray* array, std::int64_t tuples);
  /// Reserves memory for at least so many bytes, until it is taken or given back.
  void* reserve(std::size_t bytes);
  /// Gives @p array reserved memory, with so many tuples in it.
  void take(void* memory, vtkDataArray* array, std::int64_t tuples);
  /// Returns reserved memory that no array took.
  static void giveBack(void* memory);
  /// Frees the memory that no array uses.
  void trim();
  /// Bytes that the pool keeps for later arrays.
  std::size_t bytes() const;

private:
  struct State;
  struct Header;

  std::shared_ptr<State> state_;
};

} // namespace pointhaptics
