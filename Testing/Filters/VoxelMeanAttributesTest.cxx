#include "VoxelMeanFixtures.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkLookupTable.h"
#include "vtkSignedCharArray.h"
#include "vtkStringArray.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

vtkSmartPointer<vtkStringArray> twoWords(const char* name)
{
  auto words = vtkSmartPointer<vtkStringArray>::New();
  words->SetName(name);
  words->InsertNextValue("a");
  words->InsertNextValue("b");
  return words;
}

}

TEST(VoxelMeanAttributes, TurnsAndRenormalisesTheActiveNormals)
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

TEST(VoxelMeanAttributes, NormalsStayPerpendicularUnderUnequalScaling)
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

TEST(VoxelMeanAttributes, LabelsTakeTheMajorityAndTheSmallestOnATie)
{
  const auto cloud = trial::cloudAt(
    { { 0.1, 0.1, 0.1 }, { 0.1, 0.1, 0.1 }, { 0.1, 0.1, 0.1 }, { 0.9, 0.9, 0.9 }, { 0.9, 0.9, 0.9 } });
  trial::addArray(cloud, "Classification", { 9, 2, 9, 7, 5 });
  trial::addArray(cloud, "Kind", { 1, 1, 4, 8, 3 });
  trial::addArray(cloud, "Plain", { 1, 1, 4, 8, 3 });
  vtkNew<vtkVoxelMeanResampler> resampler;
  trial::useUnitCube(resampler, 2);
  resampler->AddCategoricalArray("Kind");
  EXPECT_TRUE(resampler->IsCategoricalArray("Classification")) << "from the start";
  EXPECT_TRUE(resampler->IsCategoricalArray("Kind"));
  EXPECT_FALSE(resampler->IsCategoricalArray("Plain"));
  resampler->SetInputData(cloud);
  resampler->Update();
  vtkPointData* out = resampler->GetOutput()->GetPointData();
  ASSERT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 2);
  EXPECT_EQ(out->GetArray("Classification")->GetTuple1(0), 9);
  EXPECT_EQ(out->GetArray("Classification")->GetTuple1(1), 5);
  EXPECT_EQ(out->GetArray("Kind")->GetTuple1(0), 1);
  EXPECT_EQ(out->GetArray("Kind")->GetTuple1(1), 3);
  EXPECT_EQ(out->GetArray("Plain")->GetTuple1(0), 2);
  resampler->ClearCategoricalArrays();
  resampler->Update();
  EXPECT_NEAR(
    resampler->GetOutput()->GetPointData()->GetArray("Classification")->GetTuple1(0), 20.0 / 3, 1e-12);
}

TEST(VoxelMeanAttributes, FieldsThatAreCalledLabelsAreLabels)
{
  const auto cloud = trial::cloudAt({ { 0.1, 0.1, 0.1 }, { 0.1, 0.1, 0.1 }, { 0.1, 0.1, 0.1 } });
  const char* const labels[] = { "label", "Class", "SEGMENT", "instance", "scalar_Label", "semantic_class",
    "labels", "classes", "instanceId", "segment_ids", "classification" };
  const char* const others[] = { "label_quality", "ClassificationFlags", "Intensity", "glass", "id" };
  for (const char* name : labels)
  {
    trial::addArray(cloud, name, { 9, 2, 9 });
  }
  for (const char* name : others)
  {
    trial::addArray(cloud, name, { 9, 0, 9 });
  }
  vtkNew<vtkVoxelMeanResampler> resampler;
  trial::useUnitCube(resampler, 2);
  resampler->SetInputData(cloud);
  resampler->Update();
  vtkPointData* out = resampler->GetOutput()->GetPointData();
  for (const char* name : labels)
  {
    EXPECT_TRUE(resampler->IsCategoricalArray(name)) << name;
    EXPECT_EQ(out->GetArray(name)->GetTuple1(0), 9) << name;
  }
  for (const char* name : others)
  {
    EXPECT_FALSE(resampler->IsCategoricalArray(name)) << name;
    EXPECT_EQ(out->GetArray(name)->GetTuple1(0), 6) << name;
  }
}

TEST(VoxelMeanAttributes, ExactNamesMeanThemselvesAlone)
{
  const auto cloud = trial::cloudAt({ { 0.1, 0.1, 0.1 }, { 0.1, 0.1, 0.1 }, { 0.1, 0.1, 0.1 } });
  for (const char* name : { "Label", "label", "scalar_Label" })
  {
    trial::addArray(cloud, name, { 9, 0, 9 });
  }
  vtkNew<vtkVoxelMeanResampler> resampler;
  trial::useUnitCube(resampler, 2);
  resampler->SetInputData(cloud);
  resampler->ExactCategoricalNamesOn();
  resampler->Update();
  vtkPointData* out = resampler->GetOutput()->GetPointData();
  EXPECT_EQ(out->GetArray("Label")->GetTuple1(0), 9);
  EXPECT_EQ(out->GetArray("label")->GetTuple1(0), 6);
  EXPECT_EQ(out->GetArray("scalar_Label")->GetTuple1(0), 6);
  resampler->ExactCategoricalNamesOff();
  resampler->Update();
  EXPECT_EQ(out->GetArray("scalar_Label")->GetTuple1(0), 9);
}

TEST(VoxelMeanAttributes, DropsStringArraysWithAWarning)
{
  const auto cloud = trial::cloudAt({ { 0, 0, 0 }, { 1, 1, 1 } });
  const auto words = twoWords("Words");
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

TEST(VoxelMeanAttributes, KeepsActiveAttributesAndPassesFieldData)
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

TEST(VoxelMeanAttributes, KeepsLookupTablesUnitsAndComponentNames)
{
  for (const bool categorical : { false, true })
  {
    const auto cloud = trial::cloudOf(trial::randomPoints(100, 6));
    trial::addArray(cloud, "Heat", std::vector<double>(100, 1.0));
    vtkDataArray* heat = cloud->GetPointData()->GetArray("Heat");
    vtkNew<vtkLookupTable> colours;
    heat->SetLookupTable(colours);
    heat->SetComponentName(0, "of the surface");
    heat->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "K");
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    if (categorical)
    {
      resampler->AddCategoricalArray("Heat");
    }
    resampler->Update();
    vtkDataArray* mean = resampler->GetOutput()->GetPointData()->GetArray("Heat");
    ASSERT_NE(mean, nullptr);
    EXPECT_EQ(mean->GetLookupTable(), colours);
    EXPECT_STREQ(mean->GetComponentName(0), "of the surface");
    EXPECT_STREQ(mean->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "K");
  }
}

TEST(VoxelMeanAttributes, LeavesAttributesOutWhenAskedTo)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(100, 6));
  trial::addArray(cloud, "Heat", std::vector<double>(100, 1.0));
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->PassAttributesOff();
  resampler->Update();
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetArray("Heat"), nullptr);
  EXPECT_NE(trial::countsOf(resampler->GetOutput()), nullptr);
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetArray("VoxelCovariance"), nullptr);
}

TEST(VoxelMeanAttributes, ReplacesArraysOfItsOwnNames)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(1000, 7));
  vtkNew<vtkVoxelMeanResampler> first;
  first->SetInputData(cloud);
  trial::useUnitCube(first, 5);
  vtkNew<vtkVoxelMeanResampler> second;
  second->SetInputConnection(first->GetOutputPort());
  trial::useUnitCube(second, 5);
  second->Update();
  trial::expectValid(second->GetOutput());
  EXPECT_EQ(second->GetOutput()->GetNumberOfPoints(), first->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(trial::sum(trial::countsOf(second->GetOutput())), 125)
    << "the count is that of this filter's input points";
}

TEST(VoxelMeanAttributes, LeavesOutWhatAnEarlierResamplingSaidOfItsVoxels)
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
  EXPECT_EQ(trial::sum(trial::countsOf(second->GetOutput())), first->GetOutput()->GetNumberOfPoints());
}

TEST(VoxelMeanAttributes, ArraysWithoutNamesAreAveragedToo)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(100, 32));
  vtkNew<vtkFloatArray> nameless;
  nameless->SetNumberOfTuples(100);
  nameless->Fill(3);
  cloud->GetPointData()->AddArray(nameless);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 2);
  resampler->Update();
  trial::expectValid(resampler->GetOutput());
  vtkPointData* out = resampler->GetOutput()->GetPointData();
  ASSERT_EQ(out->GetNumberOfArrays(), 2);
  for (int a = 0; a < 2; ++a)
  {
    EXPECT_TRUE(out->GetArray(a)->GetName() || out->GetArray(a)->GetTuple1(0) == 3.0);
  }
}

TEST(VoxelMeanAttributes, AnArrayKeepsAllTheRolesItHad)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(100, 33));
  vtkPointData* in = cloud->GetPointData();
  const auto normals =
    trial::addColumns<vtkFloatArray>(cloud, "N", 3, [](vtkIdType, int c) { return c == 2 ? 2.0 : 0.0; });
  in->SetNormals(normals);
  in->SetActiveScalars("N");
  in->SetActiveVectors("N");
  const auto ids = trial::addColumns<vtkIdTypeArray>(cloud, "Ids", 1, [](vtkIdType i, int) { return i; });
  in->SetGlobalIds(ids);
  in->SetPedigreeIds(ids);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->Update();
  vtkPointData* out = resampler->GetOutput()->GetPointData();
  ASSERT_NE(out->GetNormals(), nullptr);
  EXPECT_EQ(out->GetScalars(), out->GetNormals());
  EXPECT_EQ(out->GetVectors(), out->GetNormals());
  EXPECT_EQ(out->GetNormals()->GetComponent(0, 2), 1.0) << "of unit length, as normals are";
  EXPECT_EQ(out->GetArray("Ids"), nullptr);
}

TEST(VoxelMeanAttributes, PedigreesInWordsAreLeftOutWithAWarning)
{
  const auto cloud = trial::cloudAt({ { 0, 0, 0 }, { 1, 1, 1 } });
  const auto words = twoWords("Words");
  cloud->GetPointData()->SetPedigreeIds(words);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::Ear warnings(resampler, vtkCommand::WarningEvent);
  resampler->Update();
  EXPECT_EQ(warnings.count, 1);
  EXPECT_NE(warnings.last.find("\"Words\" holds ids"), std::string::npos) << warnings.last;
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetAbstractArray("Words"), nullptr);
}

TEST(VoxelMeanAttributes, WarningsOfNamelessArraysAreWholeSentences)
{
  const auto cloud = trial::cloudAt({ { 0, 0, 0 }, { 1, 1, 1 } });
  const auto words = twoWords(nullptr);
  cloud->GetPointData()->AddArray(words);
  vtkNew<vtkFloatArray> shorter;
  shorter->InsertNextValue(1);
  cloud->GetPointData()->AddArray(shorter);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::Ear warnings(resampler, vtkCommand::WarningEvent);
  resampler->Update();
  EXPECT_EQ(warnings.count, 2);
  EXPECT_NE(warnings.last.find("has 1 tuples for 2 points: it is dropped"), std::string::npos)
    << warnings.last;
}

TEST(VoxelMeanAttributes, NormalsInIntegersTurnAndKeepTheirLength)
{
  const auto cloud = trial::cloudAt({ { 0, 0, 0 }, { 0, 0, 0 } });
  vtkNew<vtkSignedCharArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->InsertNextTuple3(73, 72, -73);
  normals->InsertNextTuple3(73, 74, -73);
  cloud->GetPointData()->SetNormals(normals);
  vtkNew<vtkTransform> transform;
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetTransform(transform);
  const auto expectNormal = [&](double x, double y, double z)
  {
    resampler->Update();
    vtkDataArray* out = resampler->GetOutput()->GetPointData()->GetNormals();
    ASSERT_NE(out, nullptr);
    EXPECT_EQ(out->GetComponent(0, 0), x);
    EXPECT_EQ(out->GetComponent(0, 1), y);
    EXPECT_EQ(out->GetComponent(0, 2), z);
  };
  expectNormal(73, 73, -73);
  transform->RotateZ(90);
  transform->Scale(5, 5, 5);
  expectNormal(-73, 73, -73);
  // 1.41 times as long on one axis: cut off at the type's end, not wrapped round it.
  normals->FillComponent(0, 127);
  normals->FillComponent(1, 127);
  normals->FillComponent(2, 0);
  normals->Modified();
  transform->RotateZ(-45);
  expectNormal(0, 127, 0);
}

TEST(VoxelMeanAttributes, NormalsThatAreNotNumbersAreLeftOut)
{
  const auto cloud = trial::cloudAt({ { 0.2, 0.5, 0.5 }, { 0.2, 0.5, 0.5 }, { 0.7, 0.5, 0.5 } });
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->InsertNextTuple3(NAN, NAN, NAN);
  normals->InsertNextTuple3(0, 0, 1);
  normals->InsertNextTuple3(0, 3, 4);
  cloud->GetPointData()->SetNormals(normals);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  trial::useUnitCube(resampler, 2);
  resampler->Update();
  vtkDataArray* out = resampler->GetOutput()->GetPointData()->GetNormals();
  ASSERT_EQ(out->GetNumberOfTuples(), 2);
  EXPECT_EQ(out->GetComponent(0, 2), 1.0);
  EXPECT_NEAR(out->GetComponent(1, 1), 0.6, 1e-7);
  EXPECT_NEAR(out->GetComponent(1, 2), 0.8, 1e-7);
}

TEST(VoxelMeanAttributes, NormalsKeepTheirDirectionUnderTinyScales)
{
  const auto cloud = trial::cloudAt({ { 0, 0, 0 } });
  trial::addColumns<vtkDoubleArray>(cloud, "Normals", 3, [](vtkIdType, int c) { return c == 2 ? 1.0 : 0.0; });
  cloud->GetPointData()->SetActiveNormals("Normals");
  vtkNew<vtkTransform> transform;
  transform->Scale(1e-100, 1e-100, 1e-100);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetTransform(transform);
  resampler->Update();
  ASSERT_EQ(resampler->GetOutput()->GetNumberOfPoints(), 1);
  EXPECT_EQ(resampler->GetOutput()->GetPointData()->GetNormals()->GetComponent(0, 2), 1.0);
}
