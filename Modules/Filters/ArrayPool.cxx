#include "ArrayPool.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <numeric>
#include <utility>

namespace pointhaptics
{

/// In front of a block's data.
struct alignas(64) ArrayPool::Header
{
  std::weak_ptr<State> state; ///< State of the pool that it goes back to.
  std::size_t bytes = 0;
};

struct ArrayPool::State
{
  struct Free
  {
    void operator()(Header* block) const
    {
      block->~Header();
      std::free(block);
    }
  };
  std::mutex mutex;
  std::multimap<std::size_t, std::unique_ptr<Header, Free>> idle; ///< By size.
};

ArrayPool::ArrayPool()
  : state_(std::make_shared<State>())
{
}

ArrayPool::~ArrayPool() = default;

void* ArrayPool::allocate(std::size_t part, std::size_t bytes)
{
  parts_.resize(std::max(parts_.size(), part + 1));
  parts_[part].reset(); // first: memory may be short
  parts_[part] = reserve(bytes);
  return parts_[part].get();
}

void ArrayPool::give(Memory memory, vtkDataArray* array, std::int64_t tuples)
{
  array->SetVoidArray(memory.release(), vtkIdType(tuples * array->GetNumberOfComponents()), 0,
    vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction([](void* data) { GiveBack()(data); });
}

void ArrayPool::take(std::size_t part, vtkDataArray* array, std::int64_t tuples, const void* results)
{
  if (results && part < parts_.size() && parts_[part].get() == results)
  {
    give(std::move(parts_[part]), array, tuples);
    return;
  }
  allocateFor(array, tuples);
  if (tuples > 0)
  {
    std::memcpy(array->GetVoidPointer(0), results,
      std::size_t(tuples * array->GetNumberOfComponents() * array->GetDataTypeSize()));
  }
}

void ArrayPool::allocateFor(vtkDataArray* array, std::int64_t tuples)
{
  constexpr std::size_t kSmallest = std::size_t(1) << 16; // smaller arrays are left to malloc
  const std::int64_t values = tuples * array->GetNumberOfComponents();
  const std::size_t bytes = std::size_t(values) * std::size_t(array->GetDataTypeSize());
  bytes < kSmallest ? array->SetNumberOfTuples(vtkIdType(tuples)) : give(reserve(bytes), array, tuples);
}

ArrayPool::Memory ArrayPool::reserve(std::size_t bytes)
{
  {
    // The smallest that is large enough, but none that would waste more than it holds.
    const std::lock_guard<std::mutex> lock(state_->mutex);
    const auto found = state_->idle.lower_bound(bytes);
    if (found != state_->idle.end() && found->first <= 2 * bytes)
    {
      Header* const block = found->second.release();
      state_->idle.erase(found);
      return Memory(block + 1);
    }
  }
  constexpr std::size_t kPage = 4096;
  const std::size_t size = (sizeof(Header) + bytes + kPage - 1) / kPage * kPage;
  void* const memory = std::aligned_alloc(kPage, size);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return Memory(new (memory) Header{ state_, size - sizeof(Header) } + 1);
}

void ArrayPool::GiveBack::operator()(void* data) const
{
  std::unique_ptr<Header, State::Free> block(static_cast<Header*>(data) - 1);
  if (const std::shared_ptr<State> state = block->state.lock())
  {
    const std::lock_guard<std::mutex> lock(state->mutex);
    const std::size_t bytes = block->bytes;
    state->idle.emplace(bytes, std::move(block));
  }
}

void ArrayPool::trim()
{
  parts_.clear();
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->idle.clear();
}

std::size_t ArrayPool::bytes() const
{
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return std::accumulate(state_->idle.begin(), state_->idle.end(), std::size_t(0),
    [](std::size_t sum, const auto& block) { return sum + block.first; });
}

} // namespace pointhaptics
