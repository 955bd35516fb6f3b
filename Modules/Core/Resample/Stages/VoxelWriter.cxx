#include "Core/Resample/Stages/VoxelWriter.h"

#include <utility>

namespace pointhaptics
{
namespace simd
{
namespace
{

void writeLoaded(const Kernels& kernels, std::size_t offset, PartitionWorker& worker, MeanArena& arena)
{
  if (const PartitionVoxels* voxels = worker.packed())
  {
    arena.write(kernels, offset, *voxels);
  }
  else
  {
    arena.write(offset, worker.wide());
  }
  worker.writeReductions(arena, offset);
}

}

VoxelWriter::VoxelWriter(Level& level, std::uint32_t partitions, std::size_t room,
  const MeanArena::Layout& layout, int fractionBits, OutputAllocator* allocator)
  : level_(level)
  , layout_(layout)
  , fractionBits_(fractionBits)
  , order_(partitions)
{
  level.arena.prepare(room, layout, level.lattice, fractionBits, allocator);
}

void VoxelWriter::write(
  const Kernels& kernels, std::uint32_t partition, std::size_t size, PartitionWorker& worker)
{
  const std::size_t offset = order_.first(partition);
  if (offset != PartitionOrder::kUnknown)
  {
    writeLoaded(kernels, offset, worker, level_.arena);
    return;
  }
  MeanArena aside;
  aside.prepare(size, layout_, level_.lattice, fractionBits_);
  writeLoaded(kernels, 0, worker, aside);
  const std::lock_guard<std::mutex> lock(mutex_);
  late_.push_back({ partition, size, std::move(aside) });
}

void VoxelWriter::finish()
{
  level_.firsts = order_.take();
  level_.size = std::int64_t(level_.firsts.back());
  for (const Late& piece : late_)
  {
    level_.arena.write(level_.firsts[piece.partition], piece.arena, piece.size);
  }
}

} // namespace simd
} // namespace pointhaptics
