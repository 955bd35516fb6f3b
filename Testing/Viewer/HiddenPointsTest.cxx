#include "HapticViewerFixture.h"

#include "../Unit/SkipWithoutDisplay.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>

#include <cmath>
#include <utility>

using namespace pointhaptics;

namespace
{

using HiddenPoints = HapticViewerTest;

double feltPoints(HapticViewer& viewer)
{
  vtkDataArray* counts = viewer.means()->GetPointData()->GetArray("VoxelPointCount");
  double felt = 0.0;
  for (vtkIdType i = 0; i < counts->GetNumberOfTuples(); ++i)
  {
    felt += counts->GetComponent(i, 0);
  }
  return felt;
}

TEST_F(HiddenPoints, NeitherDrawsNorFeelsHiddenValues)
{
  SKIP_WITHOUT_DISPLAY();
  const auto drawn = [this]
  {
    HapticViewer viewer(options_, observer_);
    EXPECT_TRUE(viewer.open(makeSphere())) << viewer.message();
    EXPECT_TRUE(viewer.renderToFile(this->path("hidden.png"))) << viewer.message();
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(this->path("hidden.png").c_str());
    reader->Update();
    vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
    int bright = 0;
    for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
    {
      bright += pixels->GetComponent(i, 0) > 90.0 ? 1 : 0; // clay, lit
    }
    return std::make_pair(bright, feltPoints(viewer));
  };
  options_.colorBy = "Clay";
  options_.up = "z";
  const auto all = drawn();
  options_.picture.hidden = { { "height", 0.0, INFINITY } }; // the upper half
  const auto half = drawn();
  EXPECT_NEAR(half.second, 0.5 * all.second, 0.001 * kPoints);
  EXPECT_LT(half.first, 0.7 * all.first) << "of " << all.first << " pixels";
  EXPECT_GT(half.first, 0.2 * all.first);
  options_.picture.hidden = { { "Density", 1.0, INFINITY } }; // no file has it
  HapticViewer viewer(options_, observer_);
  EXPECT_FALSE(viewer.open(makeSphere()));
  EXPECT_NE(viewer.message().find("Density"), std::string::npos) << viewer.message();
}

TEST_F(HiddenPoints, ClipsACloudInDegreesByABoxInDegrees)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < kPoints; ++i)
  {
    points->InsertNextPoint(8.0 + 4e-6 * (i % 200), 50.0 + 2.5e-6 * (i / 200), 40.0);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkStringArray> unit;
  unit->SetName("LengthUnit");
  unit->InsertNextValue("degree");
  cloud->GetFieldData()->AddArray(unit);
  options_.clip = { 8.0 - 2e-6, 8.0 + 4e-6 * 49.5, 49.0, 51.0, 0.0, 100.0 };
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(cloud)) << viewer.message();
  EXPECT_EQ(feltPoints(viewer), kPoints / 4);
}

} // namespace
