#include "PCL/RecordVoxels.h"

#include "SmpExecutor.h"

#include "Core/Base/Buffer.h"
#include "Core/Resample/VoxelMean.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointhaptics
{
namespace
{

const Executor& executorFor(unsigned threads)
{
  static const Executor one;
  static const SmpExecutor all;
  return threads == 1 ? one : static_cast<const Executor&>(all);
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

/// Where the engine writes the means.
class MeansAllocator : public OutputAllocator
{
public:
  void* allocate(Part part, std::size_t bytes) override
  {
    Buffer<std::uint64_t>& buffer = buffers_[std::size_t(part)];
    buffer.reserve(bytes / sizeof(std::uint64_t) + 1);
    return buffer.data();
  }
  const void* memory() const { return buffers_[std::size_t(Part::Means)].data(); }

private:
  std::array<Buffer<std::uint64_t>, 3> buffers_; ///< One for each part.
};

AttributeRequest requestFor(const RecordCloud& cloud, const RecordField& field)
{
  AttributeRequest request;
  request.view = { cloud.records + field.offset, field.type, field.components, cloud.size,
    std::int64_t(cloud.step) };
  request.statistic = field.kind == FieldKind::Category ? AttributeStatistic::Mode
    : field.kind == FieldKind::Normal                   ? AttributeStatistic::Normal
                                                        : AttributeStatistic::Mean;
  return request;
}

}

struct RecordVoxels::Implementation
{
  VoxelResampler engine;
  MeansAllocator means;
  RecordVoxelSettings settings;
  VoxelRequest request;
  std::vector<RecordField> fields;
  std::vector<std::int64_t> kept; ///< Voxels that are not left out; empty: all are kept.
  std::vector<std::uint64_t> keys;
  std::array<std::int64_t, 3> first{};
  std::int64_t size = 0;

  Status run(const RecordCloud& cloud, const Executor& executor);
  void choose();
  template <typename Real>
  void writeMeans(char* records, std::size_t step, const std::array<std::size_t, 3>& xyz) const;
  /// Copies of kept voxels' tuples to records.
  void scatter(const char* packed, std::size_t bytes, char* to, std::size_t step) const
  {
    for (std::int64_t i = 0; i < size; ++i)
    {
      const std::int64_t voxel = kept.empty() ? i : kept[std::size_t(i)];
      std::memcpy(to + step * std::size_t(i), packed + bytes * std::size_t(voxel), bytes);
    }
  }
};

RecordVoxels::RecordVoxels()
  : implementation_(std::make_unique<Implementation>())
{
}

RecordVoxels::~RecordVoxels() = default;

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
    std::vector<std::uint64_t> all(std::size_t(engine.size()));
    engine.copyKeys(0, all.data());
    keys.resize(std::size_t(size));
    scatter(reinterpret_cast<const char*>(all.data()), sizeof(std::uint64_t),
      reinterpret_cast<char*>(keys.data()), sizeof(std::uint64_t));
  }
}

Status RecordVoxels::Implementation::run(const RecordCloud& cloud, const Executor& executor)
{
  std::vector<float> floats;
  std::vector<double> doubles;
  request = VoxelRequest();
  request.singlePrecision = cloud.type == ScalarType::Float;
  request.points = request.singlePrecision ? viewOf(cloud, floats) : viewOf(cloud, doubles);
  const Bounds box = transformedBounds(request.points, request.transform, executor);
  if (box.empty())
  {
    return Status::Empty;
  }
  Status status = alignedLattice(settings.leaf, box, request.lattice, first);
  if (status != Status::Ok)
  {
    return status;
  }
  request.allocator = &means;
  request.keys = settings.keepKeys;
  for (const RecordField& field : fields)
  {
    request.attributes.push_back(requestFor(cloud, field));
  }
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
  if (settings.threads < 2)
  {
    return mine.run(cloud, executorFor(settings.threads));
  }
  Status status = Status::Ok;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(int(std::min(settings.threads, 1u << 16))),
    [&] { status = mine.run(cloud, executorFor(settings.threads)); });
  return status;
}

std::int64_t RecordVoxels::size() const
{
  return implementation_->size;
}

template <typename Real>
void RecordVoxels::Implementation::writeMeans(
  char* records, std::size_t step, const std::array<std::size_t, 3>& xyz) const
{
  const auto* mean = static_cast<const Real*>(means.memory());
  const bool together = xyz[1] == xyz[0] + sizeof(Real) && xyz[2] == xyz[1] + sizeof(Real);
  for (std::int64_t i = 0; i < size; ++i, records += step)
  {
    const Real* from = mean + 3 * (kept.empty() ? i : kept[std::size_t(i)]);
    if (together)
    {
      std::memcpy(records + xyz[0], from, 3 * sizeof(Real));
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      std::memcpy(records + xyz[axis], from + axis, sizeof(Real));
    }
  }
}

void RecordVoxels::write(char* records, std::size_t step, const std::array<std::size_t, 3>& xyz,
  const std::vector<std::size_t>& offsets) const
{
  const Implementation& mine = *implementation_;
  if (mine.size == 0)
  {
    return;
  }
  mine.request.singlePrecision ? mine.writeMeans<float>(records, step, xyz)
                               : mine.writeMeans<double>(records, step, xyz);
  for (std::size_t i = 0; i < mine.fields.size(); ++i)
  {
    mine.scatter(static_cast<const char*>(mine.engine.attribute(0, i)), bytesOf(mine.fields[i]),
      records + offsets[i], step);
  }
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
