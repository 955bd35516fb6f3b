/// @file
/// The filter under test, for the studies that drive it themselves.
#pragma once

#include "Benchmark/Resample/Rivals/Rival.h"

#include "vtkVoxelMeanResampler.h"

namespace pointhaptics
{
namespace bench
{
namespace resample
{

/// Sets the lattice of @p task; with the automatic workspace only the size of its voxels.
void setTask(vtkVoxelMeanResampler* filter, const ResampleTask& task, bool automaticWorkspace);
/// Means, counts and lattice of an output.
ResampleAnswer answerOf(vtkPolyData* output);

} // namespace resample
} // namespace bench
} // namespace pointhaptics
