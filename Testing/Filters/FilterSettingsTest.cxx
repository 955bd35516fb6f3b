#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "../Unit/ChangedSettings.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <functional>
#include <map>
#include <sstream>
#include <string>

using namespace pointhaptics;

namespace
{

/// Passes a property of one filter on to another, by their Get and Set functions.
template <typename Filter>
using Property = std::function<void(Filter* from, Filter* to)>;

template <typename Filter, typename Value>
Property<Filter> property(void (Filter::*set)(Value), Value (Filter::*get)() const)
{
  return [=](Filter* from, Filter* to) { (to->*set)((from->*get)()); };
}

using Resampler = vtkVoxelMeanResampler;
using Bandwidth = vtkKernelBandwidthFilter;

const std::map<std::string, Property<Resampler>> kResamplerProperties = {
  { "lattice.dimensions", [](Resampler* from, Resampler* to) { to->SetDimensions(from->GetDimensions()); } },
  { "lattice.workspace",
    [](Resampler* from, Resampler* to)
    {
      to->SetWorkspaceBounds(from->GetWorkspaceBounds());
      to->SetAutomaticWorkspace(from->GetAutomaticWorkspace());
    } },
  { "categoricalArrays",
    [](Resampler* from, Resampler* to)
    {
      to->ClearCategoricalArrays();
      for (const std::string& name : from->GetCategoricalArrays())
      {
        to->AddCategoricalArray(name.c_str());
      }
    } },
  { "exactCategoricalNames",
    property(&Resampler::SetExactCategoricalNames, &Resampler::GetExactCategoricalNames) },
  { "lattice.voxelSize", property(&Resampler::SetVoxelSize, &Resampler::GetVoxelSize) },
  { "lattice.automaticWorkspace",
    property(&Resampler::SetAutomaticWorkspace, &Resampler::GetAutomaticWorkspace) },
  { "outputPointsPrecision",
    property(&Resampler::SetOutputPointsPrecision, &Resampler::GetOutputPointsPrecision) },
  { "computeCovariance", property(&Resampler::SetComputeCovariance, &Resampler::GetComputeCovariance) },
  { "passAttributes", property(&Resampler::SetPassAttributes, &Resampler::GetPassAttributes) },
  { "representative", property(&Resampler::SetRepresentative, &Resampler::GetRepresentative) },
  { "minimumPointsPerVoxel",
    property(&Resampler::SetMinimumPointsPerVoxel, &Resampler::GetMinimumPointsPerVoxel) },
  { "computeVoxelIndex", property(&Resampler::SetComputeVoxelIndex, &Resampler::GetComputeVoxelIndex) },
  { "keepOriginalPointIds",
    property(&Resampler::SetKeepOriginalPointIds, &Resampler::GetKeepOriginalPointIds) },
  { "usePointIndex", property(&Resampler::SetUsePointIndex, &Resampler::GetUsePointIndex) },
  { "instructionSet", property(&Resampler::SetInstructionSet, &Resampler::GetInstructionSet) },
};

const std::map<std::string, Property<Bandwidth>> kBandwidthProperties = {
  { "fixedRadius", property(&Bandwidth::SetNeighborhood, &Bandwidth::GetNeighborhood) },
  { "numberOfNeighbors", property(&Bandwidth::SetNumberOfNeighbors, &Bandwidth::GetNumberOfNeighbors) },
  { "radius", property(&Bandwidth::SetRadius, &Bandwidth::GetRadius) },
  { "rule", property(&Bandwidth::SetRule, &Bandwidth::GetRule) },
  { "radiusScale", property(&Bandwidth::SetRadiusScale, &Bandwidth::GetRadiusScale) },
  { "minimumRadius", property(&Bandwidth::SetMinimumRadius, &Bandwidth::GetMinimumRadius) },
  { "maximumRadius", property(&Bandwidth::SetMaximumRadius, &Bandwidth::GetMaximumRadius) },
  { "smoothRadius", property(&Bandwidth::SetSmoothRadius, &Bandwidth::GetSmoothRadius) },
  { "usePointCounts", property(&Bandwidth::SetUsePointCounts, &Bandwidth::GetUsePointCounts) },
  { "densityKernel", property(&Bandwidth::SetDensityKernel, &Bandwidth::GetDensityKernel) },
  { "computeBandwidth", property(&Bandwidth::SetComputeBandwidth, &Bandwidth::GetComputeBandwidth) },
  { "computeProxyRadius", property(&Bandwidth::SetComputeProxyRadius, &Bandwidth::GetComputeProxyRadius) },
  { "computeDensity", property(&Bandwidth::SetComputeDensity, &Bandwidth::GetComputeDensity) },
  { "computeMeanBandwidth",
    property(&Bandwidth::SetComputeMeanBandwidth, &Bandwidth::GetComputeMeanBandwidth) },
};

/// Each member by SetSettings() and on by its Get and Set functions; and in what the filter prints of itself.
template <typename Filter, typename Settings>
void walk(const std::map<std::string, Property<Filter>>& properties, const Settings& defaults)
{
  std::size_t members = 0;
  EXPECT_TRUE(equalSettings(vtkNew<Filter>()->GetSettings(), defaults));
  forEachChange(defaults,
    [&](const std::string& name, const Settings& changed)
    {
      SCOPED_TRACE(name);
      ++members;
      const auto property = properties.find(name);
      ASSERT_NE(property, properties.end()) << "give the filter a vtkSettingMacro, and this list a row";
      vtkNew<Filter> from;
      vtkMTimeType time = from->GetMTime();
      from->SetSettings(defaults);
      EXPECT_EQ(from->GetMTime(), time) << "nothing was changed";
      from->SetSettings(changed);
      EXPECT_GT(from->GetMTime(), time);
      vtkNew<Filter> to;
      time = to->GetMTime();
      property->second(from, to);
      EXPECT_TRUE(equalSettings(to->GetSettings(), changed));
      EXPECT_GT(to->GetMTime(), time);
      std::string heading = name.substr(name.find('.') + 1) + ":";
      heading[0] = char(std::toupper(heading[0]));
      std::ostringstream printed;
      to->Print(printed);
      EXPECT_NE(printed.str().find(heading), std::string::npos) << printed.str();
    });
  EXPECT_EQ(members, properties.size()) << "a row of the list is of no member";
}

TEST(FilterSettings, OfTheResamplerAreItsProperties)
{
  walk(kResamplerProperties, VoxelMeanSettings());
}

TEST(FilterSettings, OfTheBandwidthFilterAreItsProperties)
{
  walk(kBandwidthProperties, BandwidthSettings());
}

TEST(FilterSettings, StayInTheirRanges)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetMinimumPointsPerVoxel(-3);
  EXPECT_EQ(resampler->GetMinimumPointsPerVoxel(), 1);
  resampler->SetOutputPointsPrecision(7);
  EXPECT_EQ(resampler->GetOutputPointsPrecision(), int(vtkAlgorithm::DEFAULT_PRECISION));
  resampler->SetInstructionSet(-1);
  EXPECT_EQ(resampler->GetInstructionSet(), int(vtkVoxelMeanResampler::InstructionSetAutomatic));
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetNeighborhood(5);
  EXPECT_EQ(filter->GetNeighborhood(), int(vtkKernelBandwidthFilter::FixedRadius));
  filter->SetRule(9);
  EXPECT_EQ(filter->GetRule(), int(vtkKernelBandwidthFilter::SheatherJones));
  filter->SetDensityKernel(-3);
  EXPECT_EQ(filter->GetDensityKernel(), int(vtkKernelBandwidthFilter::Gaussian));
}

} // namespace
