#include "HapticSceneBuilder.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "MadeClouds.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>

using namespace pointhaptics;

namespace
{

TEST(HapticSceneBuilder, SaysThatNothingIsThere)
{
  Status status = Status::Ok;
  EXPECT_EQ(makeHapticScene(nullptr, status), nullptr);
  EXPECT_EQ(status, Status::Empty);
  vtkNew<vtkPolyData> empty;
  status = Status::Ok;
  EXPECT_EQ(makeHapticScene(empty, status), nullptr);
  EXPECT_EQ(status, Status::Empty);
}

TEST(HapticSceneBuilder, TakesRawPointsWithoutAnyArray)
{
  Status status = Status::Empty;
  const auto scene = makeHapticScene(trial::flatCloud(-0.02, 0.02, 0.02), status);
  ASSERT_EQ(status, Status::Ok);
  EXPECT_EQ(scene->numberOfPoints(), 41u * 41u);
  EXPECT_TRUE(scene->modelToWorkspace().isIdentity());
}

TEST(HapticSceneBuilder, TakesTransformSpacingAndRadiusFromThePipeline)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(0.01, 0.02, 0.03);
  transform->Scale(0.5, 0.5, 0.5);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::flatCloud(-0.02, 0.02, 0.02));
  resampler->SetTransform(transform);
  resampler->SetVoxelSize(0.002);
  resampler->SetComputeCovariance(true);
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  bandwidth->SetInputConnection(resampler->GetOutputPort());
  bandwidth->SetMinimumRadius(0.0045);
  bandwidth->SetMaximumRadius(0.0045);
  bandwidth->Update();
  Status status = Status::Empty;
  const auto scene = makeHapticScene(bandwidth->GetOutput(), status);
  ASSERT_EQ(status, Status::Ok);
  EXPECT_EQ(scene->numberOfPoints(), std::size_t(resampler->GetOutput()->GetNumberOfPoints()));
  EXPECT_DOUBLE_EQ(scene->modelToWorkspace().m[0][0], 0.5);
  EXPECT_DOUBLE_EQ(scene->modelToWorkspace().m[2][3], 0.03);
  EXPECT_DOUBLE_EQ(scene->pyramid().level(0).voxelSize, 0.002);
  EXPECT_NEAR(scene->proxyRadius({ 0.01, 0.02, 0.03 }), 0.0045, 1e-9);
}

TEST(HapticSceneBuilder, LeavesCovarianceOutOnRequest)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::flatCloud(-0.02, 0.02, 0.02));
  resampler->SetVoxelSize(0.004);
  resampler->SetComputeCovariance(true);
  resampler->Update();
  Status status = Status::Empty;
  const auto with = makeHapticScene(resampler->GetOutput(), status, true);
  const auto without = makeHapticScene(resampler->GetOutput(), status, false);
  ASSERT_TRUE(with && without);
  EXPECT_GT(with->pyramid().level(0).cells.front().covariance.trace(), 0.0);
  EXPECT_EQ(without->pyramid().level(0).cells.front().covariance.trace(), 0.0);
}

} // namespace
