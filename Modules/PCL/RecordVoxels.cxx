#include "PCL/RecordVoxels.h"

#include "SmpExecutor.h"

#include "Core/Distributed/SharedVoxels.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/TransformedBounds.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointhaptics
{
namespace
{

/// Calls work(executor) with at most so many threads; 0: as vtkSMPTools is set.
template <typename Work>
void withThreads(unsigned threads, Work&& work)
{
  threads == 1 ? work(Executor()) : work(SmpExecutor(threads));
}

std::size_t bytesOf(const RecordField& field)
{
  return std::size_t(bytesOf(field.type)) * std::size_t(field.components);
}

template <typename Real>
bool isStrided(const RecordCloud& cloud)
{
  return cloud.step % sizeof(Real) == 0 &&
    reinterpret_cast<std::uintptr_t>(cloud.records + cloud.xyz[0]) % alignof(Real) == 0 &&
    cloud.xyz[1] == cloud.xyz[0] + sizeof(Real) && cloud.xyz[2] == cloud.xyz[1] + sizeof(Real);
}

/// The coordinates where they are, or copied to @p copy.
template <typename Real>
PointView viewOf(const RecordCloud& cloud, std::vector<Real>& copy)
{
  if (isStrided<Real>(cloud))
  {
    return { reinterpret_cast<const Real*>(cloud.records + cloud.xyz[0]), cloud.size,
      std::int64_t(cloud.step / sizeof(Real)) };
  }
  copy.resize(3 * std::size_t(cloud.size));
  for (std::size_t i = 0; i < std::size_t(cloud.size); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      std::memcpy(&copy[3 * i + axis], cloud.records + cloud.step * i + cloud.xyz[axis], sizeof(Real));
    }
  }
  return { copy.data(), cloud.size };
}

/// Records that are written together stay in the first cache until all of their fields have been.
constexpr std::int64_t kBlock = 1024;

/// A field of the voxels, and where it goes.
struct Written
{
  const char* tuples;
  std::size_t every; ///< Bytes from one tuple to the next.
  std::size_t bytes; ///< Bytes that are copied of each tuple.
  char* to;          ///< In the first record.

  /// To records @p first to before @p last, the tuples of the voxels @p kept, or of all where that is null.
  void copy(const std::int64_t* kept, std::int64_t first, std::int64_t last, std::size_t step) const
  {
    for (std::int64_t i = first; i < last; ++i)
    {
      std::memcpy(to + step * std::size_t(i), tuples + every * std::size_t(kept ? kept[i] : i), bytes);
    }
  }
};

/// Adds the copy of means @p xyz, at the offsets @p places of the records.
void addMeans(const char* xyz, std::size_t bytes, char* records, const std::array<std::size_t, 3>& places,
  std::vector<Written>& written)
{
  if (places[1] == places[0] + bytes && places[2] == places[1] + bytes)
  {
    written.push_back({ xyz, 3 * bytes, 3 * bytes, records + places[0] });
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    written.push_back({ xyz + axis * bytes, 3 * bytes, bytes, records + places[axis] });
  }
}

}

struct RecordVoxels::Implementation
{
  VoxelResampler engine;
  RecordVoxelSettings settings;
  VoxelRequest request;
  std::vector<RecordField> fields;
  std::vector<std::int64_t> kept; ///< Voxels that are not left out; empty: all are kept.
  std::vector<std::uint64_t> keys;
  std::array<std::int64_t, 3> first{};
  std::int64_t size = 0;

  Status run(const RecordCloud& cloud, const Executor& executor);
  void choose();
};

RecordVoxels::RecordVoxels()
  : implementation_(std::make_unique<Implementation>())
{
}

RecordVoxels::~RecordVoxels() = default;

RecordVoxels::RecordVoxels(RecordVoxels&& other)
  : RecordVoxels()
{
  implementation_.swap(other.implementation_);
}

RecordVoxels& RecordVoxels::operator=(RecordVoxels&& other) noexcept
{
  implementation_.swap(other.implementation_);
  return *this;
}

/// Which voxels are kept.
void RecordVoxels::Implementation::choose()
{
  const std::int64_t* counts = engine.counts();
  for (std::int64_t v = 0; settings.minimumPoints > 1 && v < engine.size(); ++v)
  {
    if (counts[v] >= settings.minimumPoints)
    {
      kept.push_back(v);
    }
  }
  size = settings.minimumPoints > 1 ? std::int64_t(kept.size()) : engine.size();
  if (settings.keepKeys)
  {
    keys.assign(engine.keys(), engine.keys() + engine.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
    {
      keys[i] = keys[std::size_t(kept[i])];
    }
    keys.resize(std::size_t(size));
  }
}

Status RecordVoxels::Implementation::run(const RecordCloud& cloud, const Executor& executor)
{
  std::vector<float> floats;
  std::vector<double> doubles;
  request = VoxelRequest();
  request.singlePrecision = cloud.type == ScalarType::Float;
  request.points = request.singlePrecision ? viewOf(cloud, floats) : viewOf(cloud, doubles);
  for (const RecordField& field : fields)
  {
    const AttributeView view = { cloud.records + field.offset, field.type, field.components, cloud.size,
      std::int64_t(cloud.step) };
    request.attributes.push_back({ view, field.statistic });
  }
  const Bounds box = transformedBounds(request.points, {}, executor);
  if (box.empty())
  {
    return Status::Empty;
  }
  Status status = alignedLattice(settings.leaf, box, request.lattice, first);
  if (status != Status::Ok)
  {
    return status;
  }
  request.keys = settings.keepKeys;
  status = engine.run(request, executor);
  if (status == Status::Ok)
  {
    choose();
  }
  return status;
}

Status RecordVoxels::run(
  const RecordCloud& cloud, const std::vector<RecordField>& fields, const RecordVoxelSettings& settings)
{
  Implementation& mine = *implementation_;
  mine.settings = settings;
  mine.fields = fields;
  mine.kept.clear();
  mine.keys.clear();
  mine.size = 0;
  Status status = Status::Ok;
  withThreads(settings.threads, [&](const Executor& executor) { status = mine.run(cloud, executor); });
  return status;
}

std::int64_t RecordVoxels::size() const
{
  return implementation_->size;
}

/// The fields of a record lie together: each record is written once.
void RecordVoxels::write(char* records, std::size_t step, const std::array<std::size_t, 3>& xyz,
  const std::vector<std::size_t>& offsets) const
{
  const Implementation& mine = *implementation_;
  if (mine.size == 0)
  {
    return;
  }
  const std::int64_t* kept = mine.kept.empty() ? nullptr : mine.kept.data();
  withThreads(mine.settings.threads,
    [&](const Executor& executor)
    {
      std::vector<Written> written;
      mine.request.singlePrecision
        ? addMeans(reinterpret_cast<const char*>(mine.engine.floats()), sizeof(float), records, xyz, written)
        : addMeans(
            reinterpret_cast<const char*>(mine.engine.doubles()), sizeof(double), records, xyz, written);
      for (std::size_t i = 0; i < offsets.size(); ++i)
      {
        const std::size_t bytes = bytesOf(mine.fields[i]);
        written.push_back(
          { static_cast<const char*>(mine.engine.attribute(i)), bytes, bytes, records + offsets[i] });
      }
      forRange(executor, mine.size, 16 * kBlock,
        [&](std::int64_t begin, std::int64_t end)
        {
          for (std::int64_t first = begin; first < end; first += kBlock)
          {
            for (const Written& field : written)
            {
              field.copy(kept, first, std::min(first + kBlock, end), step);
            }
          }
        });
    });
}

const Lattice& RecordVoxels::lattice() const
{
  return implementation_->request.lattice;
}

const std::array<std::int64_t, 3>& RecordVoxels::first() const
{
  return implementation_->first;
}

std::int64_t RecordVoxels::indexOf(const std::array<std::int64_t, 3>& voxel) const
{
  const Implementation& mine = *implementation_;
  std::array<std::int64_t, 3> inside{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    inside[axis] = voxel[axis] - mine.first[axis];
    if (inside[axis] < 0 || inside[axis] >= mine.request.lattice.dimensions[axis])
    {
      return -1;
    }
  }
  const std::uint64_t key = mine.request.lattice.key(inside[0], inside[1], inside[2]);
  const auto found = std::lower_bound(mine.keys.begin(), mine.keys.end(), key);
  return found != mine.keys.end() && *found == key ? found - mine.keys.begin() : -1;
}

std::vector<int> RecordVoxels::layout(std::int64_t most) const
{
  const Implementation& mine = *implementation_;
  const auto& n = mine.request.lattice.dimensions;
  if (mine.keys.empty() || n[0] > most / n[1] / n[2])
  {
    return {};
  }
  std::vector<int> numbers;
  numbers.reserve(std::size_t(n[0] * n[1] * n[2]));
  std::size_t next = 0;
  for (std::int64_t k = 0; k < n[2]; ++k)
  {
    for (std::int64_t j = 0; j < n[1]; ++j)
    {
      for (std::int64_t i = 0; i < n[0]; ++i)
      {
        const bool isActive = next < mine.keys.size() && mine.keys[next] == mine.request.lattice.key(i, j, k);
        numbers.push_back(isActive ? int(next) : -1);
        next += isActive;
      }
    }
  }
  return numbers;
}

std::array<std::int64_t, 3> RecordVoxels::voxelOf(const Vec3& point, const Vec3& leaf)
{
  constexpr double kFarAway = 1e12; // in no lattice
  Lattice aboutOrigin;
  aboutOrigin.spacing = leaf;
  Vec3 index = aboutOrigin.continuousIndex(point);
  for (int axis = 0; axis < 3; ++axis)
  {
    index[axis] = std::isnan(index[axis]) ? -kFarAway : std::clamp(index[axis], -kFarAway, kFarAway);
  }
  return Lattice::voxelAt(index);
}

} // namespace pointhaptics
