#include "SceneWorker.h"

#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Unit/ChangedSettings.h"

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

using namespace pointhaptics;

namespace
{

/// A wavy square of 6 cm whose points are 0.3 mm apart on one side and 3 mm on the other, with labels.
vtkSmartPointer<vtkPolyData> makeUnevenCloud()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkIntArray> labels;
  labels->SetName("Kind");
  double x = -0.03;
  while (x < 0.03)
  {
    const double spacing = x < 0.0 ? 0.0003 : 0.003;
    for (double y = -0.03; y < 0.03; y += spacing)
    {
      points->InsertNextPoint(x, y, 0.002 * std::sin(200.0 * x));
      labels->InsertNextValue(points->GetNumberOfPoints() % 3 == 0 ? 9 : 0);
    }
    x += spacing;
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->AddArray(labels);
  vtkNew<vtkIntArray> endingLabels;
  endingLabels->DeepCopy(labels);
  endingLabels->SetName("scalar_Label"); // only exactCategoricalNames makes it a number
  cloud->GetPointData()->AddArray(endingLabels);
  return cloud;
}

/// All numbers of a data set, with the names and types of its arrays.
std::vector<std::string> contentOf(vtkPolyData* data)
{
  std::vector<std::string> content;
  const auto add = [&](const std::string& name, vtkDataArray* array)
  {
    std::string text = name + " " + array->GetDataTypeAsString();
    std::uint64_t sum = 1;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        sum = 31 * sum + std::hash<double>()(array->GetComponent(i, c));
      }
    }
    content.push_back(text + " " + std::to_string(array->GetNumberOfTuples()) + " " + std::to_string(sum));
  };
  if (data->GetPoints())
  {
    add("points", data->GetPoints()->GetData());
  }
  for (vtkFieldData* fields : { static_cast<vtkFieldData*>(data->GetPointData()), data->GetFieldData() })
  {
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    {
      add(fields->GetArrayName(i), fields->GetArray(i));
    }
  }
  return content;
}

/// The filters of a program and a worker that gets their settings by requests.
class SceneSettingsTest : public ::testing::Test
{
protected:
  SceneSettingsTest()
  {
    resampler_->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    resampler_->SetDimensions(60, 60, 60);
    bandwidth_->ComputeDensityOn();
    bandwidth_->SetMinimumRadius(0.003);
    bandwidth_->SetMaximumRadius(0.006);
    resampler_->SetInputData(makeUnevenCloud());
    bandwidth_->SetInputConnection(resampler_->GetOutputPort());
    worker_.setCloud(makeUnevenCloud());
  }

  std::vector<std::string> ofWorker()
  {
    worker_.request(SceneRequest::of(resampler_, bandwidth_));
    worker_.wait();
    BuiltScene built;
    EXPECT_TRUE(worker_.take(built));
    return contentOf(built.means);
  }

  std::vector<std::string> ofFilters()
  {
    bandwidth_->Update();
    return contentOf(bandwidth_->GetOutput());
  }

  template <typename Filter>
  void walk(Filter* filter, const std::set<std::string>& unseen)
  {
    const auto before = filter->GetSettings();
    const std::vector<std::string> unchanged = this->ofFilters();
    EXPECT_EQ(this->ofWorker(), unchanged);
    forEachChange(before,
      [&](const std::string& name, const auto& changed)
      {
        SCOPED_TRACE(name);
        filter->SetSettings(changed);
        const std::vector<std::string> expected = this->ofFilters();
        EXPECT_EQ(expected == unchanged, unseen.count(name) > 0) << "the test sees nothing of this member";
        EXPECT_EQ(this->ofWorker(), expected);
        filter->SetSettings(before);
      });
  }

  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  SceneWorker worker_;
};

TEST_F(SceneSettingsTest, OfTheResamplerReachTheWorkersPicture)
{
  this->walk(
    resampler_.Get(), { "computeVoxelIndex", "keepOriginalPointIds", "usePointIndex", "instructionSet" });
}

TEST_F(SceneSettingsTest, OfTheBandwidthFilterReachTheWorkersPicture)
{
  this->walk(bandwidth_.Get(), { "radius" });
  bandwidth_->SetNeighborhoodToFixedRadius();
  bandwidth_->SetRadius(0.008);
  // In balls of one size the spread is much the same everywhere.
  this->walk(bandwidth_.Get(), { "numberOfNeighbors" });
}

} // namespace
