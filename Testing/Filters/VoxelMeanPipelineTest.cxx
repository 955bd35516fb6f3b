// The resampler as a citizen of the pipeline: progress, abort, and no work that nobody asked for.
#include "CountingArray.h"
#include "VoxelMeanCases.h"

#include "Unit/HeapBytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <vector>

namespace
{

/// Hears every progress event of an algorithm.
class Progress
{
public:
  explicit Progress(vtkAlgorithm* algorithm)
    : algorithm_(algorithm)
  {
    callback_->SetClientData(this);
    callback_->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*)
      {
        Progress* progress = static_cast<Progress*>(self);
        progress->heard.push_back(progress->algorithm_->GetProgress());
        if (progress->heard.back() >= progress->abortAt)
        {
          progress->algorithm_->SetAbortExecute(1);
        }
        if (progress->then && progress->heard.back() > 0.0 && progress->heard.back() < 1.0)
        {
          progress->then();
        }
      });
    tag_ = algorithm->AddObserver(vtkCommand::ProgressEvent, callback_);
  }
  ~Progress() { algorithm_->RemoveObserver(tag_); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  std::vector<double> heard;
  std::function<void()> then; ///< Called at each event within the work.
  double abortAt = 2.0;       ///< Progress at which it asks to stop.

private:
  vtkAlgorithm* algorithm_;
  vtkNew<vtkCallbackCommand> callback_;
  unsigned long tag_ = 0;
};

}

TEST(VoxelMeanPipeline, ProgressGrowsFromZeroToOne)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(300000, 51, VTK_FLOAT));
  trial::addScanAttributes(cloud, 52);
  for (const int columns : { 50, 5000 })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    resampler->SetDimensions(columns, 50, 50);
    Progress progress(resampler);
    resampler->Update();
    ASSERT_GE(progress.heard.size(), 2u);
    EXPECT_GE(progress.heard.front(), 0.0);
    EXPECT_EQ(progress.heard.back(), 1.0);
    for (std::size_t i = 1; i < progress.heard.size(); ++i)
    {
      EXPECT_GE(progress.heard[i], progress.heard[i - 1]) << columns;
    }
  }
}

TEST(VoxelMeanPipeline, AbortStopsALongRunWhichThenStartsAfresh)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(3000000, 53, VTK_FLOAT));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 100);
  for (const double stop : { 1e-6, 0.5 })
  {
    SCOPED_TRACE(stop);
    trial::Ear errors(resampler, vtkCommand::ErrorEvent);
    {
      Progress progress(resampler);
      progress.abortAt = stop;
      resampler->Modified();
      resampler->Update();
      ASSERT_FALSE(progress.heard.empty());
      EXPECT_LT(progress.heard.back(), 1.0) << "no steps left to stop between";
    }
    EXPECT_EQ(errors.count, 0) << errors.last;
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
    trial::expectValid(resampler->GetOutput());
    resampler->SetAbortExecute(0);
    resampler->Update();
    EXPECT_EQ(trial::sum(trial::countsOf(resampler->GetOutput())), 3000000);
    EXPECT_GT(resampler->GetOutput()->GetNumberOfPoints(), 900000);
  }
}

TEST(VoxelMeanPipeline, TheSearchForTheWorkspaceAndTheIndexCanBeStopped)
{
  SKIP_WITHOUT_HEAP();
  const auto cloud = trial::cloudOf(trial::randomPoints(1500000, 54, VTK_FLOAT));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetDimensions(60, 60, 60);
  trial::Ear errors(resampler, vtkCommand::ErrorEvent);
  // Ends an update at its first event, and finds nothing else changed.
  const auto stopAtFirstEvent = [&](double before)
  {
    Progress progress(resampler);
    progress.abortAt = 1e-6;
    resampler->Modified();
    resampler->Update();
    ASSERT_FALSE(progress.heard.empty());
    EXPECT_LT(progress.heard.back(), before);
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
    trial::expectValid(resampler->GetOutput());
    resampler->SetAbortExecute(0);
  };
  stopAtFirstEvent(0.1); // the workspace
  resampler->Update();
  EXPECT_EQ(trial::sum(trial::countsOf(resampler->GetOutput())), 1500000);

  resampler->SetWorkspaceBounds(0.2, 0.4, 0.2, 0.4, 0.2, 0.4);
  resampler->Update();
  const auto part = trial::copyOf(resampler->GetOutput());
  const std::size_t withoutIndex = pointhaptics::heapBytes();
  stopAtFirstEvent(0.3);                     // the index, which this second look at a part would make
  const std::size_t half = 1500000 * 16 / 2; // of the index
  EXPECT_LT(pointhaptics::heapBytes(), withoutIndex + half);
  for (int i = 0; i < 2; ++i)
  {
    resampler->Modified();
    resampler->Update();
    trial::expectSame(resampler->GetOutput(), part);
  }
  EXPECT_GT(pointhaptics::heapBytes(), withoutIndex + half) << "made after all";
  EXPECT_EQ(errors.count, 0) << errors.last;
}

TEST(VoxelMeanPipeline, ArraysCanBeStoppedBetween)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(20000, 59, VTK_FLOAT));
  trial::addScanAttributes(cloud, 60);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 40);
  std::vector<double> heard;
  {
    Progress progress(resampler);
    resampler->Update();
    heard = progress.heard;
  }
  const auto between = [&](double low, double high)
  {
    return std::count_if(
      heard.begin(), heard.end(), [=](double fraction) { return fraction > low && fraction < high; });
  };
  EXPECT_GE(between(0.9, 1.0), cloud->GetPointData()->GetNumberOfArrays()) << "a step for each array";
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  const auto whole = trial::copyOf(resampler->GetOutput());
  for (const double stop : { 0.26, 0.49, 0.7, 0.91, 0.97 })
  {
    SCOPED_TRACE(stop);
    resampler->Modified();
    {
      Progress progress(resampler);
      progress.abortAt = stop;
      resampler->Update();
      EXPECT_LT(progress.heard.back(), 1.0);
    }
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
    resampler->SetAbortExecute(0);
    resampler->Update();
    trial::expectSame(resampler->GetOutput(), whole);
  }
}

TEST(VoxelMeanPipeline, ALongCountOfLabelsCanBeStopped)
{
  constexpr int kPoints = 3000000;
  const auto cloud = trial::cloudOf(trial::randomPoints(kPoints, 61, VTK_FLOAT));
  std::vector<double> labels(kPoints);
  for (int i = 0; i < kPoints; ++i)
  {
    labels[std::size_t(i)] = i % 7;
  }
  trial::addArray(cloud, "Classification", labels);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 20);
  std::vector<double> steps;
  {
    Progress progress(resampler);
    resampler->Update();
    std::copy_if(progress.heard.begin(), progress.heard.end(), std::back_inserter(steps),
      [](double fraction) { return fraction > 0.5 && fraction < 0.91; }); // once all points are binned
  }
  EXPECT_GE(steps.size(), 3u) << "three million points";
  EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
  const auto whole = trial::copyOf(resampler->GetOutput());
  for (const double stop : steps)
  {
    SCOPED_TRACE(stop);
    resampler->Modified();
    {
      Progress progress(resampler);
      progress.abortAt = stop;
      resampler->Update();
      EXPECT_EQ(progress.heard.back(), stop);
    }
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
    trial::expectValid(resampler->GetOutput());
    resampler->SetAbortExecute(0);
  }
  resampler->Update();
  trial::expectSame(resampler->GetOutput(), whole);
}

TEST(VoxelMeanPipeline, WhatAnObserverOfProgressAsksForIsOfTheNextUpdate)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(50000, 56, VTK_FLOAT));
  trial::addScanAttributes(cloud, 57);
  const auto prepared = [&](vtkVoxelMeanResampler* resampler)
  {
    resampler->SetInputData(cloud);
    trial::useUnitCube(resampler, 30);
    resampler->ComputeVoxelIndexOn();
  };
  vtkNew<vtkVoxelMeanResampler> quiet;
  prepared(quiet);
  quiet->Update();
  const std::vector<std::function<void(vtkVoxelMeanResampler*)>> requests = {
    [](vtkVoxelMeanResampler* r) { r->ComputeCovarianceOn(); },
    [](vtkVoxelMeanResampler* r) { r->ComputeVoxelIndexOff(); },
    [](vtkVoxelMeanResampler* r) { r->SetRepresentativeToMedian(); },
    [](vtkVoxelMeanResampler* r) { r->AddCategoricalArray("intensity"); },
    [](vtkVoxelMeanResampler* r) { r->SetMinimumPointsPerVoxel(5); },
    [](vtkVoxelMeanResampler* r) { r->SetTransform(vtkSmartPointer<vtkTransform>::New()); },
    [](vtkVoxelMeanResampler* r) { r->SetInputData(vtkSmartPointer<vtkPolyData>::New()); },
    [](vtkVoxelMeanResampler* r) { r->SetInputConnection(nullptr); },
    [](vtkVoxelMeanResampler* r) { r->RemoveAllInputs(); },
    [](vtkVoxelMeanResampler* r) { r->PassAttributesOff(); },
    [](vtkVoxelMeanResampler* r) { r->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION); },
    [](vtkVoxelMeanResampler* r) { r->SetDimensions(7, 7, 7); },
    [](vtkVoxelMeanResampler* r) { r->SetUsePointIndex(false); },
    [](vtkVoxelMeanResampler* r) { r->SetInstructionSet(vtkVoxelMeanResampler::InstructionSetBaseline); },
  };
  for (std::size_t i = 0; i < requests.size(); ++i)
  {
    SCOPED_TRACE(i);
    vtkNew<vtkVoxelMeanResampler> resampler;
    prepared(resampler);
    vtkSmartPointer<vtkPolyData> second = resampler->GetOutput(1);
    Progress progress(resampler);
    int calls = 0;
    progress.then = [&]()
    {
      ++calls;
      requests[i](resampler);
    };
    resampler->Update();
    EXPECT_GE(calls, 1);
    trial::expectSame(resampler->GetOutput(), quiet->GetOutput());
    trial::expectSame(second, quiet->GetOutput(1));
    EXPECT_EQ(resampler->GetNumberOfOutputPorts(), 2);
  }
}

TEST(VoxelMeanPipeline, HoldsOnToNothingOfItsInput)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 58));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  const int before = cloud->GetPoints()->GetData()->GetReferenceCount();
  resampler->Update();
  EXPECT_EQ(cloud->GetPoints()->GetData()->GetReferenceCount(), before);
  resampler->SetVoxelSize(-1);
  trial::expectError(resampler, "voxel size must be finite and above 0");
  EXPECT_EQ(cloud->GetPoints()->GetData()->GetReferenceCount(), before) << "after an error";
}

TEST(VoxelMeanPipeline, ReadsNoArrayThatNobodyAskedFor)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 54));
  const auto array =
    trial::addColumns<trial::CountingArray>(cloud, "Heat", 2, [](vtkIdType, int) { return 1.0; });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->PassAttributesOff();
  const long before = array->reads();
  resampler->Update();
  EXPECT_EQ(array->reads(), before);
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetNumberOfArrays(), 1);
  resampler->PassAttributesOn();
  resampler->Update();
  EXPECT_GE(array->reads(), before + 2000);
  EXPECT_NE(resampler->GetOutput()->GetPointData()->GetArray("Heat"), nullptr);
  const long after = array->reads();
  resampler->Update();
  EXPECT_EQ(array->reads(), after) << "nothing changed";
}

TEST(VoxelMeanPipeline, TakesPointsOfEveryLayoutAndType)
{
  // Coordinates 0 to 7, which every type holds.
  std::mt19937_64 engine(55);
  vtkNew<vtkPoints> plain;
  plain->SetDataTypeToDouble();
  for (int i = 0; i < 500; ++i)
  {
    plain->InsertNextPoint(double(engine() % 8), double(engine() % 8), double(engine() % 8));
  }
  const auto resampled = [](vtkPoints* points)
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(trial::cloudOf(points));
    resampler->SetWorkspaceBounds(0, 8, 0, 8, 0, 8);
    resampler->SetDimensions(3, 3, 3);
    resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    resampler->Update();
    return trial::copyOf(resampler->GetOutput());
  };
  const auto expected = resampled(plain);
  ASSERT_EQ(expected->GetNumberOfPoints(), 27);
  for (const int type : { VTK_FLOAT, VTK_INT, VTK_SHORT, VTK_UNSIGNED_CHAR, VTK_LONG_LONG })
  {
    SCOPED_TRACE(type);
    vtkNew<vtkPoints> points;
    points->SetDataType(type);
    points->SetNumberOfPoints(500);
    for (int i = 0; i < 500; ++i)
    {
      points->SetPoint(i, plain->GetPoint(i));
    }
    trial::expectSame(resampled(points), expected);
  }
  vtkNew<vtkPolyData> holder;
  holder->SetPoints(plain);
  const auto unknown = trial::addColumns<trial::CountingArray>(
    holder, "Points", 3, [&](vtkIdType i, int c) { return plain->GetPoint(i)[c]; });
  vtkNew<vtkPoints> points;
  points->SetData(unknown);
  trial::expectSame(resampled(points), expected);
}
