#include "FilterFixtures.h"

#include "Core/Reference/ReferenceVoxelMean.h"

#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkMatrix4x4.h"
#include "vtkSMPTools.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkThinPlateSplineTransform.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVoxelMeanResampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace
{

/// A lattice of n^3 voxels over the unit cube.
void useUnitCube(vtkVoxelMeanResampler* resampler, int n)
{
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
  resampler->SetDimensions(n, n, n);
}

vtkIdType sum(vtkDataArray* counts)
{
  double total = 0;
  for (vtkIdType i = 0; i < counts->GetNumberOfTuples(); ++i)
  {
    total += counts->GetTuple1(i);
  }
  return vtkIdType(total);
}

vtkDataArray* countsOf(vtkPolyData* output)
{
  return output->GetPointData()->GetArray("VoxelPointCount");
}

void expectValid(vtkPolyData* output)
{
  ASSERT_NE(output->GetPoints(), nullptr);
  const vtkIdType n = output->GetNumberOfPoints();
  EXPECT_EQ(output->GetNumberOfVerts(), n);
  EXPECT_EQ(output->GetNumberOfCells(), n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    output->GetVerts()->GetCellAtId(i, size, ids);
    ASSERT_EQ(size, 1);
    ASSERT_EQ(ids[0], i);
  }
  for (int a = 0; a < output->GetPointData()->GetNumberOfArrays(); ++a)
  {
    EXPECT_EQ(output->GetPointData()->GetAbstractArray(a)->GetNumberOfTuples(), n)
      << output->GetPointData()->GetAbstractArray(a)->GetName();
  }
}

bool sameArray(vtkDataArray* a, vtkDataArray* b)
{
  return a && b && a->GetDataType() == b->GetDataType() && a->GetNumberOfValues() == b->GetNumberOfValues() &&
    std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
      std::size_t(a->GetNumberOfValues() * a->GetDataTypeSize())) == 0;
}

void expectSame(vtkPolyData* a, vtkPolyData* b)
{
  EXPECT_TRUE(sameArray(a->GetPoints()->GetData(), b->GetPoints()->GetData()));
  ASSERT_EQ(a->GetPointData()->GetNumberOfArrays(), b->GetPointData()->GetNumberOfArrays());
  for (int i = 0; i < a->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = a->GetPointData()->GetArray(i);
    EXPECT_TRUE(sameArray(array, b->GetPointData()->GetArray(array->GetName()))) << array->GetName();
  }
}

/// The error of a filter set to fail: said once, naming the cure, with a valid empty output.
void expectError(vtkVoxelMeanResampler* resampler)
{
  trial::Ear errors(resampler, vtkCommand::ErrorEvent);
  resampler->Update();
  EXPECT_GE(errors.count, 1);
  EXPECT_GT(errors.last.size(), 30u) << errors.last;
  ASSERT_NE(resampler->GetOutput(), nullptr);
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfCells(), 0);
}

} // namespace

TEST(VoxelMeanResampler, AgreesWithTheDefinition)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    const auto cloud = trial::cloudOf(trial::randomPoints(5000, 1, type));
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    useUnitCube(resampler, 9);
    resampler->ComputeCovarianceOn();
    resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    resampler->Update();
    vtkPolyData* output = resampler->GetOutput();
    expectValid(output);

    std::vector<double> coordinates;
    for (vtkIdType i = 0; i < 5000; ++i)
    {
      const double* p = cloud->GetPoint(i);
      coordinates.insert(coordinates.end(), p, p + 3);
    }
    pointhaptics::Lattice lattice;
    lattice.spacing = { 1.0 / 9, 1.0 / 9, 1.0 / 9 };
    lattice.dimensions = { 9, 9, 9 };
    const auto expected =
      pointhaptics::reference::voxelMeans(pointhaptics::PointView(coordinates.data(), 5000), {}, lattice);
    ASSERT_EQ(output->GetNumberOfPoints(), vtkIdType(expected.voxels.size()));
    EXPECT_EQ(sum(countsOf(output)), 5000);
    vtkDataArray* covariances = output->GetPointData()->GetArray("VoxelCovariance");
    ASSERT_NE(covariances, nullptr);
    ASSERT_EQ(covariances->GetNumberOfComponents(), 6);
    vtkIdType v = 0;
    for (const auto& entry : expected.voxels)
    {
      EXPECT_EQ(vtkIdType(countsOf(output)->GetTuple1(v)), vtkIdType(entry.second.members.size()));
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(output->GetPoint(v)[axis], double(entry.second.mean[axis]), 0x1p-31 / 9 + 1e-15);
      }
      for (int m = 0; m < 6; ++m)
      {
        EXPECT_NEAR(covariances->GetComponent(v, m), double(entry.second.covariance[m]), 0x1p-30 / 81);
      }
      ++v;
    }
  }
}

TEST(VoxelMeanResampler, TakesAnyPointSet)
{
  const auto points = trial::randomPoints(1000, 2);
  vtkNew<vtkUnstructuredGrid> unstructured;
  unstructured->SetPoints(points);
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(10, 10, 10);
  structured->SetPoints(points);
  vtkNew<vtkVoxelMeanResampler> resampler;
  useUnitCube(resampler, 5);
  resampler->SetInputData(trial::cloudOf(points));
  resampler->Update();
  vtkNew<vtkPolyData> expected;
  expected->DeepCopy(resampler->GetOutput());
  EXPECT_EQ(expected->GetNumberOfPoints(), 125);
  for (vtkPointSet* input :
    { static_cast<vtkPointSet*>(unstructured.Get()), static_cast<vtkPointSet*>(structured.Get()) })
  {
    resampler->SetInputData(input);
    resampler->Update();
    expectSame(resampler->GetOutput(), expected);
  }
}

TEST(VoxelMeanResampler, AveragesArraysOfEveryTypeWithMatchingTuples)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(3000, 3));
  std::vector<int> types{ VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
    VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG, VTK_FLOAT,
    VTK_DOUBLE, VTK_ID_TYPE };
  std::mt19937_64 engine(4);
  for (const int type : types)
  {
    const auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    array->SetName(("type" + std::to_string(type)).c_str());
    array->SetNumberOfComponents(2);
    array->SetNumberOfTuples(3000);
    for (vtkIdType i = 0; i < 3000; ++i)
    {
      array->SetTuple2(i, double(engine() % 100), double(engine() % 7));
    }
    cloud->GetPointData()->AddArray(array);
  }
  vtkNew<vtkVoxelMeanResampler> resampler;
  useUnitCube(resampler, 1);
  resampler->SetInputData(cloud);
  resampler->Update();
  vtkPolyData* output = resampler->GetOutput();
  expectValid(output);
  ASSERT_EQ(output->GetNumberOfPoints(), 1);
  for (const int type : types)
  {
    const std::string name = "type" + std::to_string(type);
    vtkDataArray* in = cloud->GetPointData()->GetArray(name.c_str());
    vtkDataArray* out = output->GetPointData()->GetArray(name.c_str());
    ASSERT_NE(out, nullptr) << name;
    EXPECT_EQ(out->GetDataType(), type);
    ASSERT_EQ(out->GetNumberOfComponents(), 2);
    for (int c = 0; c < 2; ++c)
    {
      double mean = 0;
      for (vtkIdType i = 0; i < 3000; ++i)
      {
        mean += in->GetComponent(i, c) / 3000;
      }
      const bool whole = type != VTK_FLOAT && type != VTK_DOUBLE;
      EXPECT_NEAR(out->GetComponent(0, c), whole ? std::round(mean) : mean, whole ? 0.0 : 1e-5) << name;
    }
  }
}

TEST(VoxelMeanResampler, RoundsColoursToNearest)
{
  const auto cloud = trial::cloudAt({ { 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0.5 } });
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("RGB");
  colours->SetNumberOfComponents(3);
  colours->InsertNextTuple3(255, 0, 1);
  colours->InsertNextTuple3(255, 0, 1);
  colours->InsertNextTuple3(255, 1, 3);
  cloud->GetPointData()->SetScalars(colours);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->Update();
  auto* out = vtkUnsignedCharArray::SafeDownCast(resampler->GetOutput()->GetPointData()->GetScalars());
  ASSERT_NE(out, nullptr) << "the active scalars stay active";
  EXPECT_EQ(out->GetComponent(0, 0), 255);
  EXPECT_EQ(out->GetComponent(0, 1), 0);
  EXPECT_EQ(out->GetComponent(0, 2), 2) << "5/3 is nearer to 2";
}

TEST(VoxelMeanResampler, TurnsAndRenormalisesTheActiveNormals)
{
  const auto cloud = trial::cloudAt({ { 0, 0, 0 }, { 0, 0, 0 } });
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->InsertNextTuple3(1, 0, 0);
  normals->InsertNextTuple3(0, 0, 1);
  cloud->GetPointData()->SetNormals(normals);
  vtkNew<vtkTransform> transform;
  transform->RotateZ(90);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetTransform(transform);
  resampler->Update();
  vtkDataArray* out = resampler->GetOutput()->GetPointData()->GetNormals();
  ASSERT_NE(out, nullptr);
  EXPECT_NEAR(out->GetComponent(0, 0), 0.0, 1e-6);
  EXPECT_NEAR(out->GetComponent(0, 1), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(out->GetComponent(0, 2), std::sqrt(0.5), 1e-6);
}

TEST(VoxelMeanResampler, NormalsStayPerpendicularUnderUnequalScaling)
{
  const auto cloud = trial::cloudAt({ { 0, 0, 0 } });
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->InsertNextTuple3(std::sqrt(0.5), std::sqrt(0.5), 0);
  cloud->GetPointData()->SetNormals(normals);
  vtkNew<vtkTransform> transform;
  transform->Scale(2, 1, -1);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetTransform(transform);
  resampler->Update();
  vtkDataArray* out = resampler->GetOutput()->GetPointData()->GetNormals();
  ASSERT_NE(out, nullptr);
  // The tangent (1, -1, 0) became (2, -1, 0).
  EXPECT_NEAR(2 * out->GetComponent(0, 0) - out->GetComponent(0, 1), 0.0, 1e-12);
  EXPECT_GT(out->GetComponent(0, 0), 0.0);
}

TEST(VoxelMeanResampler, LabelsTakeTheMajorityAndTheSmallestOnATie)
{
  const auto cloud = trial::cloudAt(
    { { 0.1, 0.1, 0.1 }, { 0.1, 0.1, 0.1 }, { 0.1, 0.1, 0.1 }, { 0.9, 0.9, 0.9 }, { 0.9, 0.9, 0.9 } });
  trial::addArray(cloud, "Classification", { 9, 2, 9, 7, 5 });
  trial::addArray(cloud, "Label", { 1, 1, 4, 8, 3 });
  trial::addArray(cloud, "Plain", { 1, 1, 4, 8, 3 });
  vtkNew<vtkVoxelMeanResampler> resampler;
  useUnitCube(resampler, 2);
  resampler->AddCategoricalArray("Label");
  EXPECT_TRUE(resampler->IsCategoricalArray("Classification")) << "from the start";
  EXPECT_TRUE(resampler->IsCategoricalArray("Label"));
  EXPECT_FALSE(resampler->IsCategoricalArray("Plain"));
  resampler->SetInputData(cloud);
  resampler->Update();
  vtkPointData* out = resampler->GetOutput()->GetPointData();
  ASSERT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 2);
  EXPECT_EQ(out->GetArray("Classification")->GetTuple1(0), 9);
  EXPECT_EQ(out->GetArray("Classification")->GetTuple1(1), 5);
  EXPECT_EQ(out->GetArray("Label")->GetTuple1(0), 1);
  EXPECT_EQ(out->GetArray("Label")->GetTuple1(1), 3);
  EXPECT_EQ(out->GetArray("Plain")->GetTuple1(0), 2);
  resampler->ClearCategoricalArrays();
  resampler->Update();
  EXPECT_NEAR(
    resampler->GetOutput()->GetPointData()->GetArray("Classification")->GetTuple1(0), 20.0 / 3, 1e-12);
}

TEST(VoxelMeanResampler, DropsStringArraysWithAWarning)
{
  const auto cloud = trial::cloudAt({ { 0, 0, 0 }, { 1, 1, 1 } });
  vtkNew<vtkStringArray> words;
  words->SetName("Words");
  words->InsertNextValue("a");
  words->InsertNextValue("b");
  cloud->GetPointData()->AddArray(words);
  trial::addArray(cloud, "Kept", { 1, 2 });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::Ear warnings(resampler, vtkCommand::WarningEvent);
  resampler->Update();
  EXPECT_EQ(warnings.count, 1);
  EXPECT_NE(warnings.last.find("Words"), std::string::npos) << warnings.last;
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetAbstractArray("Words"), nullptr);
  EXPECT_NE(resampler->GetOutput()->GetPointData()->GetArray("Kept"), nullptr);
}

TEST(VoxelMeanResampler, KeepsActiveAttributesAndPassesFieldData)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(100, 5));
  std::vector<double> values(100, 1.0);
  trial::addArray(cloud, "Other", values);
  trial::addArray(cloud, "Heat", values);
  cloud->GetPointData()->SetActiveScalars("Heat");
  vtkNew<vtkIntArray> year;
  year->SetName("Year");
  year->InsertNextValue(2024);
  cloud->GetFieldData()->AddArray(year);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->Update();
  vtkPolyData* output = resampler->GetOutput();
  ASSERT_NE(output->GetPointData()->GetScalars(), nullptr);
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "Heat");
  ASSERT_NE(output->GetFieldData()->GetArray("Year"), nullptr);
  EXPECT_EQ(output->GetFieldData()->GetArray("Year")->GetTuple1(0), 2024);
  for (const char* name : { "LatticeOrigin", "LatticeSpacing", "LatticeDimensions", "ModelToWorkspace" })
  {
    EXPECT_NE(output->GetFieldData()->GetArray(name), nullptr) << name;
  }
  EXPECT_EQ(output->GetFieldData()->GetArray("ModelToWorkspace")->GetNumberOfValues(), 16);
}

TEST(VoxelMeanResampler, LeavesAttributesOutWhenAskedTo)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(100, 6));
  trial::addArray(cloud, "Heat", std::vector<double>(100, 1.0));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->PassAttributesOff();
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetArray("Heat"), nullptr);
  EXPECT_NE(countsOf(resampler->GetOutput()), nullptr);
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetArray("VoxelCovariance"), nullptr);
}

TEST(VoxelMeanResampler, ReplacesArraysOfItsOwnNames)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 7));
  vtkNew<vtkVoxelMeanResampler> first;
  first->SetInputData(cloud);
  useUnitCube(first, 5);
  vtkNew<vtkVoxelMeanResampler> second;
  second->SetInputConnection(first->GetOutputPort());
  useUnitCube(second, 5);
  second->Update();
  expectValid(second->GetOutput());
  EXPECT_EQ(second->GetOutput()->GetNumberOfPoints(), first->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(sum(countsOf(second->GetOutput())), 125) << "the count is that of this filter's input points";
}

TEST(VoxelMeanResampler, OrdersItsOutputByVoxelXFastest)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(4000, 8));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  useUnitCube(resampler, 6);
  resampler->Update();
  vtkPolyData* output = resampler->GetOutput();
  int last = -1;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double* p = output->GetPoint(i);
    const int key = int(p[0] * 6) + 6 * (int(p[1] * 6) + 6 * int(p[2] * 6));
    EXPECT_GT(key, last);
    last = key;
  }
}

TEST(VoxelMeanResampler, OutputPrecisionFollowsVtksConvention)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(trial::cloudOf(trial::randomPoints(50, 9, type)));
    const int precisions[3][2] = { { vtkAlgorithm::SINGLE_PRECISION, VTK_FLOAT },
      { vtkAlgorithm::DOUBLE_PRECISION, VTK_DOUBLE }, { vtkAlgorithm::DEFAULT_PRECISION, type } };
    for (const auto& precision : precisions)
    {
      resampler->SetOutputPointsPrecision(precision[0]);
      resampler->Update();
      EXPECT_EQ(resampler->GetOutput()->GetPoints()->GetDataType(), precision[1]);
    }
  }
}

TEST(VoxelMeanResampler, OfDimensionsAndVoxelSizeTheOneSetLastRules)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  EXPECT_EQ(resampler->GetDimensions()[0], 300);
  EXPECT_EQ(resampler->GetVoxelSize(), 0.0);
  EXPECT_TRUE(resampler->GetAutomaticWorkspace());
  EXPECT_FALSE(resampler->GetComputeCovariance());
  EXPECT_TRUE(resampler->GetPassAttributes());
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(20000, 10)));
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
  EXPECT_FALSE(resampler->GetAutomaticWorkspace()) << "bounds turn the automatic workspace off";
  resampler->SetVoxelSize(0.25);
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 64);
  resampler->SetDimensions(2, 2, 2);
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 8);
  EXPECT_EQ(resampler->GetVoxelSize(), 0.0);
  resampler->SetVoxelSize(0.5000001);
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 8);
  resampler->SetVoxelSize(0.3);
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 64) << "rounded up, never truncated";
}

TEST(VoxelMeanResampler, AutomaticWorkspaceClipsNothing)
{
  for (const double scale : { 1e-9, 1.0, 1e9 })
  {
    vtkNew<vtkTransform> transform;
    transform->RotateWXYZ(30, 1, 2, 3);
    transform->Scale(scale, scale, scale);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(trial::cloudOf(trial::randomPoints(2000, 11)));
    resampler->SetTransform(transform);
    resampler->Update();
    EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
    EXPECT_EQ(sum(countsOf(resampler->GetOutput())), 2000);
  }
}

TEST(VoxelMeanResampler, CountsClippedAndInvalidPoints)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto cloud = trial::cloudAt(
    { { 0.5, 0.5, 0.5 }, { 2, 0, 0 }, { nan, 0, 0 }, { 0, HUGE_VAL, 0 }, { 1, 0, 0 }, { 0, 0, 0 } });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  useUnitCube(resampler, 4);
  resampler->Update();
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 2);
  EXPECT_EQ(resampler->GetNumberOfInvalidPoints(), 2);
  EXPECT_EQ(sum(countsOf(resampler->GetOutput())), 2);
}

TEST(VoxelMeanResampler, RunsAgainWhenSomethingChangedAndOnlyThen)
{
  vtkNew<vtkTransform> transform;
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 12));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  useUnitCube(resampler, 4);
  resampler->SetTransform(transform);
  resampler->Update();
  trial::Ear runs(resampler, vtkCommand::StartEvent);
  const auto runsOnce = [&](const char* change)
  {
    runs.count = 0;
    resampler->Update();
    resampler->Update();
    EXPECT_EQ(runs.count, 1) << change;
  };
  const auto staysStill = [&](const char* change)
  {
    runs.count = 0;
    resampler->Update();
    EXPECT_EQ(runs.count, 0) << change;
  };
  staysStill("nothing");
  transform->Translate(0.1, 0, 0);
  runsOnce("transform edited");
  EXPECT_GT(resampler->GetNumberOfClippedPoints(), 0);
  resampler->SetTransform(nullptr);
  runsOnce("transform removed");
  EXPECT_EQ(resampler->GetNumberOfClippedPoints(), 0);
  transform->Translate(0.1, 0, 0);
  staysStill("a transform that is no longer used");
  resampler->SetDimensions(5, 5, 5);
  runsOnce("dimensions");
  resampler->SetDimensions(5, 5, 5);
  staysStill("the same dimensions");
  resampler->SetVoxelSize(0.2);
  runsOnce("voxel size");
  resampler->SetVoxelSize(0.2);
  staysStill("the same voxel size");
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 2);
  runsOnce("bounds");
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 2);
  staysStill("the same bounds");
  resampler->AddCategoricalArray("x");
  runsOnce("a categorical array");
  resampler->AddCategoricalArray("x");
  staysStill("the same categorical array");
  resampler->RemoveCategoricalArray("x");
  runsOnce("a categorical array removed");
  resampler->ComputeCovarianceOn();
  runsOnce("covariance");
  resampler->ComputeCovarianceOn();
  staysStill("the same covariance");
  cloud->GetPoints()->SetPoint(0, 0.5, 0.5, 0.5);
  cloud->GetPoints()->Modified();
  runsOnce("the input");
}

TEST(VoxelMeanResampler, LeavesItsInputAlone)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 13));
  trial::addArray(cloud, "Heat", std::vector<double>(1000, 1.0));
  vtkNew<vtkPolyData> before;
  before->DeepCopy(cloud);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->Update();
  expectSame(cloud, before);
  EXPECT_EQ(cloud->GetPointData()->GetNumberOfArrays(), 1);
}

TEST(VoxelMeanResampler, EmptyInputGivesAnEmptyOutput)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkPoints> noPoints;
  vtkNew<vtkPolyData> emptyPoints;
  emptyPoints->SetPoints(noPoints);
  for (vtkPolyData* input : { empty.Get(), emptyPoints.Get() })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(input);
    trial::Ear errors(resampler, vtkCommand::ErrorEvent);
    resampler->Update();
    EXPECT_EQ(errors.count, 0) << errors.last;
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(resampler->GetOutput()->GetNumberOfCells(), 0);
  }
}

TEST(VoxelMeanResampler, SmallCloudsComeThrough)
{
  for (const int n : { 1, 2, 11 })
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(trial::cloudOf(trial::randomPoints(n, 14)));
    resampler->Update();
    expectValid(resampler->GetOutput());
    EXPECT_EQ(sum(countsOf(resampler->GetOutput())), n);
  }
}

TEST(VoxelMeanResampler, ErrorsNameTheCureAndGiveAValidEmptyOutput)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(trial::cloudOf(trial::randomPoints(100, 15)));
  resampler->Update();
  ASSERT_GT(resampler->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkTransform> singular;
  singular->Scale(1, 1, 1);
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(2, 2, 0.0);
  singular->SetMatrix(matrix);
  resampler->SetTransform(singular);
  expectError(resampler);
  matrix->SetElement(2, 2, std::numeric_limits<double>::quiet_NaN());
  singular->SetMatrix(matrix);
  expectError(resampler);
  vtkNew<vtkThinPlateSplineTransform> bent;
  resampler->SetTransform(bent);
  expectError(resampler);
  resampler->SetTransform(nullptr);
  resampler->SetWorkspaceBounds(1, 0, 0, 1, 0, 1);
  expectError(resampler);
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, std::numeric_limits<double>::infinity());
  expectError(resampler);
  resampler->SetWorkspaceBounds(0, 1, 0, 1, 0, 1);
  resampler->SetVoxelSize(1e-9);
  expectError(resampler);
  resampler->SetVoxelSize(-1);
  expectError(resampler);
  resampler->SetDimensions(0, 10, 10);
  expectError(resampler);
  resampler->SetDimensions(10, 10, 10);
  resampler->Update();
  EXPECT_GT(resampler->GetOutput()->GetNumberOfPoints(), 0) << "it recovers";
}

TEST(VoxelMeanResampler, LeavesOutWhatAnEarlierResamplingSaidOfItsVoxels)
{
  vtkNew<vtkVoxelMeanResampler> first;
  first->SetInputData(trial::cloudOf(trial::randomPoints(500, 31, VTK_DOUBLE)));
  first->SetDimensions(8, 8, 8);
  first->ComputeCovarianceOn();
  vtkNew<vtkVoxelMeanResampler> second;
  second->SetInputConnection(first->GetOutputPort());
  second->SetDimensions(2, 2, 2);
  second->Update();
  EXPECT_EQ(second->GetOutput()->GetPointData()->GetArray("VoxelCovariance"), nullptr);
  EXPECT_EQ(sum(countsOf(second->GetOutput())), first->GetOutput()->GetNumberOfPoints());
}

TEST(VoxelMeanResampler, GivesTheSameBitsWithEveryBackEndAndThreadCount)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(100000, 16, VTK_FLOAT));
  std::mt19937_64 engine(17);
  std::vector<double> heat;
  for (int i = 0; i < 100000; ++i)
  {
    heat.push_back(trial::uniform(engine));
  }
  trial::addArray(cloud, "Heat", heat);
  vtkNew<vtkPolyData> expected;
  for (const char* backend : { "Sequential", "STDThread", "TBB" })
  {
    if (!vtkSMPTools::SetBackend(backend))
    {
      continue;
    }
    for (const int threads : { 1, 2, 8 })
    {
      vtkSMPTools::Initialize(threads);
      vtkNew<vtkVoxelMeanResampler> resampler;
      resampler->SetInputData(cloud);
      useUnitCube(resampler, 40);
      resampler->ComputeCovarianceOn();
      resampler->Update();
      if (expected->GetNumberOfPoints() == 0)
      {
        expected->DeepCopy(resampler->GetOutput());
      }
      SCOPED_TRACE(std::string(backend) + " " + std::to_string(threads));
      expectSame(resampler->GetOutput(), expected);
    }
  }
  vtkSMPTools::Initialize(0);
}
