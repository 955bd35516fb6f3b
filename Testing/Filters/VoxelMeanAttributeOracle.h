/// @file
/// Voxel values of point arrays by the definition, in long double, beside the resampler's.
#pragma once

#include "VoxelMeanFixtures.h"

#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace trial
{

/// One value, exactly: 64-bit integers do not pass through double.
inline long double exactValue(vtkDataArray* array, vtkIdType tuple, int component)
{
  const vtkIdType index = tuple * array->GetNumberOfComponents() + component;
  switch (array->GetDataType())
  {
    case VTK_LONG:
    case VTK_LONG_LONG:
    case VTK_ID_TYPE:
      return static_cast<long double>(array->GetVariantValue(index).ToLongLong());
    case VTK_UNSIGNED_LONG:
    case VTK_UNSIGNED_LONG_LONG:
      return static_cast<long double>(array->GetVariantValue(index).ToUnsignedLongLong());
    default:
      return static_cast<long double>(array->GetComponent(tuple, component));
  }
}

/// Means as promised: integers are nearest to the exact mean; float and double within one unit in the last
/// place of it, and two of double's in the voxel's largest value. Finite values only.
inline void expectMeansAgree(vtkDataArray* in, vtkDataArray* out, const Oracle& oracle)
{
  ASSERT_NE(in, nullptr);
  ASSERT_NE(out, nullptr) << in->GetName();
  SCOPED_TRACE(std::string(in->GetName()) + ", " + in->GetDataTypeAsString());
  ASSERT_EQ(out->GetDataType(), in->GetDataType());
  ASSERT_EQ(out->GetNumberOfComponents(), in->GetNumberOfComponents());
  ASSERT_EQ(out->GetNumberOfTuples(), vtkIdType(oracle.map.voxels.size()));
  const bool real = in->GetDataType() == VTK_FLOAT || in->GetDataType() == VTK_DOUBLE;
  vtkIdType v = 0;
  for (const auto& entry : oracle.map.voxels)
  {
    const auto& members = entry.second.members;
    for (int c = 0; c < in->GetNumberOfComponents(); ++c)
    {
      const long double first = exactValue(in, members[0], c);
      long double sum = 0;
      long double largest = 0;
      for (const std::int64_t i : members)
      {
        const long double value = exactValue(in, i, c);
        sum += value - first;
        largest = std::max(largest, std::fabs(value));
      }
      const long double beyondFirst = sum / static_cast<long double>(members.size());
      const double mean = double(first + beyondFirst);
      const long double error = std::fabs(exactValue(out, v, c) - first - beyondFirst);
      const long double bound =
        real ? unitInTheLastPlace(mean, in->GetDataType()) + 0x1p-51L * largest : 0.5L + 0x1p-30L;
      ASSERT_LE(double(error), double(bound))
        << "mean of voxel " << v << ", component " << c << ": " << out->GetComponent(v, c) << " for " << mean
        << " of " << members.size();
    }
    ++v;
  }
}

/// The value most points of the voxel have, the smallest one on a tie.
inline void expectMajorityAgrees(vtkDataArray* in, vtkDataArray* out, const Oracle& oracle)
{
  ASSERT_NE(in, nullptr);
  ASSERT_NE(out, nullptr) << in->GetName();
  SCOPED_TRACE(in->GetName());
  ASSERT_EQ(out->GetDataType(), in->GetDataType());
  ASSERT_EQ(out->GetNumberOfTuples(), vtkIdType(oracle.map.voxels.size()));
  vtkIdType v = 0;
  for (const auto& entry : oracle.map.voxels)
  {
    std::map<long double, int> votes;
    for (const std::int64_t i : entry.second.members)
    {
      ++votes[exactValue(in, i, 0)];
    }
    const auto winner = std::max_element(
      votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    ASSERT_EQ(exactValue(out, v, 0), winner->first) << "voxel " << v;
    ++v;
  }
}

} // namespace trial
