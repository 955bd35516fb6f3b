#include "Core/Resample/TransformedBounds.h"

#include "Core/Resample/Kernel/VoxelKernel.h"

#include <algorithm>
#include <mutex>
#include <type_traits>

namespace pointhaptics
{

Bounds transformedBounds(const PointView& points, const AffineTransform& transform, const Executor& executor,
  ProgressObserver* observer)
{
  Bounds box;
  std::mutex mutex;
  const simd::Kernels& kernels = simd::kernelsFor(InstructionSet::Automatic);
  constexpr std::int64_t kGrain = 1 << 14;
  const auto include = [&](std::int64_t begin, std::int64_t end)
  {
    double local[6] = { INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY, -INFINITY };
    const auto includeAll = [&](const auto* from)
    {
      using Real = std::decay_t<decltype(*from)>;
      const std::int64_t stride = points.stride();
      kernels.of<Real>().bounds(transform.m, from + stride * begin, end - begin, stride, local);
    };
    points.floats() ? includeAll(points.floats()) : includeAll(points.doubles());
    if (local[0] <= local[1])
    {
      const std::lock_guard<std::mutex> lock(mutex);
      box.include({ local[0], local[2], local[4] });
      box.include({ local[1], local[3], local[5] });
    }
  };
  PointProgress progress(observer, points.size(), 1);
  forReportedSlices(points.size(), progress,
    [&](std::int64_t first, std::int64_t last)
    {
      forRange(executor, last - first, kGrain,
        [&](std::int64_t begin, std::int64_t end) { include(first + begin, first + end); });
    });
  return box;
}

} // namespace pointhaptics
