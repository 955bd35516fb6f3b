// Ways to the same answer: with and without the point index, and by every instruction set.
#include "VoxelMeanCases.h"

#include "Unit/HeapBytes.h"
#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

namespace
{

/// Result of a filter without any memory of earlier updates, with @p resampler's settings.
vtkSmartPointer<vtkPolyData> fromScratch(vtkVoxelMeanResampler* resampler, vtkPolyData* cloud)
{
  vtkNew<vtkVoxelMeanResampler> fresh;
  fresh->SetSettings(resampler->GetSettings());
  fresh->SetUsePointIndex(false);
  fresh->SetInputData(trial::copyOf(cloud));
  fresh->SetTransform(resampler->GetTransform());
  fresh->Update();
  EXPECT_EQ(fresh->GetNumberOfClippedPoints(), resampler->GetNumberOfClippedPoints());
  EXPECT_EQ(fresh->GetNumberOfInvalidPoints(), resampler->GetNumberOfInvalidPoints());
  return trial::copyOf(fresh->GetOutput());
}

void expectAsFromScratch(vtkVoxelMeanResampler* resampler, vtkPolyData* cloud)
{
  resampler->Update();
  trial::expectValid(resampler->GetOutput());
  const auto expected = fromScratch(resampler, cloud);
  trial::expectSame(resampler->GetOutput(), expected);
}

/// A scan of 100,000 points in clusters, a hundredth of them not finite.
vtkSmartPointer<vtkPolyData> clusteredScan(std::uint64_t seed, int type, bool withAttributes)
{
  std::mt19937_64 engine(seed);
  pointhaptics::Vec3 middle{ 0.5, 0.5, 0.5 };
  const auto cloud = trial::cloudBy(
    100000,
    [&](int i)
    {
      const auto draw = [&] { return trial::uniform(engine); };
      if (i % 1000 == 0)
      {
        middle = { draw(), draw(), draw() };
      }
      pointhaptics::Vec3 p = middle + 0.1 * pointhaptics::Vec3(draw(), draw(), draw());
      p.y = i % 100 == 0 ? NAN : p.y;
      return p;
    },
    type);
  if (withAttributes)
  {
    trial::addScanAttributes(cloud, seed);
  }
  return cloud;
}

/// A view that zooms, turns and shifts, from all of the cloud to nothing of it.
void setView(vtkVoxelMeanResampler* resampler, vtkTransform* transform, int step)
{
  std::mt19937_64 engine(std::uint64_t(step) + 100);
  const double zooms[6] = { 1, 3, 10, 30, 0.2, 100 };
  const double zoom = zooms[step % 6];
  transform->Identity();
  if (step % 4 != 3)
  {
    transform->RotateWXYZ(trial::uniform(engine, -180, 180), 1, trial::uniform(engine), -1);
  }
  transform->Scale(zoom, step % 3 ? zoom : -zoom, zoom);
  transform->Translate(trial::uniform(engine, -0.8, -0.2), trial::uniform(engine, -0.8, -0.2),
    trial::uniform(engine, -0.8, -0.2));
  resampler->SetTransform(transform);
  const double half = step % 5 == 4 ? 0.1 : 0.5;
  resampler->SetWorkspaceBounds(-half, half, -half, 0.5, -0.5, half);
  resampler->SetDimensions(20 + step % 7, 30, step % 2 ? 40 : 17);
}

using Setting = std::tuple<int, bool>;

class VoxelMeanVariants : public testing::TestWithParam<Setting>
{
protected:
  vtkSmartPointer<vtkPolyData> cloud_ = clusteredScan(71, std::get<0>(GetParam()), std::get<1>(GetParam()));
  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkTransform> transform_;
};

}

TEST(VoxelMeanPointIndex, IsUsedUnlessForbidden)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  EXPECT_TRUE(resampler->GetUsePointIndex());
  EXPECT_EQ(resampler->GetInstructionSet(), int(vtkVoxelMeanResampler::InstructionSetAutomatic));
}

TEST_P(VoxelMeanVariants, ThePointIndexDoesNotChangeTheAnswer)
{
  resampler_->SetInputData(cloud_);
  int narrow = 0;
  int empty = 0;
  for (int step = 0; step < 12; ++step)
  {
    SCOPED_TRACE(step);
    setView(resampler_, transform_, step);
    resampler_->SetComputeCovariance(step % 2 == 1);
    expectAsFromScratch(resampler_, cloud_);
    empty += resampler_->GetOutput()->GetNumberOfPoints() == 0 ? 1 : 0;
    narrow += resampler_->GetNumberOfClippedPoints() > 95000 ? 1 : 0;
  }
  EXPECT_LE(empty, 6) << "views of nothing test little";
  EXPECT_GE(narrow - empty, 2) << "no view of a small part";
}

TEST_P(VoxelMeanVariants, ThePointIndexFollowsTheInput)
{
  resampler_->SetInputData(cloud_);
  for (int step = 0; step < 6; ++step)
  {
    SCOPED_TRACE(step);
    setView(resampler_, transform_, step);
    expectAsFromScratch(resampler_, cloud_);
    // Points moved in place; more than the index's bounds allow for.
    for (vtkIdType i = step; i < cloud_->GetNumberOfPoints(); i += 7)
    {
      double p[3];
      cloud_->GetPoint(i, p);
      cloud_->GetPoints()->SetPoint(i, p[1], 1 - p[2], 0.5 * p[0]);
    }
    // Whichever object is told of it.
    vtkObject* const told[3] = { cloud_->GetPoints(), cloud_->GetPoints()->GetData(), cloud_ };
    told[step % 3]->Modified();
    expectAsFromScratch(resampler_, cloud_);
    // An attribute changed in place, the points not.
    if (vtkDataArray* heat = cloud_->GetPointData()->GetArray("Heat"))
    {
      for (vtkIdType i = 0; i < heat->GetNumberOfTuples(); i += 3)
      {
        heat->SetComponent(i, 0, 100.0 + step);
      }
      heat->Modified();
      cloud_->Modified();
      expectAsFromScratch(resampler_, cloud_);
    }
  }
}

TEST_P(VoxelMeanVariants, ThePointIndexFollowsAnotherInput)
{
  const auto other = clusteredScan(72, std::get<0>(GetParam()), false);
  const auto brief = trial::cloudOf(trial::randomPoints(100, 73));
  vtkNew<vtkPolyData> empty;
  int step = 0;
  for (vtkPolyData* input : { cloud_.Get(), other.Get(), cloud_.Get(), brief.Get(), other.Get() })
  {
    resampler_->SetInputData(input);
    for (int repeat = 0; repeat < 3; ++repeat)
    {
      SCOPED_TRACE(step);
      setView(resampler_, transform_, step++);
      expectAsFromScratch(resampler_, input);
    }
    resampler_->SetInputData(empty);
    resampler_->Update();
    EXPECT_EQ(resampler_->GetOutput()->GetNumberOfPoints(), 0);
  }
}

TEST_P(VoxelMeanVariants, ThePointIndexFollowsPointsReplacedInTheSameInput)
{
  resampler_->SetInputData(cloud_);
  for (int step = 0; step < 4; ++step)
  {
    SCOPED_TRACE(step);
    setView(resampler_, transform_, step);
    expectAsFromScratch(resampler_, cloud_);
    expectAsFromScratch(resampler_, cloud_);
    vtkNew<vtkPoints> points;
    points->DeepCopy(clusteredScan(std::uint64_t(80 + step), std::get<0>(GetParam()), false)->GetPoints());
    cloud_->SetPoints(points);
    expectAsFromScratch(resampler_, cloud_);
  }
}

TEST(VoxelMeanPointIndex, IsNotThatOfAnotherInputWithAnArrayInCommon)
{
  const auto large = trial::cloudOf(trial::randomPoints(100000, 71));
  const auto small = trial::cloudOf(trial::randomPoints(1000, 72));
  trial::addScanAttributes(large, 73);
  trial::addScanAttributes(small, 74);
  vtkNew<vtkDoubleArray> shared;
  shared->SetName("Calibration");
  shared->InsertNextValue(1);
  large->GetFieldData()->AddArray(shared);
  small->GetFieldData()->AddArray(shared);
  shared->Modified();
  ASSERT_EQ(large->GetMTime(), small->GetMTime());
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(large);
  for (int view = 0; view < 3; ++view)
  {
    resampler->SetWorkspaceBounds(0, 0.3 + 0.01 * view, 0, 0.3, 0, 0.3);
    resampler->SetDimensions(20, 20, 20);
    resampler->Update();
  }
  resampler->SetInputData(small);
  resampler->Update();
  vtkNew<vtkVoxelMeanResampler> fresh;
  fresh->SetInputData(small);
  fresh->SetWorkspaceBounds(resampler->GetWorkspaceBounds());
  fresh->SetDimensions(20, 20, 20);
  fresh->Update();
  trial::expectSame(resampler->GetOutput(), fresh->GetOutput());
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), fresh->GetNumberOfClippedPoints());
}

TEST(VoxelMeanPointIndex, StaysWhenOnlyAnArrayChanges)
{
  SKIP_WITHOUT_HEAP();
  const auto cloud = trial::cloudOf(trial::randomPoints(100000, 75));
  const auto heat =
    trial::addColumns<vtkFloatArray>(cloud, "Heat", 1, [](vtkIdType i, int) { return double(i); });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->PassAttributesOff();
  const auto look = [&](double edge)
  {
    resampler->SetWorkspaceBounds(0, edge, 0, 0.1, 0, 0.1);
    resampler->SetDimensions(20, 20, 20);
    resampler->Update();
    return pointhaptics::heapBytes();
  };
  const std::size_t without = look(0.11);
  const std::size_t index = 100000 * 16;
  ASSERT_GT(look(0.12), without + index);
  heat->Modified();
  EXPECT_GT(look(0.13), without + index);
  cloud->GetPoints()->GetData()->Modified();
  EXPECT_LT(look(0.14), without + index);
}

int filterSet(pointhaptics::InstructionSet set)
{
  return set == pointhaptics::InstructionSet::Avx2 ? vtkVoxelMeanResampler::InstructionSetAVX2
                                                   : vtkVoxelMeanResampler::InstructionSetBaseline;
}

TEST(VoxelMeanInstructionSets, AgreeOnRandomCasesAndFewPoints)
{
  SKIP_WITHOUT_OTHER_INSTRUCTION_SETS();
  for (std::uint64_t seed = 0; seed < 150; ++seed)
  {
    // Few points, so that the remainders of vector widths are met.
    const trial::VoxelMeanCase drawn = trial::drawCase(seed + 900, seed % 2 ? 70 : 2000);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << drawn);
    vtkNew<vtkVoxelMeanResampler> resampler;
    drawn.applyTo(resampler);
    resampler->ComputeCovarianceOn();
    resampler->SetInstructionSet(vtkVoxelMeanResampler::InstructionSetBaseline);
    trial::Ear errors(resampler, vtkCommand::ErrorEvent);
    resampler->Update();
    if (errors.count > 0 || drawn.cloud->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const auto expected = trial::copyOf(resampler->GetOutput());
    for (const pointhaptics::InstructionSet set : pointhaptics::heldInstructionSets())
    {
      resampler->SetInstructionSet(filterSet(set));
      resampler->Update();
      trial::expectSame(resampler->GetOutput(), expected);
    }
    ASSERT_FALSE(HasFailure());
  }
}

INSTANTIATE_TEST_SUITE_P(AllTypes, VoxelMeanVariants,
  testing::Combine(testing::Values(VTK_FLOAT, VTK_DOUBLE), testing::Bool()),
  [](const auto& param)
  {
    return std::string(std::get<0>(param.param) == VTK_FLOAT ? "Float" : "Double") +
      (std::get<1>(param.param) ? "WithAttributes" : "PointsOnly");
  });
