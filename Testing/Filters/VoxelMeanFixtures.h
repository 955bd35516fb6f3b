/// @file
/// Shared by the tests of the resampler: its settings, and its answer beside the long double twin's.
#pragma once

#include "FilterFixtures.h"

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Reference/ReferenceVoxelMean.h"

#include "vtkCommand.h"
#include "vtkFieldData.h"
#include "vtkVoxelMeanResampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace trial
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A lattice of n^3 voxels over the unit cube.
inline void useUnitCube(vtkVoxelMeanResampler* resampler, int n)
{
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
  resampler->SetDimensions(n, n, n);
}

inline vtkDataArray* countsOf(vtkPolyData* output)
{
  return output->GetPointData()->GetArray("VoxelPointCount");
}

inline vtkIdType sum(vtkDataArray* counts)
{
  vtkIdType total = 0;
  for (vtkIdType i = 0; i < counts->GetNumberOfTuples(); ++i)
  {
    total += vtkIdType(counts->GetTuple1(i));
  }
  return total;
}

/// Every point of the input is in one voxel, or counted as clipped or invalid.
inline void expectEveryPointOnce(vtkVoxelMeanResampler* resampler, vtkIdType points)
{
  EXPECT_EQ((points ? sum(countsOf(resampler->GetOutput())) : 0) + resampler->GetNumberOfClippedPoints() +
      resampler->GetNumberOfInvalidPoints(),
    points);
}

/// The error of a filter set to fail: said, with these words of the cure, and a valid empty output.
inline void expectError(vtkVoxelMeanResampler* resampler, const std::string& cure)
{
  Ear errors(resampler, vtkCommand::ErrorEvent);
  resampler->Update();
  EXPECT_GE(errors.count, 1);
  EXPECT_NE(errors.last.find(cure), std::string::npos) << "no '" << cure << "' in: " << errors.last;
  ASSERT_NE(resampler->GetOutput(), nullptr);
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfCells(), 0);
}

/// The lattice that an output's field data state; @p resampler gives the end of its workspace.
inline pointhaptics::Lattice latticeOf(vtkVoxelMeanResampler* resampler, vtkPolyData* output)
{
  pointhaptics::Lattice lattice;
  vtkFieldData* field = output->GetFieldData();
  const double* bounds = resampler->GetWorkspaceBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    lattice.origin[axis] = field->GetArray("LatticeOrigin")->GetComponent(0, axis);
    lattice.spacing[axis] = field->GetArray("LatticeSpacing")->GetComponent(0, axis);
    lattice.dimensions[axis] = std::int64_t(field->GetArray("LatticeDimensions")->GetComponent(0, axis));
    if (!resampler->GetAutomaticWorkspace() && resampler->GetVoxelSize() > 0.0)
    {
      lattice.end[axis] = (bounds[2 * axis + 1] - bounds[2 * axis]) / resampler->GetVoxelSize();
    }
  }
  return lattice;
}

inline pointhaptics::AffineTransform transformOf(vtkPolyData* output)
{
  pointhaptics::AffineTransform transform;
  for (int i = 0; i < 12; ++i)
  {
    transform.m[i / 4][i % 4] =
      output->GetFieldData()->GetArray("ModelToWorkspace")->GetVariantValue(i).ToDouble();
  }
  return transform;
}

/// Expected result of a resampler's last update by the definition, in long double.
struct Oracle
{
  std::vector<double> coordinates;
  pointhaptics::Lattice lattice;
  pointhaptics::AffineTransform transform;
  pointhaptics::reference::VoxelMap map;
  double largest[3] = { 0, 0, 0 }; ///< Largest sum of absolute products of the transform, per output axis.
};

inline Oracle oracleOf(vtkVoxelMeanResampler* resampler, vtkPointSet* input)
{
  Oracle oracle;
  const vtkIdType n = input->GetNumberOfPoints();
  if (n == 0) // nothing to make a lattice of
  {
    return oracle;
  }
  oracle.coordinates.resize(std::size_t(3 * n));
  for (vtkIdType i = 0; i < n; ++i)
  {
    input->GetPoint(i, &oracle.coordinates[std::size_t(3 * i)]);
  }
  oracle.lattice = latticeOf(resampler, resampler->GetOutput());
  oracle.transform = transformOf(resampler->GetOutput());
  oracle.map = pointhaptics::reference::voxelMeans(
    pointhaptics::PointView(oracle.coordinates.data(), n), oracle.transform, oracle.lattice);
  for (const auto& entry : oracle.map.voxels)
  {
    for (const std::int64_t i : entry.second.members)
    {
      const double* p = &oracle.coordinates[std::size_t(3 * i)];
      for (int axis = 0; axis < 3; ++axis)
      {
        const double* row = oracle.transform.m[axis];
        oracle.largest[axis] = std::max(oracle.largest[axis],
          std::fabs(row[0] * p[0]) + std::fabs(row[1] * p[1]) + std::fabs(row[2] * p[2]) + std::fabs(row[3]));
      }
    }
  }
  return oracle;
}

/// Rounding of one transformed coordinate and of its continuous index in double, in units of the coordinate.
inline double coordinateRounding(const Oracle& oracle, int axis)
{
  constexpr double unit = std::numeric_limits<double>::epsilon();
  return (oracle.transform.isIdentity() ? 0.0 : 3.0 * unit * oracle.largest[axis]) +
    unit * double(oracle.lattice.dimensions[axis]) * oracle.lattice.spacing[axis];
}

/// Unit in the last place of @p value in the type of the output points.
inline double unitInTheLastPlace(double value, int type)
{
  return type == VTK_FLOAT
    ? double(std::nextafter(std::fabs(float(value)), INFINITY) - std::fabs(float(value)))
    : std::nextafter(std::fabs(value), INFINITY) - std::fabs(value);
}

/// The promise of the resampler's header: voxels and counts of the definition; means within 2^-31 voxel, the
/// rounding of a coordinate in double, and one unit in the last place of the output; second moments within
/// 2^-30 squared voxel and the same rounding.
inline void expectAgrees(vtkVoxelMeanResampler* resampler, vtkPointSet* input)
{
  vtkPolyData* output = resampler->GetOutput();
  expectValid(output);
  if (input->GetNumberOfPoints() == 0)
  {
    EXPECT_EQ(output->GetNumberOfPoints(), 0);
    return;
  }
  const Oracle oracle = oracleOf(resampler, input);
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), oracle.map.clippedPoints);
  EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), oracle.map.invalidPoints);
  ASSERT_EQ(output->GetNumberOfPoints(), vtkIdType(oracle.map.voxels.size()));
  vtkDataArray* moments = output->GetPointData()->GetArray("VoxelCovariance");
  ASSERT_EQ(moments != nullptr, resampler->GetComputeCovariance());
  const int type = output->GetPoints()->GetDataType();
  const pointhaptics::Vec3 h = oracle.lattice.spacing;
  vtkIdType v = 0;
  for (const auto& entry : oracle.map.voxels)
  {
    const auto& voxel = entry.second;
    ASSERT_EQ(vtkIdType(countsOf(output)->GetTuple1(v)), vtkIdType(voxel.members.size())) << "voxel " << v;
    double rounding[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      rounding[axis] = coordinateRounding(oracle, axis);
      const double expected = double(voxel.mean[axis]);
      const double bound = 0x1p-31 * h[axis] + rounding[axis] + unitInTheLastPlace(expected, type);
      ASSERT_LE(double(std::fabs(output->GetPoint(v)[axis] - voxel.mean[axis])), bound)
        << "mean of voxel " << v << ", axis " << axis << ": " << output->GetPoint(v)[axis] << " for "
        << expected;
    }
    const int axes[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 1, 2 }, { 0, 2 } };
    for (int m = 0; moments && m < 6; ++m)
    {
      const int a = axes[m][0];
      const int b = axes[m][1];
      const double bound = 0x1p-30 * h[a] * h[b] + rounding[a] * h[b] + rounding[b] * h[a];
      ASSERT_LE(double(std::fabs(moments->GetComponent(v, m) - voxel.covariance[m])), bound)
        << "moment " << m << " of voxel " << v;
    }
    ++v;
  }
}

/// Updates and compares with the definition; no error may be said.
inline void expectRight(vtkVoxelMeanResampler* resampler, vtkPolyData* cloud)
{
  Ear errors(resampler, vtkCommand::ErrorEvent);
  resampler->SetInputData(cloud);
  resampler->ComputeCovarianceOn();
  resampler->Update();
  ASSERT_EQ(errors.count, 0) << errors.last;
  expectAgrees(resampler, cloud);
  expectEveryPointOnce(resampler, cloud->GetNumberOfPoints());
}

/// The right answer, or an error with a valid empty output: never a wrong answer.
inline void expectRightOrError(vtkVoxelMeanResampler* resampler, vtkPolyData* cloud)
{
  Ear errors(resampler, vtkCommand::ErrorEvent);
  resampler->SetInputData(cloud);
  resampler->Update();
  if (errors.count > 0)
  {
    EXPECT_GT(errors.last.size(), 30u);
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
    return;
  }
  expectAgrees(resampler, cloud);
}

} // namespace trial
