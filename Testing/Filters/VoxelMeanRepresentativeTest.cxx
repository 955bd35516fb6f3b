// Representatives other than the mean, voxels that are left out, and the voxel of each point.
#include "VoxelMeanFixtures.h"

#include "vtkBitArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace
{

constexpr vtkIdType kPoints = 3000;

/// With arrays of several types: the number of the point as a float, three colours, a label, a bit.
vtkSmartPointer<vtkPolyData> makeCloud()
{
  const auto cloud = trial::cloudOf(trial::randomPoints(kPoints, 5));
  vtkNew<vtkFloatArray> number;
  number->SetName("Number");
  vtkNew<vtkUnsignedCharArray> colour;
  colour->SetName("RGB");
  colour->SetNumberOfComponents(3);
  vtkNew<vtkIntArray> label;
  label->SetName("Classification");
  vtkNew<vtkBitArray> bit;
  bit->SetName("Bit");
  for (vtkIdType i = 0; i < kPoints; ++i)
  {
    number->InsertNextValue(float(i));
    const double rgb[3] = { double(i * 37 % 256), double(i * 11 % 256), double(i % 7) };
    colour->InsertNextTuple(rgb);
    label->InsertNextValue(int(i % 3));
    bit->InsertNextValue(int(i % 5 == 0));
  }
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(number), static_cast<vtkDataArray*>(colour),
         static_cast<vtkDataArray*>(label), static_cast<vtkDataArray*>(bit) })
  {
    cloud->GetPointData()->AddArray(array);
  }
  return cloud;
}

std::vector<vtkIdType> indexOf(vtkVoxelMeanResampler* resampler)
{
  auto* array = vtkIdTypeArray::SafeDownCast(resampler->GetOutput(1)->GetPointData()->GetArray("VoxelIndex"));
  return array
    ? std::vector<vtkIdType>(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfTuples())
    : std::vector<vtkIdType>();
}

}

TEST(VoxelMeanRepresentative, NearestPointsHaveTheirOwnValuesInAllArrays)
{
  const auto cloud = makeCloud();
  for (const int representative :
    { vtkVoxelMeanResampler::NearestToMean, vtkVoxelMeanResampler::NearestToCenter })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    trial::useUnitCube(resampler, 8);
    resampler->SetInputData(cloud);
    resampler->SetRepresentative(representative);
    resampler->KeepOriginalPointIdsOn();
    resampler->Update();
    vtkPolyData* output = resampler->GetOutput();
    trial::expectValid(output);
    auto* ids = output->GetPointData()->GetArray("vtkOriginalPointIds");
    ASSERT_NE(ids, nullptr);
    ASSERT_GT(output->GetNumberOfPoints(), 100);
    for (vtkIdType v = 0; v < output->GetNumberOfPoints(); ++v)
    {
      const auto point = vtkIdType(ids->GetTuple1(v));
      double place[3];
      double original[3];
      output->GetPoint(v, place);
      cloud->GetPoint(point, original);
      ASSERT_TRUE(std::equal(place, place + 3, original));
      for (const char* name : { "Number", "RGB", "Classification", "Bit" })
      {
        vtkDataArray* found = output->GetPointData()->GetArray(name);
        vtkDataArray* from = cloud->GetPointData()->GetArray(name);
        ASSERT_NE(found, nullptr) << name;
        ASSERT_EQ(found->GetDataType(), from->GetDataType()) << name;
        for (int c = 0; c < found->GetNumberOfComponents(); ++c)
        {
          ASSERT_EQ(found->GetComponent(v, c), from->GetComponent(point, c)) << name;
        }
      }
    }
  }
}

TEST(VoxelMeanRepresentative, MediansAreThoseOfTheMembersComponentByComponent)
{
  const auto cloud = makeCloud();
  vtkNew<vtkVoxelMeanResampler> resampler;
  trial::useUnitCube(resampler, 6);
  resampler->SetInputData(cloud);
  resampler->SetRepresentativeToMedian();
  resampler->ComputeVoxelIndexOn();
  resampler->Update();
  vtkPolyData* output = resampler->GetOutput();
  trial::expectValid(output);
  const std::vector<vtkIdType> index = indexOf(resampler);
  ASSERT_EQ(vtkIdType(index.size()), kPoints);
  const auto expectMedians = [&](vtkDataArray* from, vtkDataArray* found)
  {
    for (int c = 0; c < from->GetNumberOfComponents(); ++c)
    {
      std::vector<std::vector<double>> values(std::size_t(output->GetNumberOfPoints()));
      for (vtkIdType i = 0; i < kPoints; ++i)
      {
        values[std::size_t(index[std::size_t(i)])].push_back(from->GetComponent(i, c));
      }
      for (std::size_t v = 0; v < values.size(); ++v)
      {
        std::sort(values[v].begin(), values[v].end());
        ASSERT_EQ(found->GetComponent(vtkIdType(v), c), values[v][(values[v].size() - 1) / 2]);
      }
    }
  };
  expectMedians(cloud->GetPoints()->GetData(), output->GetPoints()->GetData());
  for (const char* name : { "Number", "RGB", "Bit" })
  {
    expectMedians(cloud->GetPointData()->GetArray(name), output->GetPointData()->GetArray(name));
  }
}

TEST(VoxelMeanRepresentative, EachPointKnowsItsVoxelInEveryModeWithAndWithoutLevels)
{
  const auto cloud = makeCloud();
  for (int representative = vtkVoxelMeanResampler::Mean; representative <= vtkVoxelMeanResampler::Median;
       ++representative)
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    trial::useUnitCube(resampler, 12);
    resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 0.5);
    resampler->SetInputData(cloud);
    resampler->SetMinimumPointsPerVoxel(3);
    resampler->ComputeVoxelIndexOn();
    resampler->SetRepresentative(representative);
    resampler->Update();
    const std::vector<vtkIdType> index = indexOf(resampler);
    ASSERT_EQ(vtkIdType(index.size()), kPoints);
    trial::expectValid(resampler->GetOutput());
    EXPECT_GE(trial::countsOf(resampler->GetOutput())->GetRange()[0], 3.0);
    std::map<vtkIdType, vtkIdType> members;
    for (const vtkIdType voxel : index)
    {
      ++members[voxel];
    }
    const vtkIdType size = resampler->GetOutput()->GetNumberOfPoints();
    EXPECT_GT(members[-1], resampler->GetNumberOfClippedPoints()) << "some voxels have fewer";
    ASSERT_EQ(vtkIdType(members.size()), size + 1);
    for (vtkIdType v = 0; v < size; ++v)
    {
      ASSERT_EQ(members[v], vtkIdType(trial::countsOf(resampler->GetOutput())->GetTuple1(v)));
    }
  }
}

TEST(VoxelMeanRepresentative, LeavingOutVoxelsChangesNoOther)
{
  const auto cloud = makeCloud();
  vtkNew<vtkVoxelMeanResampler> all;
  vtkNew<vtkVoxelMeanResampler> some;
  for (vtkVoxelMeanResampler* resampler : { all.Get(), some.Get() })
  {
    trial::useUnitCube(resampler, 9);
    resampler->SetInputData(cloud);
    resampler->ComputeCovarianceOn();
  }
  some->SetMinimumPointsPerVoxel(5);
  all->Update();
  some->Update();
  vtkPolyData* expected = all->GetOutput();
  vtkPolyData* found = some->GetOutput();
  trial::expectValid(found);
  vtkIdType to = 0;
  for (vtkIdType v = 0; v < expected->GetNumberOfPoints(); ++v)
  {
    if (trial::countsOf(expected)->GetTuple1(v) < 5.0)
    {
      continue;
    }
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(found->GetPoints()->GetData()->GetComponent(to, c),
        expected->GetPoints()->GetData()->GetComponent(v, c));
    }
    for (int i = 0; i < expected->GetPointData()->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = expected->GetPointData()->GetArray(i);
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        ASSERT_EQ(found->GetPointData()->GetArray(i)->GetComponent(to, c), array->GetComponent(v, c));
      }
    }
    ++to;
  }
  EXPECT_EQ(found->GetNumberOfPoints(), to);
  some->SetMinimumPointsPerVoxel(kPoints + 1);
  some->ComputeVoxelIndexOn();
  some->Update();
  trial::expectValid(some->GetOutput());
  EXPECT_EQ(some->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(indexOf(some), std::vector<vtkIdType>(kPoints, -1));
}

TEST(VoxelMeanRepresentative, NormalsOfPointsTurnWithTheCloud)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(500, 6));
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < 500; ++i)
  {
    normals->InsertNextTuple3(1.0, 0.0, 0.0);
  }
  cloud->GetPointData()->SetNormals(normals);
  vtkNew<vtkTransform> transform;
  transform->RotateZ(90);
  transform->Scale(2, 2, 2);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetTransform(transform);
  resampler->SetDimensions(7, 7, 7);
  for (const int representative : { vtkVoxelMeanResampler::NearestToMean, vtkVoxelMeanResampler::Median })
  {
    resampler->SetRepresentative(representative);
    resampler->Update();
    double normal[3];
    resampler->GetOutput()->GetPointData()->GetNormals()->GetTuple(3, normal);
    EXPECT_NEAR(normal[0], 0.0, 1e-7);
    EXPECT_NEAR(normal[1], 1.0, 1e-7);
  }
}

TEST(VoxelMeanRepresentative, IdsOfMeansAreRefusedWithAWarning)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(makeCloud());
  resampler->KeepOriginalPointIdsOn();
  trial::Ear warnings(resampler, vtkCommand::WarningEvent);
  resampler->Update();
  EXPECT_EQ(warnings.count, 1);
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetArray("vtkOriginalPointIds"), nullptr);
}

namespace
{

/// Asks for something else while the filter works.
struct Changer
{
  vtkVoxelMeanResampler* resampler;
  void change()
  {
    if (resampler->GetProgress() == 0.0)
    {
      return; // VTK reports it before the update begins.
    }
    resampler->SetRepresentative((resampler->GetRepresentative() + 1) % 4);
    resampler->SetComputeVoxelIndex(!resampler->GetComputeVoxelIndex());
  }
};

}

TEST(VoxelMeanRepresentative, WhatAnObserverAsksForMeanwhileIsForTheNextUpdate)
{
  for (int representative = vtkVoxelMeanResampler::Mean; representative <= vtkVoxelMeanResampler::Median;
       ++representative)
  {
    vtkNew<vtkVoxelMeanResampler> expected;
    vtkNew<vtkVoxelMeanResampler> changing;
    Changer changer{ changing };
    for (vtkVoxelMeanResampler* resampler : { expected.Get(), changing.Get() })
    {
      trial::useUnitCube(resampler, 8);
      resampler->SetInputData(makeCloud());
      resampler->SetRepresentative(representative);
    }
    changing->AddObserver(vtkCommand::ProgressEvent, &changer, &Changer::change);
    expected->Update();
    changing->Update();
    ASSERT_EQ(changing->GetOutput()->GetNumberOfPoints(), expected->GetOutput()->GetNumberOfPoints());
    for (const char* name : { "Number", "RGB" })
    {
      EXPECT_EQ(changing->GetOutput()->GetPointData()->GetArray(name)->GetComponent(7, 0),
        expected->GetOutput()->GetPointData()->GetArray(name)->GetComponent(7, 0));
    }
  }
}
