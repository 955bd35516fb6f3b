/// @file
/// Raw memory for the scratch of inner loops, which only grows and is reused.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pointhaptics
{

/// Allocates memory, to be freed by std::free: aligned to a page, in huge pages from the size of one on, as
/// the first touch of many small ones costs more than the work on them. @throw std::bad_alloc
inline void* allocatePages(std::size_t bytes)
{
  constexpr std::size_t kSmallPage = 4096;
  constexpr std::size_t kHugePage = std::size_t(1) << 21;
  const std::size_t page = bytes >= kHugePage ? kHugePage : kSmallPage;
  const std::size_t whole = (bytes + page - 1) / page * page;
  void* memory = std::aligned_alloc(page, whole);
  if (!memory)
  {
    throw std::bad_alloc();
  }
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (page == kHugePage)
  {
    static_cast<void>(madvise(memory, whole, MADV_HUGEPAGE));
  }
#endif
  return memory;
}

/// Aligned, uninitialised elements of a trivial type. Growing loses the content.
template <typename T>
class Buffer
{
public:
  Buffer() = default;
  ~Buffer() { std::free(data_); }
  Buffer(Buffer&& other) noexcept
    : data_(std::exchange(other.data_, nullptr))
    , capacity_(std::exchange(other.capacity_, 0))
  {
  }
  Buffer& operator=(Buffer&& other) noexcept
  {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }

  /// Room for @p count elements. @return true if the memory is new.
  bool reserve(std::size_t count)
  {
    if (count <= capacity_)
    {
      return false;
    }
    std::free(data_);
    data_ = nullptr;
    capacity_ = 0;
    data_ = static_cast<T*>(allocatePages(count * sizeof(T)));
    capacity_ = count;
    return true;
  }

  T* data() const { return data_; }
  T& operator[](std::size_t i) const { return data_[i]; }

private:
  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

} // namespace pointhaptics
