#include "Core/Resample/Reductions/VoxelReductions.h"

#include <numeric>
#include <utility>

namespace pointhaptics::simd
{

std::array<Vec3, 3> normalColumns(const AffineTransform& transform)
{
  return { transform.applyToNormal({ 1, 0, 0 }), transform.applyToNormal({ 0, 1, 0 }),
    transform.applyToNormal({ 0, 0, 1 }) };
}

VoxelReductions::VoxelReductions(const VoxelRequest& request, const std::vector<AttributeRequest>& arrays,
  const PayloadLayout& payloads, int fractionBits, std::int64_t* voxelIndex)
  : payloads_(payloads)
  , voxelIndex_(voxelIndex)
  , kernels_(kernelsFor(request.instructions))
  , columns_(normalColumns(request.transform))
{
  for (const AttributeRequest& array : arrays)
  {
    const AttributeView& view = array.view;
    arrays_.push_back({ view, { view.type, view.components, array.statistic },
      array.range.value_or(AttributeRange()), {}, {} });
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
  const bool readsArrays = std::size_t(payloads_.count) < arrays_.size(); // else points may have no numbers
  const bool areScattered = readsArrays && count > 0 && points[count - 1] - points[0] != count - 1;
  for (auto a = std::size_t(payloads_.count); areScattered && a < arrays_.size(); ++a)
  {
    const AttributeView& view = arrays_[a].view;
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
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    Array& array = arrays_[i];
    const bool isPayload = i < std::size_t(payloads_.count);
    Tuples tuples = { static_cast<const char*>(array.view.values), array.view.step() };
    if (isPayload)
    {
      tuples = { reinterpret_cast<const char*>(payloads) + payloads_.arrays[i].offset,
        std::int64_t(sizeof(std::uint32_t)) * payloads_.words };
    }
    const std::int64_t* const numbers = isPayload ? places : points;
    isSum(array.kind.statistic) ? array.sums.add(array.kind.type, tuples, numbers, voxels, count)
                                : array.tuples.add(tuples, numbers, voxels, count);
  }
}

void VoxelReductions::write(VoxelWriter& writer, std::size_t first) const
{
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    const Array& array = arrays_[i];
    void* const to = i < writer.attributes() ? writer.attribute(i, first) : writer.pointsFrom(first);
    isSum(array.kind.statistic)
      ? array.sums.write(array.kind, 0, counts_.size(), writer.counts() + first, columns_, to)
      : array.tuples.write(kernels_, to);
  }
  if (nearest_)
  {
    nearest_->write(writer, first);
  }
}

std::vector<VoxelTally> VoxelReductions::takeTallies()
{
  std::vector<VoxelTally> tallies;
  for (Array& array : arrays_)
  {
    isSum(array.kind.statistic) ? tallies.push_back({ std::move(array.sums), {} })
                                : tallies.push_back({ {}, array.tuples.tally() });
  }
  return tallies;
}

} // namespace pointhaptics::simd
