/// @file
/// Raw memory: scratch of the inner loops that only grows and is reused, and vectors without a first value.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pointhaptics
{

enum class Pages
{
  Small,
  Huge, ///< For large pieces, where the first touch of small pages costs more than the work on them.
};

constexpr std::size_t kHugePage = std::size_t(1) << 21;

/// Allocates memory, to be freed by std::free, in huge pages from the size of one on. @throw std::bad_alloc
inline void* allocatePages(std::size_t bytes, Pages pages)
{
  constexpr std::size_t kSmallAlignment = 4096;
  const bool large = pages == Pages::Huge && bytes >= kHugePage;
  const std::size_t alignment = large ? kHugePage : kSmallAlignment;
  const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, whole);
  if (!memory)
  {
    throw std::bad_alloc();
  }
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (large)
  {
    static_cast<void>(madvise(memory, whole, MADV_HUGEPAGE));
  }
#endif
  return memory;
}

/// Allocator of PageVector.
template <typename T>
struct PageAllocator
{
  using value_type = T;

  PageAllocator() = default;
  template <typename U>
  PageAllocator(const PageAllocator<U>&) noexcept
  {
  }
  T* allocate(std::size_t count)
  {
    const std::size_t bytes = count * sizeof(T);
    void* const memory = bytes < kLarge ? std::malloc(bytes) : allocatePages(bytes, Pages::Huge);
    return memory ? static_cast<T*>(memory) : throw std::bad_alloc();
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  template <typename U>
  void construct(U*) noexcept
  {
    static_assert(std::is_trivially_default_constructible_v<U>);
  }
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const PageAllocator&, const PageAllocator&) { return true; }
  friend bool operator!=(const PageAllocator&, const PageAllocator&) { return false; }

private:
  /// Least bytes of a block in huge pages: smaller blocks mostly reuse memory, which needs no first touch.
  static constexpr std::size_t kLarge = 4 * kHugePage;
};

/// A vector whose resize() leaves new elements, of a trivial type, uninitialised. Large ones are in huge
/// pages.
template <typename T>
using PageVector = std::vector<T, PageAllocator<T>>;

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
  bool reserve(std::size_t count, Pages pages = Pages::Small)
  {
    if (count <= capacity_)
    {
      return false;
    }
    std::free(data_);
    data_ = nullptr;
    capacity_ = 0;
    data_ = static_cast<T*>(allocatePages(count * sizeof(T), pages));
    capacity_ = count;
    return true;
  }
  void release() { *this = Buffer(); }

  T* data() const { return data_; }
  T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t bytes() const { return capacity_ * sizeof(T); }

private:
  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

} // namespace pointhaptics
