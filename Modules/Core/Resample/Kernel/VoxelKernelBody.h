/// @file
/// The loops of VoxelKernel.h, written once over the vectors of Core/Simd. Included by one source file per
/// instruction set, each compiled with its own flags: everything here has internal linkage, and nothing of
/// the standard library is called, so that no function compiled for one set can stand in for another's.
#pragma once

#include "Core/Resample/Kernel/BoundsBody.h"
#include "Core/Resample/Kernel/CellSumBody.h"
#include "Core/Resample/Kernel/MeanBody.h"
#include "Core/Resample/Kernel/QuantizeBody.h"
#include "Core/Resample/Kernel/SelectBody.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics::simd
{
namespace
{

template <typename Real>
constexpr PointKernels<Real> kPointKernels = { &partition<Real>, &packedMeans<Real>, &bounds<Real> };

constexpr Kernels kKernels = { kPointKernels<float>, kPointKernels<double>, &cellsOf, &setOccupied,
  &rankWords, &accumulate, &covariances, kSelect<false>, kSelect<true> };

}
} // namespace pointhaptics::simd
