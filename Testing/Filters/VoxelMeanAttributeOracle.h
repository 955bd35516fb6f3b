/// @file
/// Voxel values of point arrays by the definition, in wider numbers, beside the resampler's.
#pragma once

#include "VoxelMeanFixtures.h"

#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace trial
{

/// Holds every 64-bit integer, signed or not, and sums of 2^62 of them.
__extension__ typedef __int128 WideInteger;

inline bool isReal(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

/// One value of an integer array, exactly: 64-bit integers do not pass through double.
inline WideInteger wholeValue(vtkDataArray* array, vtkIdType tuple, int component)
{
  const vtkVariant value = array->GetVariantValue(tuple * array->GetNumberOfComponents() + component);
  const int type = array->GetDataType();
  return type == VTK_UNSIGNED_LONG || type == VTK_UNSIGNED_LONG_LONG ? WideInteger(value.ToUnsignedLongLong())
                                                                     : WideInteger(value.ToLongLong());
}

/// Integers: nearest to the exact mean, either one on a tie.
inline bool isNearestMean(
  vtkDataArray* in, vtkDataArray* out, vtkIdType v, int component, const std::vector<std::int64_t>& members)
{
  const WideInteger n = WideInteger(members.size());
  WideInteger twice = -2 * n * wholeValue(out, v, component);
  for (const std::int64_t i : members)
  {
    twice += 2 * wholeValue(in, i, component);
  }
  return twice <= n && -twice <= n;
}

/// Float and double: within one unit in the last place of the exact mean, and two of double's in the voxel's
/// largest value. Finite values only.
inline bool isCloseToMean(
  vtkDataArray* in, vtkDataArray* out, vtkIdType v, int component, const std::vector<std::int64_t>& members)
{
  const long double first = in->GetComponent(members[0], component);
  long double sum = 0;
  long double largest = 0;
  for (const std::int64_t i : members)
  {
    const long double value = in->GetComponent(i, component);
    sum += value - first;
    largest = std::max(largest, std::fabs(value));
  }
  const long double mean = first + sum / static_cast<long double>(members.size());
  return std::fabs(out->GetComponent(v, component) - mean) <=
    unitInTheLastPlace(double(mean), in->GetDataType()) + 0x1p-51L * largest;
}

/// Type and shape are kept, and every value is the mean of its voxel.
inline void expectMeansAgree(vtkDataArray* in, vtkDataArray* out, const Oracle& oracle)
{
  ASSERT_NE(in, nullptr);
  ASSERT_NE(out, nullptr) << in->GetName();
  SCOPED_TRACE(std::string(in->GetName()) + ", " + in->GetDataTypeAsString());
  ASSERT_EQ(out->GetDataType(), in->GetDataType());
  ASSERT_EQ(out->GetNumberOfComponents(), in->GetNumberOfComponents());
  ASSERT_EQ(out->GetNumberOfTuples(), vtkIdType(oracle.map.voxels.size()));
  vtkIdType v = 0;
  for (const auto& entry : oracle.map.voxels)
  {
    const auto& members = entry.second.members;
    for (int c = 0; c < in->GetNumberOfComponents(); ++c)
    {
      ASSERT_TRUE(isReal(in) ? isCloseToMean(in, out, v, c, members) : isNearestMean(in, out, v, c, members))
        << "voxel " << v << ", component " << c << ": " << out->GetComponent(v, c) << " of " << members.size()
        << " values, the first " << in->GetComponent(members[0], c);
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
    // Reals in these tests are multiples of 1/4.
    const auto label = [](vtkDataArray* array, vtkIdType i)
    { return isReal(array) ? WideInteger(4 * array->GetComponent(i, 0)) : wholeValue(array, i, 0); };
    std::map<WideInteger, int> votes;
    for (const std::int64_t i : entry.second.members)
    {
      ++votes[label(in, i)];
    }
    const auto winner = std::max_element(
      votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    ASSERT_TRUE(label(out, v) == winner->first) << "voxel " << v;
    ++v;
  }
}

} // namespace trial
