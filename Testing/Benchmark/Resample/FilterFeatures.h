/// @file
/// Settings of vtkVoxelMeanResampler that not every version has: used where they are, quietly left where not.
#pragma once

#include "vtkVoxelMeanResampler.h"

#include <type_traits>
#include <utility>

namespace pointhaptics
{
namespace bench
{
namespace features
{

template <typename Filter, typename = void>
struct HasInstructionSet : std::false_type
{
};
template <typename Filter>
struct HasInstructionSet<Filter, std::void_t<decltype(std::declval<Filter&>().SetInstructionSet(0))>>
  : std::true_type
{
};

template <typename Filter, typename = void>
struct HasLevels : std::false_type
{
};
template <typename Filter>
struct HasLevels<Filter, std::void_t<decltype(std::declval<Filter&>().SetNumberOfLevels(1))>> : std::true_type
{
};

template <typename Filter, typename = void>
struct HasPointIndex : std::false_type
{
};
template <typename Filter>
struct HasPointIndex<Filter, std::void_t<decltype(std::declval<Filter&>().SetUsePointIndex(true))>>
  : std::true_type
{
};

template <typename Filter>
void setInstructionSet(Filter* filter, int instructionSet)
{
  if constexpr (HasInstructionSet<Filter>::value)
  {
    filter->SetInstructionSet(instructionSet);
  }
}
template <typename Filter>
void setLevels(Filter* filter, int levels)
{
  if constexpr (HasLevels<Filter>::value)
  {
    filter->SetNumberOfLevels(levels);
  }
}
template <typename Filter>
void setPointIndex(Filter* filter, bool use)
{
  if constexpr (HasPointIndex<Filter>::value)
  {
    filter->SetUsePointIndex(use);
  }
}

constexpr bool kInstructionSets = HasInstructionSet<vtkVoxelMeanResampler>::value;
constexpr bool kLevels = HasLevels<vtkVoxelMeanResampler>::value;

} // namespace features
} // namespace bench
} // namespace pointhaptics
