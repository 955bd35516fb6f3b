#include "ArrayPool.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Smaller arrays are left to malloc.
constexpr std::size_t kSmallest = std::size_t(1) << 16;

}

/// In front of a block's data.
struct alignas(64) ArrayPool::Header
{
  std::shared_ptr<State> state; ///< State of the pool that it goes back to; only while an array uses it.
  std::size_t bytes = 0;
};

struct ArrayPool::State
{
  std::mutex mutex;
  bool closed = false;
  std::vector<Header*> idle;

  static void destroy(Header* block)
  {
    block->~Header();
    std::free(block);
  }
};

ArrayPool::ArrayPool()
  : state_(std::make_shared<State>())
{
}

ArrayPool::~ArrayPool()
{
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->closed = true;
  }
  trim();
}

void ArrayPool::allocate(vtkDataArray* array, std::int64_t tuples)
{
  const std::int64_t values = tuples * array->GetNumberOfComponents();
  const std::size_t bytes = std::size_t(values) * std::size_t(array->GetDataTypeSize());
  if (bytes < kSmallest)
  {
    array->SetNumberOfTuples(vtkIdType(tuples));
    return;
  }
  take(reserve(bytes), array, tuples);
}

void* ArrayPool::reserve(std::size_t bytes)
{
  Header* block = nullptr;
  {
    // The smallest that is large enough, but none that would waste more than it holds.
    const std::lock_guard<std::mutex> lock(state_->mutex);
    auto best = state_->idle.end();
    for (auto it = state_->idle.begin(); it != state_->idle.end(); ++it)
    {
      const bool fits = (*it)->bytes >= bytes && (*it)->bytes <= 2 * bytes;
      if (fits && (best == state_->idle.end() || (*it)->bytes < (*best)->bytes))
      {
        best = it;
      }
    }
    if (best != state_->idle.end())
    {
      block = *best;
      state_->idle.erase(best);
    }
  }
  if (!block)
  {
    constexpr std::size_t kPage = 4096;
    const std::size_t size = (sizeof(Header) + bytes + kPage - 1) / kPage * kPage;
    void* memory = std::aligned_alloc(kPage, size);
    if (!memory)
    {
      throw std::bad_alloc();
    }
    block = new (memory) Header;
    block->bytes = size - sizeof(Header);
  }
  block->state = state_;
  return block + 1;
}

void ArrayPool::take(void* memory, vtkDataArray* array, std::int64_t tuples)
{
  array->SetVoidArray(memory, vtkIdType(tuples * array->GetNumberOfComponents()), 0,
    vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction(&ArrayPool::giveBack);
}

/// VTK calls it when the last array releases the memory.
void ArrayPool::giveBack(void* data)
{
  Header* block = static_cast<Header*>(data) - 1;
  const std::shared_ptr<State> state = std::move(block->state);
  {
    const std::lock_guard<std::mutex> lock(state->mutex);
    if (!state->closed)
    {
      state->idle.push_back(block);
      return;
    }
  }
  State::destroy(block);
}

void ArrayPool::trim()
{
  std::vector<Header*> idle;
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    idle.swap(state_->idle);
  }
  std::for_each(idle.begin(), idle.end(), &State::destroy);
}

std::size_t ArrayPool::bytes() const
{
  const std::lock_guard<std::mutex> lock(state_->mutex);
  std::size_t sum = 0;
  for (const Header* block : state_->idle)
  {
    sum += block->bytes;
  }
  return sum;
}

} // namespace pointhaptics
