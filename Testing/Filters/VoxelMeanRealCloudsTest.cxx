// Real scans, where they stand beside the checkout, against the definition in long double.
#include "VoxelMeanFixtures.h"

#include "vtkPointCloudReader.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>

namespace
{

struct Scan
{
  const char* file;
  vtkIdType points;
};

/// How GoogleTest names a parameter.
void PrintTo(const Scan& scan, std::ostream* os)
{
  *os << scan.file;
}

class VoxelMeanRealClouds : public testing::TestWithParam<Scan>
{
protected:
  void SetUp() override
  {
    const char* chosen = std::getenv("POINTHAPTICS_SHARED_DATA");
    const std::string path = std::string(chosen ? chosen : POINTHAPTICS_SHARED_DATA) + "/" + GetParam().file;
    if (!std::filesystem::exists(path))
    {
      GTEST_SKIP() << "no " << GetParam().file
                   << " beside this checkout (set POINTHAPTICS_SHARED_DATA to the folder of the real clouds)";
    }
    trial::Ear errors(reader_, vtkCommand::ErrorEvent);
    reader_->SetFileName(path.c_str());
    reader_->Update();
    ASSERT_EQ(errors.count, 0) << reader_->GetErrorMessage();
    ASSERT_EQ(reader_->GetOutput()->GetNumberOfPoints(), GetParam().points);
  }
  vtkNew<vtkPointCloudReader> reader_;
};

}

TEST_P(VoxelMeanRealClouds, AgreeWithTheDefinition)
{
  vtkPolyData* cloud = reader_->GetOutput();
  for (const int n : { 300, 37 })
  {
    SCOPED_TRACE(n);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetDimensions(n, n, n);
    trial::expectRight(resampler, cloud);
    EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
    EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 0);
    EXPECT_LT(resampler->GetOutput()->GetNumberOfPoints(), cloud->GetNumberOfPoints());
  }
}

INSTANTIATE_TEST_SUITE_P(Scans, VoxelMeanRealClouds,
  testing::Values(Scan{ "happy_543652.ply", 543652 }, Scan{ "room_scan1.pcd", 112586 },
    Scan{ "samp11-utm.pcd", 38010 }, Scan{ "Megaplot.las", 81590 }));
