#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "../Unit/ChangedSettings.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <algorithm>
#include <functional>
#include <map>
#include <sstream>
#include <string>

using namespace pointhaptics;

namespace
{

/// A property of a filter as VTK has it, for one member of the settings.
template <typename Filter, typename Settings>
struct Property
{
  std::function<void(Filter*, const Settings&)> set; ///< The member, by its Set function.
  std::function<bool(Filter*, const Settings&)> has; ///< True if the Get function returns the member.
};

using Resampler = vtkVoxelMeanResampler;
using VoxelProperty = Property<Resampler, VoxelMeanSettings>;
using Bandwidth = vtkKernelBandwidthFilter;
using BandwidthProperty = Property<Bandwidth, BandwidthSettings>;

const std::map<std::string, VoxelProperty> kVoxelProperties = {
  { "lattice.dimensions",
    { [](Resampler* f, const VoxelMeanSettings& s)
      {
        const auto& n = s.lattice.dimensions;
        f->SetDimensions(int(n[0]), int(n[1]), int(n[2]));
      },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return std::equal(f->GetDimensions(), f->GetDimensions() + 3, s.lattice.dimensions.begin()); } } },
  { "lattice.voxelSize",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetVoxelSize(s.lattice.voxelSize); },
      [](Resampler* f, const VoxelMeanSettings& s) { return f->GetVoxelSize() == s.lattice.voxelSize; } } },
  { "lattice.automaticWorkspace",
    { [](Resampler* f, const VoxelMeanSettings& s)
      { f->SetAutomaticWorkspace(s.lattice.automaticWorkspace); },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetAutomaticWorkspace() == s.lattice.automaticWorkspace; } } },
  { "lattice.workspace",
    { [](Resampler* f, const VoxelMeanSettings& s)
      {
        const Bounds& b = s.lattice.workspace;
        f->SetWorkspaceBounds(b.minimum.x, b.maximum.x, b.minimum.y, b.maximum.y, b.minimum.z, b.maximum.z);
        f->SetAutomaticWorkspace(s.lattice.automaticWorkspace);
      },
      [](Resampler* f, const VoxelMeanSettings& s)
      {
        const double* b = f->GetWorkspaceBounds();
        return Bounds{ { b[0], b[2], b[4] }, { b[1], b[3], b[5] } } == s.lattice.workspace;
      } } },
  { "outputPointsPrecision",
    { [](Resampler* f, const VoxelMeanSettings& s)
      { f->SetOutputPointsPrecision(int(s.outputPointsPrecision)); },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetOutputPointsPrecision() == int(s.outputPointsPrecision); } } },
  { "computeCovariance",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetComputeCovariance(s.computeCovariance); },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetComputeCovariance() == s.computeCovariance; } } },
  { "passAttributes",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetPassAttributes(s.passAttributes); },
      [](Resampler* f, const VoxelMeanSettings& s) { return f->GetPassAttributes() == s.passAttributes; } } },
  { "categoricalArrays",
    { [](Resampler* f, const VoxelMeanSettings& s)
      {
        f->ClearCategoricalArrays();
        for (const std::string& name : s.categoricalArrays)
        {
          f->AddCategoricalArray(name.c_str());
        }
      },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetCategoricalArrays() == s.categoricalArrays; } } },
  { "representative",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetRepresentative(int(s.representative)); },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetRepresentative() == int(s.representative); } } },
  { "minimumPointsPerVoxel",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetMinimumPointsPerVoxel(s.minimumPointsPerVoxel); },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetMinimumPointsPerVoxel() == s.minimumPointsPerVoxel; } } },
  { "computeVoxelIndex",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetComputeVoxelIndex(s.computeVoxelIndex); },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetComputeVoxelIndex() == s.computeVoxelIndex && f->GetNumberOfOutputPorts() == 2; } } },
  { "keepOriginalPointIds",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetKeepOriginalPointIds(s.keepOriginalPointIds); },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetKeepOriginalPointIds() == s.keepOriginalPointIds; } } },
  { "usePointIndex",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetUsePointIndex(s.usePointIndex); },
      [](Resampler* f, const VoxelMeanSettings& s) { return f->GetUsePointIndex() == s.usePointIndex; } } },
  { "instructionSet",
    { [](Resampler* f, const VoxelMeanSettings& s) { f->SetInstructionSet(int(s.instructionSet)); },
      [](Resampler* f, const VoxelMeanSettings& s)
      { return f->GetInstructionSet() == int(s.instructionSet); } } },
};

const std::map<std::string, BandwidthProperty> kBandwidthProperties = {
  { "fixedRadius",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetNeighborhood(s.fixedRadius ? 1 : 0); },
      [](Bandwidth* f, const BandwidthSettings& s)
      { return f->GetNeighborhood() == (s.fixedRadius ? Bandwidth::FixedRadius : Bandwidth::KNearest); } } },
  { "numberOfNeighbors",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetNumberOfNeighbors(s.numberOfNeighbors); },
      [](Bandwidth* f, const BandwidthSettings& s)
      { return f->GetNumberOfNeighbors() == s.numberOfNeighbors; } } },
  { "radius",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetRadius(s.radius); },
      [](Bandwidth* f, const BandwidthSettings& s) { return f->GetRadius() == s.radius; } } },
  { "rule",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetRule(int(s.rule)); },
      [](Bandwidth* f, const BandwidthSettings& s) { return f->GetRule() == int(s.rule); } } },
  { "radiusScale",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetRadiusScale(s.radiusScale); },
      [](Bandwidth* f, const BandwidthSettings& s) { return f->GetRadiusScale() == s.radiusScale; } } },
  { "minimumRadius",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetMinimumRadius(s.minimumRadius); },
      [](Bandwidth* f, const BandwidthSettings& s) { return f->GetMinimumRadius() == s.minimumRadius; } } },
  { "maximumRadius",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetMaximumRadius(s.maximumRadius); },
      [](Bandwidth* f, const BandwidthSettings& s) { return f->GetMaximumRadius() == s.maximumRadius; } } },
  { "smoothRadius",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetSmoothRadius(s.smoothRadius); },
      [](Bandwidth* f, const BandwidthSettings& s) { return f->GetSmoothRadius() == s.smoothRadius; } } },
  { "usePointCounts",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetUsePointCounts(s.usePointCounts); },
      [](Bandwidth* f, const BandwidthSettings& s) { return f->GetUsePointCounts() == s.usePointCounts; } } },
  { "densityKernel",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetDensityKernel(int(s.densityKernel)); },
      [](Bandwidth* f, const BandwidthSettings& s)
      { return f->GetDensityKernel() == int(s.densityKernel); } } },
  { "computeBandwidth",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetComputeBandwidth(s.computeBandwidth); },
      [](Bandwidth* f, const BandwidthSettings& s)
      { return f->GetComputeBandwidth() == s.computeBandwidth; } } },
  { "computeProxyRadius",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetComputeProxyRadius(s.computeProxyRadius); },
      [](Bandwidth* f, const BandwidthSettings& s)
      { return f->GetComputeProxyRadius() == s.computeProxyRadius; } } },
  { "computeDensity",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetComputeDensity(s.computeDensity); },
      [](Bandwidth* f, const BandwidthSettings& s) { return f->GetComputeDensity() == s.computeDensity; } } },
  { "computeMeanBandwidth",
    { [](Bandwidth* f, const BandwidthSettings& s) { f->SetComputeMeanBandwidth(s.computeMeanBandwidth); },
      [](Bandwidth* f, const BandwidthSettings& s)
      { return f->GetComputeMeanBandwidth() == s.computeMeanBandwidth; } } },
};

/// Each member by its own Set function and by SetSettings(), and back by both Get functions; and in what the
/// filter prints of itself.
template <typename Filter, typename Settings>
void walk(const std::map<std::string, Property<Filter, Settings>>& table)
{
  std::size_t members = 0;
  const Settings before = vtkNew<Filter>()->GetSettings();
  EXPECT_TRUE(equalSettings(before, Settings())) << "the defaults are two";
  forEachChange(before,
    [&](const std::string& name, const Settings& changed)
    {
      SCOPED_TRACE(name);
      ++members;
      const auto property = table.find(name);
      ASSERT_NE(property, table.end()) << "give the filter a Set and a Get function, and this table a row";
      vtkNew<Filter> one;
      EXPECT_FALSE(property->second.has(one, changed));
      vtkMTimeType time = one->GetMTime();
      property->second.set(one, changed);
      EXPECT_TRUE(equalSettings(one->GetSettings(), changed));
      EXPECT_TRUE(property->second.has(one, changed));
      EXPECT_GT(one->GetMTime(), time);
      vtkNew<Filter> other;
      time = other->GetMTime();
      other->SetSettings(before);
      EXPECT_EQ(other->GetMTime(), time) << "nothing was changed";
      other->SetSettings(changed);
      EXPECT_TRUE(property->second.has(other, changed));
      EXPECT_GT(other->GetMTime(), time);
      time = other->GetMTime();
      property->second.set(other, before);
      EXPECT_TRUE(equalSettings(other->GetSettings(), before));
      EXPECT_GT(other->GetMTime(), time);
      std::string heading = name.substr(name.find('.') + 1) + ":";
      heading[0] = char(std::toupper(heading[0]));
      std::ostringstream printed;
      other->Print(printed);
      EXPECT_NE(printed.str().find(heading), std::string::npos) << printed.str();
    });
  EXPECT_EQ(members, table.size()) << "a row of the table is of no member";
}

TEST(FilterSettings, OfTheResamplerAreItsProperties)
{
  walk(kVoxelProperties);
}

TEST(FilterSettings, OfTheBandwidthFilterAreItsProperties)
{
  walk(kBandwidthProperties);
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
