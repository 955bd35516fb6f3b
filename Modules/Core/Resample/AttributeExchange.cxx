// Sums and tuples of voxels as bytes, for processes that share the points of a cloud. Numbers are in the
// order of the machine: all processes of a job run on machines of one kind.
#include "Core/Resample/AttributeMean.h"
#include "Core/Resample/AttributeTuples.h"

#include <algorithm>
#include <cstring>

namespace pointhaptics
{
namespace
{

template <typename T>
void put(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// @return false where @p bytes end before.
template <typename T>
bool take(std::string_view& bytes, T& value)
{
  if (bytes.size() < sizeof value)
  {
    return false;
  }
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return true;
}

}

void AttributeMean::serialize(std::int64_t first, std::int64_t last, std::string& bytes) const
{
  const auto components = std::size_t(view_.components);
  const std::size_t words = components * std::size_t(lanes_);
  const auto begin = std::size_t(first);
  const auto voxels = std::size_t(last - first);
  bytes.append(
    reinterpret_cast<const char*>(sums_.data() + begin * words), voxels * words * sizeof(std::int64_t));
  if (range_.hasNonFinite)
  {
    bytes.append(reinterpret_cast<const char*>(special_.data() + begin * components), voxels * components);
  }
}

bool AttributeMean::merge(std::string_view bytes, const std::vector<std::int64_t>& voxels)
{
  const auto components = std::size_t(view_.components);
  const std::size_t words = components * std::size_t(lanes_);
  const std::size_t ofSums = voxels.size() * words * sizeof(std::int64_t);
  if (bytes.size() != ofSums + (range_.hasNonFinite ? voxels.size() * components : 0))
  {
    return false;
  }
  const char* from = bytes.data();
  for (const std::int64_t voxel : voxels)
  {
    std::int64_t* to = sums_.data() + std::size_t(voxel) * words;
    for (std::size_t w = 0; w < words; ++w, from += sizeof(std::int64_t))
    {
      std::int64_t sum;
      std::memcpy(&sum, from, sizeof sum);
      to[w] += sum;
    }
  }
  for (std::size_t v = 0; range_.hasNonFinite && v < voxels.size(); ++v)
  {
    std::uint8_t* to = special_.data() + std::size_t(voxels[v]) * components;
    for (std::size_t c = 0; c < components; ++c)
    {
      to[c] |= std::uint8_t(*from++);
    }
  }
  return true;
}

template <typename T>
void AttributeTuples::serializeVoxel(std::int64_t voxel, std::string& bytes) const
{
  put(bytes, end(voxel) - begin(voxel));
  std::vector<decltype(orderedKey(T()))> keys;
  for (int c = 0; c < view_.components; ++c)
  {
    keys.clear();
    for (std::int64_t i = begin(voxel); i < end(voxel); ++i)
    {
      keys.push_back(orderedKey(tuple<T>(i)[c]));
    }
    std::sort(keys.begin(), keys.end());
    for (auto first = keys.begin(); first != keys.end();)
    {
      const auto next = std::upper_bound(first, keys.end(), *first);
      put(bytes, valueOfKey<T>(*first));
      put(bytes, std::int64_t(next - first));
      first = next;
    }
  }
}

void AttributeTuples::serialize(std::int64_t first, std::int64_t last, std::string& bytes) const
{
  withType(view_.type,
    [&](auto example)
    {
      for (std::int64_t v = first; v < last; ++v)
      {
        serializeVoxel<decltype(example)>(v, bytes);
      }
    });
}

/// Components come in the order of their values: modes and medians are of each component alone.
template <typename T>
bool AttributeTuples::mergeVoxel(std::string_view& bytes, std::int64_t voxel)
{
  std::int64_t points = 0;
  std::int64_t& end = ends_[std::size_t(voxel)];
  if (!take(bytes, points) || points < 0 || points > room_ - end)
  {
    return false;
  }
  for (int c = 0; c < view_.components; ++c)
  {
    for (std::int64_t i = 0; i < points;)
    {
      T value;
      std::int64_t count = 0;
      if (!take(bytes, value) || !take(bytes, count) || count < 1 || count > points - i)
      {
        return false;
      }
      for (const std::int64_t last = i + count; i < last; ++i)
      {
        tuple<T>(end + i)[c] = value;
      }
    }
  }
  end += points;
  return true;
}

bool AttributeTuples::merge(std::string_view bytes, const std::vector<std::int64_t>& voxels)
{
  bool fits = true;
  withType(view_.type,
    [&](auto example)
    {
      for (std::size_t v = 0; fits && v < voxels.size(); ++v)
      {
        fits = mergeVoxel<decltype(example)>(bytes, voxels[v]);
      }
    });
  return fits && bytes.empty();
}

} // namespace pointhaptics
