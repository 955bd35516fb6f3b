// Tests of the behaviour that all filters share: composites, errors, ports, warnings.
#include "VoxelMeanCases.h"
#include "vtkKernelBandwidthFilter.h"

#include <gtest/gtest.h>
#include <vtkCompositeDataIterator.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{

/// Points of the unit cube, moved along x.
vtkSmartPointer<vtkPolyData> cloudAt(double x, int count, std::uint64_t seed)
{
  const auto points = trial::randomPoints(count, seed, VTK_DOUBLE);
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    points->SetPoint(i, p[0] + x, p[1], p[2]);
  }
  return trial::cloudOf(points);
}

/// Two clouds, what is no cloud, an empty block, and a tree below.
vtkSmartPointer<vtkMultiBlockDataSet> treeOf(vtkPolyData* first, vtkPointSet* second)
{
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, vtkNew<vtkTable>());
  inner->SetBlock(1, second);
  auto tree = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  tree->SetBlock(0, first);
  tree->SetBlock(1, vtkNew<vtkImageData>());
  tree->SetBlock(2, inner);
  tree->SetBlock(3, nullptr);
  tree->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "scan");
  tree->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "picture");
  return tree;
}

/// The clouds of a composite, in its order.
std::vector<vtkSmartPointer<vtkPolyData>> cloudsIn(vtkDataObject* composite)
{
  std::vector<vtkSmartPointer<vtkPolyData>> clouds;
  auto* tree = vtkCompositeDataSet::SafeDownCast(composite);
  const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(tree->NewIterator());
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    clouds.emplace_back(vtkPolyData::SafeDownCast(block->GetCurrentDataObject()));
  }
  return clouds;
}

void setPlaces(vtkPointSet* grid, vtkPolyData* cloud)
{
  grid->SetPoints(cloud->GetPoints());
  grid->GetPointData()->ShallowCopy(cloud->GetPointData());
}

vtkSmartPointer<vtkPolyData> cloudOfBoth(vtkPolyData* first, vtkPolyData* second)
{
  vtkNew<vtkPoints> all;
  all->SetDataTypeToDouble();
  for (vtkPolyData* cloud : { first, second })
  {
    for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
    {
      all->InsertNextPoint(cloud->GetPoint(i));
    }
  }
  return trial::cloudOf(all);
}

double spacingOf(vtkPolyData* means)
{
  return means->GetFieldData()->GetArray("LatticeSpacing")->GetComponent(0, 0);
}

TEST(CloudAlgorithm, BlocksOfACompositeShareOneLatticeAndAreCountedTogether)
{
  const auto near = cloudAt(0, 2000, 1);
  const auto far = cloudAt(3, 1000, 2);
  vtkNew<vtkUnstructuredGrid> grid;
  setPlaces(grid, far);
  vtkNew<vtkVoxelMeanResampler> whole;
  whole->SetDimensions(20, 20, 20);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetDimensions(20, 20, 20);
  resampler->SetInputDataObject(treeOf(near, grid));
  trial::Ear warnings(resampler, vtkCommand::WarningEvent);
  resampler->Update();
  EXPECT_EQ(warnings.count, 1);
  EXPECT_NE(warnings.last.find("\"picture\" (vtkImageData)"), std::string::npos) << warnings.last;
  EXPECT_NE(warnings.last.find("(vtkTable)"), std::string::npos) << warnings.last;
  auto* output = vtkMultiBlockDataSet::SafeDownCast(resampler->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  EXPECT_EQ(output->GetNumberOfBlocks(), 4u);
  EXPECT_STREQ(output->GetMetaData(0u)->Get(vtkCompositeDataSet::NAME()), "scan");
  EXPECT_EQ(output->GetBlock(1), nullptr);
  const auto clouds = cloudsIn(output);
  ASSERT_EQ(clouds.size(), 2u);
  // The lattice of both is that of all points, and each is what those points give on it.
  whole->SetInputData(cloudOfBoth(near, far));
  whole->Update();
  EXPECT_EQ(spacingOf(clouds[0]), spacingOf(whole->GetOutput()));
  EXPECT_EQ(spacingOf(clouds[1]), spacingOf(whole->GetOutput()));
  EXPECT_EQ(clouds[0]->GetNumberOfPoints() + clouds[1]->GetNumberOfPoints(),
    whole->GetOutput()->GetNumberOfPoints()); // no voxel has points of both
}

/// @p first and @p second in each kind of composite, with what the kind is called.
std::vector<std::pair<std::string, vtkSmartPointer<vtkDataObject>>> compositesOf(
  vtkPolyData* first, vtkPolyData* second)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, first);
  blocks->SetBlock(1, second);
  vtkNew<vtkPartitionedDataSet> parts;
  parts->SetPartition(0, first);
  parts->SetPartition(1, second);
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, first);
  collection->SetPartition(1, 0, second);
  vtkNew<vtkPartitionedDataSetCollection> both;
  both->SetPartitionedDataSet(1, parts);
  vtkNew<vtkMultiBlockDataSet> tree;
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(1, second);
  tree->SetBlock(0, first);
  tree->SetBlock(2, inner);
  return { { "blocks", blocks.Get() }, { "partitions", parts.Get() }, { "collection", collection.Get() },
    { "tree of partitions", both.Get() }, { "tree of blocks", tree.Get() } };
}

TEST(CloudAlgorithm, EveryKindOfCompositeHasOneLatticeByDefault)
{
  const auto near = cloudAt(0, 2000, 1);
  const auto far = cloudAt(3, 1000, 2);
  vtkNew<vtkVoxelMeanResampler> whole;
  whole->SetDimensions(20, 20, 20);
  whole->SetInputData(cloudOfBoth(near, far));
  whole->Update();
  vtkFieldData* const expected = whole->GetOutput()->GetFieldData();
  for (const auto& [kind, composite] : compositesOf(near, far))
  {
    SCOPED_TRACE(kind);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetDimensions(20, 20, 20);
    resampler->SetInputDataObject(composite);
    resampler->Update();
    const auto clouds = cloudsIn(resampler->GetOutputDataObject(0));
    ASSERT_EQ(clouds.size(), 2u);
    vtkIdType means = 0;
    for (vtkPolyData* cloud : clouds)
    {
      means += cloud->GetNumberOfPoints();
      for (const char* name : { "LatticeOrigin", "LatticeSpacing", "LatticeDimensions" })
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          EXPECT_EQ(cloud->GetFieldData()->GetArray(name)->GetComponent(0, axis),
            expected->GetArray(name)->GetComponent(0, axis))
            << name;
        }
      }
    }
    EXPECT_EQ(means, whole->GetOutput()->GetNumberOfPoints()); // no voxel has points of both
  }
}

TEST(CloudAlgorithm, FarPointsOfACompositeAreFarFromAllItsBlocks)
{
  const auto cloud = cloudAt(0, 2000, 1);
  const auto strays = cloudAt(500, 10, 2); // too few to be judged by themselves
  vtkNew<vtkVoxelMeanResampler> alone;
  alone->SetInputData(cloud);
  alone->Update();
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputDataObject(treeOf(cloud, strays));
  trial::Ear warnings(resampler, vtkCommand::WarningEvent);
  resampler->Update();
  EXPECT_EQ(warnings.count, 2);
  EXPECT_NE(warnings.last.find("10 of 2,010 points are far from all others"), std::string::npos)
    << warnings.last;
  EXPECT_NEAR(spacingOf(cloudsIn(resampler->GetOutputDataObject(0))[0]), spacingOf(alone->GetOutput()), 1e-9);
}

TEST(CloudAlgorithm, CountersAreSumsInAnyOrder)
{
  const auto nearer = cloudAt(0, 500, 3);
  const auto farther = cloudAt(0.5, 700, 4);
  const double nan = std::nan("");
  nearer->GetPoints()->SetPoint(7, nan, 0, 0);
  farther->GetPoints()->SetPoint(8, nan, 0, 0);
  vtkNew<vtkVoxelMeanResampler> alone;
  vtkIdType clipped = 0;
  for (vtkPolyData* cloud : { nearer.Get(), farther.Get() })
  {
    alone->SetInputData(cloud);
    alone->SetWorkspaceBounds(0, 1, 0, 1, 0, 0.7);
    alone->Update();
    clipped += alone->GetNumberOfClippedPoints();
  }
  EXPECT_GT(clipped, 300);
  for (const bool isSwapped : { false, true })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 0.7);
    resampler->SetInputDataObject(treeOf(isSwapped ? farther : nearer, isSwapped ? nearer : farther));
    resampler->Update();
    EXPECT_EQ(resampler->GetNumberOfClippedPoints(), clipped);
    EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 2);
  }
}

TEST(CloudAlgorithm, TreesOfPartitionsKeepTheirStructure)
{
  vtkNew<vtkPartitionedDataSet> parts;
  parts->SetPartition(0, cloudAt(0, 300, 5));
  parts->SetPartition(1, cloudAt(1, 400, 6));
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartitionedDataSet(0, parts);
  collection->SetPartition(1, 0, cloudAt(2, 100, 7));
  vtkNew<vtkVoxelMeanResampler> resampler;
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  resampler->SetInputDataObject(collection);
  resampler->ComputeVoxelIndexOn();
  bandwidth->SetInputConnection(resampler->GetOutputPort());
  bandwidth->Update();
  auto* output = vtkPartitionedDataSetCollection::SafeDownCast(bandwidth->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  ASSERT_EQ(output->GetNumberOfPartitionedDataSets(), 2u);
  EXPECT_EQ(output->GetNumberOfPartitions(0), 2u);
  for (vtkPolyData* cloud : cloudsIn(output))
  {
    EXPECT_GT(cloud->GetNumberOfPoints(), 50);
    EXPECT_TRUE(cloud->GetPointData()->HasArray("ProxyRadius"));
  }
  const auto indexed = cloudsIn(resampler->GetOutputDataObject(1));
  ASSERT_EQ(indexed.size(), 3u);
  EXPECT_EQ(indexed[1]->GetPointData()->GetArray("VoxelIndex")->GetNumberOfTuples(), 400);
  // And back to one cloud.
  resampler->SetInputDataObject(cloudAt(0, 300, 5));
  bandwidth->Update();
  EXPECT_GT(bandwidth->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(CloudAlgorithm, TheBandwidthFilterTakesPointsOfAnyDataSet)
{
  const auto cloud = cloudAt(0, 500, 8);
  trial::addArray(cloud, "Heat", std::vector<double>(500, 1.0));
  vtkNew<vtkUnstructuredGrid> grid;
  setPlaces(grid, cloud);
  vtkNew<vtkKernelBandwidthFilter> expected;
  expected->SetInputData(cloud);
  expected->Update();
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  bandwidth->SetInputData(grid);
  bandwidth->Update();
  EXPECT_EQ(bandwidth->GetOutput()->GetNumberOfVerts(), 500);
  EXPECT_TRUE(bandwidth->GetOutput()->GetPointData()->HasArray("Heat"));
  for (vtkIdType i = 0; i < 500; ++i)
  {
    ASSERT_EQ(bandwidth->GetOutput()->GetPointData()->GetArray("Bandwidth")->GetComponent(i, 0),
      expected->GetOutput()->GetPointData()->GetArray("Bandwidth")->GetComponent(i, 0));
  }
}

/// Each filter with a setting that no run can have.
std::vector<vtkSmartPointer<vtkCloudAlgorithm>> refusingFilters()
{
  const auto resampler = vtkSmartPointer<vtkVoxelMeanResampler>::New();
  resampler->SetDimensions(0, 1, 1);
  const auto bandwidth = vtkSmartPointer<vtkKernelBandwidthFilter>::New();
  bandwidth->SetNumberOfNeighbors(0);
  return { resampler, bandwidth };
}

TEST(CloudAlgorithm, AnErrorIsSaidOnEachUpdateAndLeavesEmptyPoints)
{
  for (const bool isComposite : { false, true })
  {
    for (vtkCloudAlgorithm* filter : refusingFilters())
    {
      SCOPED_TRACE(filter->GetClassName());
      const auto cloud = cloudAt(0, 100, 9);
      vtkSmartPointer<vtkDataObject> input = cloud;
      if (isComposite)
      {
        input = treeOf(cloud, cloudAt(1, 100, 10));
      }
      filter->SetInputDataObject(input);
      trial::Ear errors(filter, vtkCommand::ErrorEvent);
      trial::Ear warnings(filter, vtkCommand::WarningEvent);
      for (int time = 1; time <= 3; ++time)
      {
        filter->Update();
        EXPECT_EQ(errors.count, time);
        EXPECT_EQ(warnings.count, 0) << "the error is the only message";
        EXPECT_NE(filter->GetErrorCode(), 0u);
      }
      filter->RepeatsErrorsOff();
      filter->Update();
      filter->Update();
      EXPECT_EQ(errors.count, 4) << "once after it was set";
      const std::vector<vtkSmartPointer<vtkPolyData>> outputs = isComposite
        ? cloudsIn(filter->GetOutputDataObject(0))
        : std::vector<vtkSmartPointer<vtkPolyData>>{ filter->GetOutput() };
      for (vtkPolyData* output : outputs)
      {
        ASSERT_NE(output->GetPoints(), nullptr);
        EXPECT_EQ(output->GetNumberOfPoints(), 0);
      }
      // Mended, it is silent, and runs once.
      if (auto* resampler = vtkVoxelMeanResampler::SafeDownCast(filter))
      {
        resampler->SetDimensions(9, 9, 9);
      }
      else
      {
        vtkKernelBandwidthFilter::SafeDownCast(filter)->SetNumberOfNeighbors(8);
      }
      filter->Update();
      EXPECT_EQ(errors.count, 4);
      EXPECT_EQ(filter->GetErrorCode(), 0u);
      const vtkMTimeType made = filter->GetOutputDataObject(0)->GetMTime();
      filter->Update();
      EXPECT_EQ(filter->GetOutputDataObject(0)->GetMTime(), made);
    }
  }
}

TEST(CloudAlgorithm, PortsAreThereFromConstruction)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  EXPECT_EQ(resampler->GetNumberOfOutputPorts(), 2);
  EXPECT_NE(resampler->GetOutput(), nullptr) << "before an update, too";
  EXPECT_NE(resampler->GetOutput(1), nullptr);
  vtkNew<vtkKernelBandwidthFilter> after;
  resampler->SetInputData(cloudAt(0, 100, 11));
  after->SetInputConnection(resampler->GetOutputPort(1));
  for (const bool asks : { true, false, true })
  {
    resampler->SetComputeVoxelIndex(asks);
    after->Update();
    ASSERT_EQ(after->GetNumberOfInputConnections(0), 1);
    EXPECT_EQ(after->GetOutput()->GetNumberOfPoints(), asks ? 100 : 0);
  }
}

/// A setting that an observer of progress changes counts from the next update on.
TEST(CloudAlgorithm, WhatIsSetInARunCountsFromTheNextOn)
{
  const auto cloud = cloudAt(0, 20000, 12);
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(cloud);
  vtkNew<vtkCallbackCommand> once;
  once->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* self = vtkKernelBandwidthFilter::SafeDownCast(caller);
      if (self->GetProgress() > 0.0 && self->GetProgress() < 1.0)
      {
        self->ComputeDensityOn();
        self->SetRadiusScale(2.0);
        self->RemoveAllInputs();
        self->SetNumberOfNeighbors(9);
      }
    });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, once);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 20000);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("Density"));
  filter->RemoveObserver(tag);
  filter->SetInputData(cloud);
  filter->Update();
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray("Density"));

  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  vtkNew<vtkCallbackCommand> covariance;
  covariance->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* self = vtkVoxelMeanResampler::SafeDownCast(caller);
      self->SetComputeCovariance(self->GetComputeCovariance() || self->GetProgress() > 0.0);
    });
  resampler->AddObserver(vtkCommand::ProgressEvent, covariance);
  for (const bool has : { false, true })
  {
    resampler->Update();
    EXPECT_EQ(resampler->GetOutput()->GetPointData()->HasArray("VoxelCovariance") != 0, has);
  }
}

/// Observers of the first events may take away the only reference to the input.
TEST(CloudAlgorithm, AnInputThatIsTakenAwayBeforeTheRunIsAnError)
{
  for (const auto event : { vtkCommand::StartEvent, vtkCommand::ProgressEvent, vtkCommand::EndEvent })
  {
    const std::vector<vtkSmartPointer<vtkCloudAlgorithm>> filters{
      vtkSmartPointer<vtkVoxelMeanResampler>::New(), vtkSmartPointer<vtkKernelBandwidthFilter>::New()
    };
    for (vtkCloudAlgorithm* filter : filters)
    {
      SCOPED_TRACE(filter->GetClassName());
      filter->SetInputDataObject(cloudAt(0, 2000, 16));
      vtkNew<vtkCallbackCommand> take;
      take->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
        { vtkAlgorithm::SafeDownCast(caller)->RemoveAllInputs(); });
      const unsigned long tag = filter->AddObserver(event, take);
      filter->Update();
      ASSERT_NE(filter->GetOutput()->GetPoints(), nullptr);
      EXPECT_EQ(filter->GetErrorCode() != 0, event != vtkCommand::EndEvent) << filter->GetErrorMessage();
      filter->RemoveObserver(tag);
      filter->SetInputDataObject(cloudAt(0, 2000, 16));
      filter->Update();
      EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0);
    }
  }
}

/// Updates a filter and returns what it warned of.
std::vector<std::string> warningsOf(vtkAlgorithm* filter)
{
  std::vector<std::string> texts;
  vtkNew<vtkCallbackCommand> listen;
  listen->SetClientData(&texts);
  listen->SetCallback([](vtkObject*, unsigned long, void* to, void* text)
    { static_cast<std::vector<std::string>*>(to)->emplace_back(static_cast<const char*>(text)); });
  const unsigned long tag = filter->AddObserver(vtkCommand::WarningEvent, listen);
  filter->Update();
  filter->RemoveObserver(tag);
  return texts;
}

void expectWarning(vtkAlgorithm* filter, const std::string& part)
{
  const std::vector<std::string> texts = warningsOf(filter);
  ASSERT_EQ(texts.size(), 1u) << part;
  EXPECT_NE(texts[0].find(part), std::string::npos) << texts[0];
}

TEST(CloudAlgorithm, WhatIsOfNoUseIsSaidOnce)
{
  const auto cloud = cloudAt(0, 100, 13);
  trial::addArray(cloud, "classification", std::vector<double>(100, 3.0));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputDataObject(treeOf(cloud, cloudAt(1, 100, 14)));
  EXPECT_EQ(warningsOf(resampler).size(), 1u) << "of the blocks";
  resampler->SetInputData(cloud);
  EXPECT_EQ(warningsOf(resampler).size(), 0u);
  EXPECT_TRUE(resampler->IsCategoricalArray("classification"));
  resampler->AddCategoricalArray("no such");
  expectWarning(resampler, "no point array \"no such\"");
  resampler->ClearCategoricalArrays();
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("Persons");
  ids->SetNumberOfTuples(100);
  ids->Fill(1);
  cloud->GetPointData()->SetPedigreeIds(ids);
  expectWarning(resampler, "\"Persons\" holds ids");
  cloud->GetPointData()->RemoveArray("Persons");
  resampler->SetWorkspaceBounds(5, 6, 5, 6, 5, 6);
  expectWarning(resampler, "No point is left: 100 lie outside of the workspace");

  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  bandwidth->SetInputData(cloud);
  EXPECT_EQ(warningsOf(bandwidth).size(), 0u);
  for (const std::vector<double>& counts : { std::vector<double>(100, 0.0), std::vector<double>(99, 1.0) })
  {
    trial::addArray(cloud, "VoxelPointCount", counts);
    expectWarning(bandwidth, "VoxelPointCount is not a number above 0");
    cloud->GetPointData()->RemoveArray("VoxelPointCount");
  }
  for (vtkIdType i = 0; i < 30; ++i)
  {
    cloud->GetPoints()->SetPoint(i, std::nan(""), 0, 0);
  }
  cloud->Modified();
  expectWarning(bandwidth, "30 of 100 points are NaN or infinite");
}

/// All points are neighbours of each: the longest search there is.
TEST(CloudAlgorithm, ALongSearchCanBeStopped)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(cloudAt(0, 8000, 15));
  filter->SetNumberOfNeighbors(10000000);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* self = vtkAlgorithm::SafeDownCast(caller);
      self->SetAbortExecute(self->GetProgress() > 0.1);
    });
  filter->AddObserver(vtkCommand::ProgressEvent, stop);
  filter->Update();
  EXPECT_LT(filter->GetProgress(), 0.2) << "it hears of the stop soon";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(CloudAlgorithm, SettingsStayInTheirRanges)
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
}

/// The last events of a run come after its work.
TEST(CloudAlgorithm, WhatIsSetAtTheEndOfARunCountsFromTheNextOn)
{
  for (const auto event : { vtkCommand::WarningEvent, vtkCommand::ProgressEvent })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloudAt(0, 2000, 17));
    resampler->AddCategoricalArray("none");
    vtkNew<vtkCallbackCommand> covariance;
    covariance->SetCallback(
      [](vtkObject* caller, unsigned long kind, void*, void*)
      {
        auto* self = vtkVoxelMeanResampler::SafeDownCast(caller);
        self->SetComputeCovariance(
          self->GetComputeCovariance() || kind == vtkCommand::WarningEvent || self->GetProgress() >= 1.0);
      });
    resampler->AddObserver(event, covariance);
    for (const bool has : { false, true })
    {
      resampler->Update();
      EXPECT_EQ(resampler->GetOutput()->GetPointData()->HasArray("VoxelCovariance") != 0, has) << event;
    }
  }
}

} // namespace
