// Real scans, where they stand beside the checkout, against the definition in long double.
#include "vtkKernelBandwidthFilter.h"
#include "vtkPointCloudReader.h"

#include "Core/Reference/ReferenceBandwidth.h"

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace pointhaptics;

namespace
{

class KernelBandwidthRealClouds : public testing::TestWithParam<const char*>
{
protected:
  void SetUp() override
  {
    const char* chosen = std::getenv("POINTHAPTICS_SHARED_DATA");
    const std::string path = std::string(chosen ? chosen : POINTHAPTICS_SHARED_DATA) + "/" + GetParam();
    if (!std::filesystem::exists(path))
    {
      GTEST_SKIP() << "no " << GetParam()
                   << " beside this checkout (set POINTHAPTICS_SHARED_DATA to the folder of the real clouds)";
    }
    reader_->SetFileName(path.c_str());
    reader_->Update();
    ASSERT_STREQ(reader_->GetErrorMessage(), "");
  }
  vtkNew<vtkPointCloudReader> reader_;
};

const double* valuesOf(vtkPolyData* cloud, const char* name)
{
  return vtkDoubleArray::SafeDownCast(cloud->GetPointData()->GetArray(name))->GetPointer(0);
}

}

TEST_P(KernelBandwidthRealClouds, HaveTheRadiiOfTheDefinition)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputConnection(reader_->GetOutputPort());
  filter->ComputeDensityOff();
  filter->Update();
  vtkPolyData* cloud = filter->GetOutput();
  const double* bandwidths = valuesOf(cloud, "Bandwidth");
  const double* radii = valuesOf(cloud, "ProxyRadius");
  std::vector<Vec3> points(static_cast<std::size_t>(cloud->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    cloud->GetPoint(static_cast<vtkIdType>(i), &points[i].x);
    if (isFinite(points[i]))
    {
      ASSERT_TRUE(bandwidths[i] > 0.0 && std::isfinite(bandwidths[i])) << i;
      ASSERT_TRUE(radii[i] > 0.0 && std::isfinite(radii[i])) << i;
    }
  }
  const PointView view(points.data(), std::int64_t(points.size()));
  for (std::size_t i = 0; i < points.size(); i += points.size() / 15)
  {
    if (!isFinite(points[i]))
    {
      continue;
    }
    std::vector<std::int64_t> indices;
    const std::vector<Neighbor> nearest = reference::nearest(view, points[i], 17);
    for (const Neighbor& neighbor : nearest)
    {
      indices.push_back(neighbor.index);
    }
    const long double b = reference::bandwidthFactor(BandwidthRule::NormalReference, 17, 2) *
      reference::surfaceSpread(view, indices);
    const double spacing = std::sqrt(nearest.back().squaredDistance * 3.14159265358979323846 / 16.0);
    EXPECT_NEAR(bandwidths[i] / double(b), 1.0, 1e-9) << i;
    EXPECT_NEAR(radii[i] / std::max(4.0 * double(b), 2.2 * spacing), 1.0, 1e-9) << i;
  }
}

// A density that varies by 281:1, every point twice; a scan of an object; coordinates in millions of metres.
INSTANTIATE_TEST_SUITE_P(Scans, KernelBandwidthRealClouds,
  testing::Values("room_scan1.pcd", "bun_zipper.ply", "samp11-utm.pcd"),
  [](const testing::TestParamInfo<const char*>& scan) { return std::string(scan.param).substr(0, 4); });
