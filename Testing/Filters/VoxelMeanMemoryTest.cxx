// Memory of the resampler between updates is bounded by the active voxels and the points.
#include "VoxelMeanCases.h"

#include "Unit/HeapBytes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "vtkDoubleArray.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <string>

namespace
{

/// The bound without an index: 64 bytes a voxel, 16 bytes for each of five million points, a few megabytes.
double boundOf(vtkIdType voxels, vtkIdType points)
{
  return 64.0 * double(voxels) + 16.0 * double(std::min<vtkIdType>(points, 5000000)) + 8 * 1024 * 1024;
}

}

TEST(VoxelMeanMemory, FollowsActiveVoxelsAndPointsNotTheLatticeOrTheThreads)
{
  SKIP_WITHOUT_HEAP();
  const auto cloud = trial::cloudOf(trial::randomPoints(1500000, 91, VTK_FLOAT));
  for (const int threads : { 1, 2, 8, 16 })
  {
    for (const int n : { 10, 300, 4096, 1 << 20 })
    {
      SCOPED_TRACE(std::to_string(threads) + " threads, " + std::to_string(n) + " voxels on an axis");
      const std::size_t before = pointhaptics::heapBytes();
      vtkNew<vtkVoxelMeanResampler> resampler;
      resampler->SetInputData(cloud);
      resampler->SetUsePointIndex(false);
      trial::useUnitCube(resampler, n);
      vtkSMPTools::LocalScope(vtkSMPTools::Config(threads), [&] { resampler->Update(); });
      EXPECT_EQ(trial::sum(trial::countsOf(resampler->GetOutput())), 1500000);
      const vtkIdType voxels = resampler->GetOutput()->GetNumberOfPoints();
      resampler->GetOutput()->Initialize();
      EXPECT_LE(double(pointhaptics::heapBytes() - before), boundOf(voxels, 1500000));
    }
  }
}

TEST(VoxelMeanMemory, KeepsLittleForArraysOfManyMagnitudes)
{
  SKIP_WITHOUT_HEAP();
  const auto cloud = trial::cloudOf(trial::randomPoints(20000, 94, VTK_FLOAT));
  const auto array = trial::addColumns<vtkDoubleArray>(
    cloud, "Weight", 3, [](vtkIdType i, int) { return 1.0 + double(i % 10); });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetUsePointIndex(false);
  trial::useUnitCube(resampler, 100);
  resampler->Update();
  const vtkIdType voxels = resampler->GetOutput()->GetNumberOfPoints();
  ASSERT_GT(voxels, 15000);
  const std::size_t plain = pointhaptics::heapBytes();
  array->SetValue(5, 1e-300);
  array->Modified();
  resampler->Update();
  EXPECT_LE(pointhaptics::heapBytes(), plain + 32 * 3 * std::size_t(voxels));
}

TEST(VoxelMeanMemory, WhatSomebodyHoldsOfAnOutputIsNotWrittenAgain)
{
  // Large enough for the memory of outputs to be used again.
  const auto cloud = trial::cloudOf(trial::randomPoints(60000, 81));
  vtkNew<vtkDoubleArray> shared;
  vtkNew<vtkDoubleArray> expected;
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    resampler->SetDimensions(100, 100, 100);
    resampler->Update();
    vtkDataArray* points = resampler->GetOutput()->GetPoints()->GetData();
    ASSERT_GT(points->GetNumberOfTuples(), 30000);
    shared->ShallowCopy(points);
    expected->DeepCopy(points);
    for (const int n : { 101, 99, 100 })
    {
      resampler->SetDimensions(n, n, n);
      resampler->Update();
    }
  }
  ASSERT_EQ(shared->GetNumberOfValues(), expected->GetNumberOfValues());
  EXPECT_EQ(std::memcmp(shared->GetPointer(0), expected->GetPointer(0),
              std::size_t(expected->GetNumberOfValues()) * sizeof(double)),
    0);
}
