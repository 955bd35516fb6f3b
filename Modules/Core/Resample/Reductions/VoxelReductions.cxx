#include "Core/Resample/Reductions/VoxelReductions.h"

#include <numeric>

namespace pointhaptics
{
namespace simd
{

VoxelReductions::VoxelReductions(const VoxelRequest& request, const std::vector<AttributeRequest>& arrays,
  const PayloadLayout& payloads, int fractionBits, std::int64_t* voxelIndex)
  : payloads_(payloads)
  , voxelIndex_(voxelIndex)
{
  for (const AttributeRequest& array : arrays)
  {
    reducers_.push_back(AttributeReducer::create(array, request.transform, request.instructions));
    views_.push_back(array.view);
  }
  if (keepsPoints(request.representative))
  {
    nearest_.emplace(request, fractionBits);
  }
}

/// Fetches what addTuples() and note() touch, in time for that.
void VoxelReductions::fetch(const std::int64_t* points, int count) const
{
  for (int i = 0; voxelIndex_ && i < count; ++i)
  {
    fetchToWrite(voxelIndex_ + points[i]);
  }
  // Points in the order of their memory need no fetching.
  const bool readsArrays = std::size_t(payloads_.count) < views_.size(); // else points may have no numbers
  const bool areScattered = readsArrays && count > 0 && points[count - 1] - points[0] != count - 1;
  for (auto a = std::size_t(payloads_.count); areScattered && a < views_.size(); ++a)
  {
    const AttributeView& view = views_[a];
    const auto* const first = static_cast<const char*>(view.values);
    const std::int64_t step = view.step();
    const std::int64_t last = view.tupleBytes() - 1;
    for (int i = 0; i < count; ++i)
    {
      const char* const tuple = first + step * points[i];
      simd::fetch(tuple);
      simd::fetch(tuple + last);
    }
  }
}

void VoxelReductions::note(
  const std::int64_t* points, const std::int64_t* voxels, int count, std::int64_t first) const
{
  for (int i = 0; voxelIndex_ && i < count; ++i)
  {
    voxelIndex_[points[i]] = first + voxels[i];
  }
}

/// Tuples that are in @p payloads are taken from there.
void VoxelReductions::addTuples(
  const std::uint32_t* payloads, const std::int64_t* points, const std::int64_t* voxels, int count)
{
  std::int64_t places[kBlockRecords];
  std::iota(places, places + (payloads_.count > 0 ? count : 0), 0);
  for (std::size_t i = 0; i < reducers_.size(); ++i)
  {
    const bool isPayload = i < std::size_t(payloads_.count);
    AttributeReducer::Tuples tuples = { static_cast<const char*>(views_[i].values), views_[i].step() };
    if (isPayload)
    {
      tuples = { reinterpret_cast<const char*>(payloads) + payloads_.arrays[i].offset,
        std::int64_t(sizeof(std::uint32_t)) * payloads_.words };
    }
    reducers_[i]->add(tuples, isPayload ? places : points, voxels, count);
  }
}

void VoxelReductions::write(VoxelWriter& writer, std::size_t first) const
{
  for (std::size_t i = 0; i < reducers_.size(); ++i)
  {
    void* const to = i < writer.attributes() ? writer.attribute(i, first) : writer.pointsFrom(first);
    reducers_[i]->write(writer.counts() + first, to);
  }
  if (nearest_)
  {
    nearest_->write(writer, first);
  }
}

std::vector<VoxelTally> VoxelReductions::takeTallies()
{
  std::vector<VoxelTally> tallies;
  for (const auto& reducer : reducers_)
  {
    tallies.push_back(reducer->takeTally());
  }
  return tallies;
}

} // namespace simd
} // namespace pointhaptics
