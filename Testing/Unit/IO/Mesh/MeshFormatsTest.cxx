#include "CloudFiles.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPolyDataWriter.h"
#include "vtkSTLReader.h"
#include "vtkSTLWriter.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <random>

namespace
{

std::string bytesOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/// A sphere with arrays of several kinds; the faces must not disturb.
vtkSmartPointer<vtkPolyData> makeMesh()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(12);
  sphere->SetPhiResolution(9);
  sphere->Update();
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(sphere->GetOutput());
  const vtkIdType count = mesh->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> wide;
  wide->SetName("two words");
  wide->SetNumberOfComponents(2);
  wide->SetNumberOfTuples(count);
  vtkNew<vtkIntArray> label;
  label->SetName("label");
  label->SetNumberOfTuples(count);
  vtkNew<vtkUnsignedCharArray> color;
  color->SetName("RGB");
  color->SetNumberOfComponents(3);
  color->SetNumberOfTuples(count);
  std::mt19937 random(3);
  for (vtkIdType i = 0; i < count; ++i)
  {
    wide->SetTuple2(i, static_cast<double>(random()) / 3.0, -0.25);
    label->SetValue(i, static_cast<int>(random()) / 2);
    color->SetTuple3(i, random() & 255, random() & 255, random() & 255);
  }
  mesh->GetPointData()->AddArray(wide);
  mesh->GetPointData()->AddArray(label);
  mesh->GetPointData()->SetScalars(color);
  return mesh;
}

void expectSameCloud(vtkPointSet* expected, const ReadResult& result)
{
  ASSERT_EQ(result.error, "");
  expectSameBits(expected->GetPoints()->GetData(), result.cloud->GetPoints()->GetData());
  for (int i = 0; i < expected->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = expected->GetPointData()->GetArray(i);
    expectSameBits(array, result.array(array->GetName()));
  }
  EXPECT_NE(result.cloud->GetPointData()->GetNormals(), nullptr);
  ASSERT_NE(result.cloud->GetPointData()->GetScalars(), nullptr);
  EXPECT_STREQ(result.cloud->GetPointData()->GetScalars()->GetName(), "RGB");
  EXPECT_EQ(result.cloud->GetNumberOfCells(), expected->GetNumberOfPoints());
}

class MeshFormats : public CloudFiles
{
protected:
  /// Every cut of a file must give a message, or, where only cells are missing, the points.
  void expectCutsAreSafe(const std::string& whole, std::size_t step)
  {
    for (std::size_t size = 1; size < whole.size(); size += step)
    {
      const ReadResult result = readCloud(write("cut", whole.substr(0, size)));
      EXPECT_NE(result.error.empty(), result.points() == 0) << size;
    }
  }
};

TEST_F(MeshFormats, VtkLegacyOfBothKindsGivesWhatVtkWrote)
{
  const auto mesh = makeMesh();
  for (const int type : { VTK_ASCII, VTK_BINARY })
  {
    for (const int version : { 42, 51 })
    {
      vtkNew<vtkPolyDataWriter> writer;
      writer->SetInputData(mesh);
      writer->SetFileName(path("mesh.vtk").c_str());
      writer->SetFileType(type);
      writer->SetFileVersion(version);
      ASSERT_EQ(writer->Write(), 1);
      const ReadResult result = readCloud(path("mesh.vtk"));
      if (type == VTK_BINARY)
      {
        expectSameCloud(mesh, result);
      }
      else
      {
        ASSERT_EQ(result.error, "");
        expectSameBits(mesh->GetPointData()->GetArray("label"), result.array("label"));
        EXPECT_NEAR(result.cloud->GetPoint(5)[1], mesh->GetPoint(5)[1], 1e-6);
        EXPECT_EQ(result.value("RGB", 7, 2), mesh->GetPointData()->GetArray("RGB")->GetComponent(7, 2));
      }
    }
  }
  expectCutsAreSafe(bytesOf(path("mesh.vtk")), 61);
}

vtkSmartPointer<vtkUnstructuredGrid> makeGrid(vtkPolyData* mesh)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(mesh->GetPoints());
  grid->GetPointData()->ShallowCopy(mesh->GetPointData());
  const vtkIdType ids[] = { 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_TETRA, 4, ids);
  return grid;
}

TEST_F(MeshFormats, UnstructuredGridsGiveTheirPoints)
{
  const auto mesh = makeMesh();
  const auto grid = makeGrid(mesh);
  vtkNew<vtkXMLUnstructuredGridWriter> xml;
  xml->SetInputData(grid);
  xml->SetFileName(path("grid.vtu").c_str());
  ASSERT_EQ(xml->Write(), 1);
  const ReadResult result = readCloud(path("grid.vtu"));
  EXPECT_EQ(result.format, "VTU (VTK XML UnstructuredGrid)");
  expectSameCloud(mesh, result);
  vtkNew<vtkUnstructuredGridWriter> legacy;
  legacy->SetInputData(grid);
  legacy->SetFileName(path("grid.vtk").c_str());
  legacy->SetFileType(VTK_BINARY);
  ASSERT_EQ(legacy->Write(), 1);
  expectSameCloud(mesh, readCloud(path("grid.vtk")));
}

TEST_F(MeshFormats, VtkLegacyRefusesGridsAndLies)
{
  const std::string start = "# vtk DataFile Version 3.0\ntitle\nASCII\n";
  expectRefused(readCloud(write("a.vtk", start + "DATASET STRUCTURED_POINTS\n")), "STRUCTURED_POINTS");
  expectRefused(
    readCloud(write("a.vtk", start + "DATASET POLYDATA\nPOINTS 1000000000000 float\n1 2 3\n")), "announced");
  expectRefused(
    readCloud(write("a.vtk", start + "DATASET POLYDATA\nPOINTS 18446744073709551615 float\n1 2 3\n")),
    "announced");
  expectRefused(readCloud(write("a.vtk", start + "DATASET POLYDATA\nPOINTS -1 float\n")), "'-1'");
  expectRefused(
    readCloud(write("a.vtk", start + "DATASET POLYDATA\nPOINTS 1 float\n1 2 3\nPOINTS 1 float\n1 2 3\n")),
    "second section");
  expectRefused(readCloud(write("a.vtk", start + "DATASET POLYDATA\n")), "no section POINTS");
  expectRefused(readCloud(write("a.vtk",
                  start + "DATASET POLYDATA\nPOINTS 1 float\n1 2 3\nPOINT_DATA 1\nSCALARS a string\nb\n")),
    "'string'");
}

TEST_F(MeshFormats, StlOfBothKindsGivesEachVertexOnce)
{
  const auto mesh = makeMesh();
  for (const int type : { VTK_ASCII, VTK_BINARY })
  {
    vtkNew<vtkSTLWriter> writer;
    writer->SetInputData(mesh);
    writer->SetFileName(path("mesh.stl").c_str());
    writer->SetFileType(type);
    ASSERT_EQ(writer->Write(), 1);
    const ReadResult result = readCloud(path("mesh.stl"));
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(result.format, type == VTK_ASCII ? "STL (ascii)" : "STL (binary)");
    vtkNew<vtkSTLReader> peer;
    peer->SetFileName(path("mesh.stl").c_str());
    peer->Update();
    EXPECT_EQ(result.points(), peer->GetOutput()->GetNumberOfPoints());
    EXPECT_EQ(result.points(), mesh->GetNumberOfPoints());
    double mine[6], theirs[6];
    result.cloud->GetBounds(mine);
    peer->GetOutput()->GetBounds(theirs);
    for (int i = 0; i < 6; ++i)
    {
      EXPECT_EQ(mine[i], theirs[i]);
    }
  }
  // Told by its length where the name does not.
  const std::string whole = bytesOf(path("mesh.stl"));
  EXPECT_EQ(readCloud(write("mesh.dat", whole)).points(), mesh->GetNumberOfPoints());
  expectRefused(readCloud(write("cut.stl", whole.substr(0, whole.size() - 1))), "triangles announced");
  expectRefused(readCloud(write("short.stl", whole.substr(0, 50))), "inside its header");
  expectRefused(
    readCloud(write("a.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 1 2 x\n")), "line 4: a vertex");
  expectRefused(
    readCloud(write("a.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\n")), "endsolid");
  expectRefused(readCloud(write("a.stl", "solid s\nendsolid s\n")), "holds no points");
}

TEST_F(MeshFormats, OffGivesVerticesNormalsAndColors)
{
  const ReadResult plain =
    readCloud(write("a.off", "# made by hand\nOFF\n2 1 0\n0 0 0.5 # first\n\n1 2 3\n3 0 1 0\n"));
  ASSERT_EQ(plain.error, "");
  EXPECT_EQ(plain.format, "OFF");
  ASSERT_EQ(plain.points(), 2);
  EXPECT_EQ(plain.cloud->GetPoint(1)[2], 3.0);
  const ReadResult colored = readCloud(write("b.dat", "COFF 1 0 0\n1 2 3 10 20 30 255\n"));
  ASSERT_EQ(colored.error, "");
  EXPECT_EQ(colored.value("RGBA", 0, 1), 20);
  const ReadResult both = readCloud(write("c.off", "CNOFF\n1 0 0\n1 2 3 0 0 1.0 10 20 30\n"));
  ASSERT_EQ(both.error, "");
  EXPECT_EQ(both.value("Normals", 0, 2), 1.0);
  EXPECT_EQ(both.value("RGB", 0, 2), 30);
  expectRefused(readCloud(write("d.off", "OFF\n1000000000000 0 0\n1 2 3\n")), "after 1 of");
  expectRefused(readCloud(write("d.off", "OFF\n-1 0 0\n")), "'-1'");
  expectRefused(readCloud(write("d.off", "OFF\n1 0 0\n1 2\n")), "2 numbers");
  expectRefused(readCloud(write("d.off", "OFF\n2 0 0\n1 2 3\n1 b 3\n")), "line 4");
  expectRefused(readCloud(write("d.off", "OFF BINARY\nxxxx")), "binary");
  expectRefused(readCloud(write("d.off", "OFF")), "counts");
  EXPECT_EQ(readCloud(write("e.off", "// note\nOFF\n1 0 0\n1 2 3\n")).points(), 1);
}

TEST_F(MeshFormats, ABackslashEndsNamesAndContinuesNumbers)
{
  const ReadResult result =
    readCloud(write("a.obj", "# saved in C:\\models\\\nv 0 0 0\nusemtl C:\\\nv 1 0 \\\n0\nv 0 1 0\n"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.points(), 3);
}

TEST_F(MeshFormats, AWordThatBeginsAsOffIsText)
{
  for (const char* name : { "OFFSET,X,Y,Z\n7,1,2,3\n", "OFFSET X Y Z\n7 1 2 3\n" })
  {
    const ReadResult result = readCloud(write("a.csv", name));
    ASSERT_EQ(result.error, "") << name;
    EXPECT_EQ(result.cloud->GetPoint(0)[2], 3.0) << name;
  }
}

TEST_F(MeshFormats, TrianglesThatAreNotCountedAreSaidToBeLeftOut)
{
  std::string stl(80, ' ');
  append(stl, std::uint32_t{ 1 });
  for (int i = 0; i < 2; ++i)
  {
    for (int value = 0; value < 12; ++value)
    {
      append(stl, static_cast<float>(value % 5 + i));
    }
    append(stl, std::uint16_t{ 0 });
  }
  const ReadResult result = readCloud(write("a.stl", stl));
  ASSERT_EQ(result.error, "");
  ASSERT_FALSE(result.notes.empty());
  EXPECT_NE(result.notes[0].find("50 bytes follow what the header counts"), std::string::npos);
}

} // namespace
