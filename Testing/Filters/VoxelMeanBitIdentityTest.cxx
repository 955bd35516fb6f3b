// Results have equal bits, whatever the order of the points, the threads or the back end.
#include "VoxelMeanCases.h"

#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{

/// A cloud of one type under a general transform, some points outside, with and without attributes.
class VoxelMeanBits : public testing::TestWithParam<std::tuple<int, bool>>
{
protected:
  static constexpr int kPoints = 60000;

  void SetUp() override
  {
    cloud_ = trial::cloudOf(trial::randomPoints(kPoints, 16, std::get<0>(GetParam())));
    if (std::get<1>(GetParam()))
    {
      trial::addScanAttributes(cloud_, 17);
    }
    transform_->Translate(0.1, 0.05, -0.3);
    transform_->RotateWXYZ(25, 1, 2, 3);
    transform_->Scale(0.9, -0.8, 1.3);
    transform_->Translate(0, -1, 0);
  }
  void TearDown() override
  {
    vtkSMPTools::SetBackend(backend_.c_str());
    vtkSMPTools::Initialize(0);
  }
  /// A fresh filter's answer.
  vtkSmartPointer<vtkPolyData> resampled(vtkPolyData* cloud) const
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    resampler->SetTransform(transform_);
    trial::useUnitCube(resampler, 24);
    resampler->ComputeCovarianceOn();
    resampler->Update();
    EXPECT_GT(resampler->GetOutput()->GetNumberOfPoints(), 5000);
    EXPECT_GT(resampler->GetNumberOfClippedPoints(), 100);
    return trial::copyOf(resampler->GetOutput());
  }

  vtkSmartPointer<vtkPolyData> cloud_;
  vtkNew<vtkTransform> transform_;
  std::string backend_ = vtkSMPTools::GetBackend();
};

}

TEST_P(VoxelMeanBits, DoNotDependOnBackEndThreadsOrTheOrderOfThePoints)
{
  const auto expected = resampled(cloud_);
  for (const char* backend : { "Sequential", "STDThread", "TBB" })
  {
    if (!vtkSMPTools::SetBackend(backend))
    {
      continue;
    }
    for (const int threads : { 1, 2, 8 })
    {
      vtkSMPTools::Initialize(threads);
      SCOPED_TRACE(std::string(backend) + " " + std::to_string(threads));
      trial::expectSame(resampled(cloud_), expected);
      trial::expectSame(resampled(trial::reordered(cloud_, trial::randomOrder(kPoints, 18))), expected);
    }
  }
}

TEST(VoxelMeanBitsOfCategories, DoNotDependOnTheOrderOfNansAndZeroes)
{
  constexpr int kPoints = 2000;
  const auto cloud = trial::cloudOf(trial::randomPoints(kPoints, 61));
  std::mt19937_64 engine(62);
  const double values[6] = { 0.0, -0.0, std::nan("1"), -std::nan("2"), 1.0, 2.0 };
  const auto drawn = [&](vtkIdType, int) { return values[engine() % 6]; };
  trial::addColumns<vtkFloatArray>(cloud, "Floats", 2, drawn);
  trial::addColumns<vtkDoubleArray>(cloud, "Doubles", 1, drawn);
  vtkSmartPointer<vtkPolyData> expected;
  for (int round = 0; round < 8; ++round)
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(trial::reordered(cloud, trial::randomOrder(kPoints, 63 + std::uint64_t(round))));
    trial::useUnitCube(resampler, 4);
    resampler->AddCategoricalArray("Floats");
    resampler->AddCategoricalArray("Doubles");
    resampler->Update();
    if (round == 0)
    {
      expected = trial::copyOf(resampler->GetOutput());
    }
    trial::expectSame(resampler->GetOutput(), expected);
  }
  // Where the two zeroes together, or the NaNs, are the most, the answer says so.
  int zeroes = 0;
  int nans = 0;
  vtkDataArray* doubles = expected->GetPointData()->GetArray("Doubles");
  for (vtkIdType v = 0; v < doubles->GetNumberOfTuples(); ++v)
  {
    zeroes += doubles->GetTuple1(v) == 0.0 && !std::signbit(doubles->GetTuple1(v));
    nans += std::isnan(doubles->GetTuple1(v));
  }
  EXPECT_GT(zeroes, 15);
  EXPECT_GT(nans, 15);
  EXPECT_GE(zeroes + nans, 56) << "twice as frequent as the other two";
}

INSTANTIATE_TEST_SUITE_P(AllTypes, VoxelMeanBits,
  testing::Combine(testing::Values(VTK_FLOAT, VTK_DOUBLE), testing::Bool()),
  [](const auto& param)
  {
    return std::string(std::get<0>(param.param) == VTK_FLOAT ? "Float" : "Double") +
      (std::get<1>(param.param) ? "WithAttributes" : "PointsOnly");
  });
