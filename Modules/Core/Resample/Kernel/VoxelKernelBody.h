/// @file
/// The loops of VoxelKernel.h, written once over a class of vector operations. Included by one source file
/// per instruction set, each compiled with its own flags: everything here has internal linkage, and nothing
/// of the standard library is called, so that no function compiled for one set can stand in for another's.
#pragma once

#include "Core/Resample/Kernel/BoundsBody.h"
#include "Core/Resample/Kernel/CellSumBody.h"
#include "Core/Resample/Kernel/CovarianceBody.h"
#include "Core/Resample/Kernel/MeanBody.h"
#include "Core/Resample/Kernel/QuantizeBody.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

template <class V>
Kernels makeKernels()
{
  return { &partition<V, float>, &partition<V, double>, &cellsOf<V>, &setOccupied, &V::rankWords,
    &rankTouchedWords<V>, &rank<V>, &accumulate<V>, &packedMeans<V, float>, &packedMeans<V, double>,
    &V::covariances, &means<V, float>, &means<V, double>, &bounds<V, float>, &bounds<V, double> };
}

}
} // namespace simd
} // namespace pointhaptics
