#include "IO/Info/CloudSummary.h"
#include "IO/Info/CloudExtent.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <random>

namespace
{

using namespace pointhaptics;

TEST(CloudSummary, SaysHowTheDensityVariesAndNotHowPointsFall)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const bool hasStep : { false, true })
  {
    vtkNew<vtkPoints> points;
    for (int i = 0; i < 17000; ++i)
    {
      const double right = hasStep && i % 17 == 0 ? 1.0 : 0.0; // 16 times fewer there: 4 times as far apart
      points->InsertNextPoint(right + part(random), part(random), 0.0);
    }
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    EXPECT_NEAR(summarize(cloud, "csv", false).densityVariation, hasStep ? 4.5 : 1.25, hasStep ? 0.5 : 0.15);
  }
}

TEST(CloudSummary, PointsWhoseSquaresAreZeroAreNotAtZero)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const double tiny : { -2e-200, 1e-310, 3e-200 })
  {
    points->InsertNextPoint(tiny, 0.0, tiny);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  const CloudExtent extent = extentOf(cloud);
  EXPECT_EQ(extent.atZero, 0);
  EXPECT_EQ(extent.returned.minimum.x, -2e-200);
  EXPECT_EQ(extent.returned.maximum.z, 3e-200);
}

TEST(CloudSummary, AFarPointMakesNoVoxelCoarser)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(1e6, 0.0, 0.0);
  for (int i = 0; i < 400; ++i)
  {
    points->InsertNextPoint(0.01 * (i % 20), 0.01 * (i / 20), 0.0);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  EXPECT_NEAR(summarize(cloud, "xyz").suggestedVoxel, 0.02, 1e-6); // 0.0625: a step of floats at 1e6
}

TEST(CloudSummary, InvalidPointsHaveNoStatistics)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(1.0, 2.0, 3.0);
  points->InsertNextPoint(std::nan(""), 7.0, 7.0);
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  const ArraySummary coordinates = summarize(cloud, "xyz", true).coordinates;
  EXPECT_EQ(coordinates.type, "float");
  EXPECT_EQ(coordinates.maxima, (std::vector<double>{ 1.0, 2.0, 3.0 }));
  EXPECT_EQ(coordinates.means, (std::vector<double>{ 1.0, 2.0, 3.0 }));
}

} // namespace
