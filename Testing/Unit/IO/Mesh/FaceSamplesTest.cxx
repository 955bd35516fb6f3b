#include "CloudFiles.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPointLocator.h"
#include "vtkPolyDataWriter.h"
#include "vtkSMPTools.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace
{

/// A plate of x from 0 to 3, y from 0 to 1 with a square hole of (1, 0.4) to (1.2, 0.6) in faces of all
/// kinds: quads, a concave polygon and slivers. Vertices have a colour, a number (x + 10 y) and a label.
struct Plate
{
  std::vector<std::array<double, 2>> vertices;
  std::vector<std::vector<int>> faces;
  double area = 3.0 - 0.04;

  int add(double x, double y)
  {
    vertices.push_back({ x, y });
    return static_cast<int>(vertices.size()) - 1;
  }
  Plate()
  {
    // Left of x = 2 two concave halves about the hole.
    faces.push_back({ add(0, 0), add(2, 0), add(2, 0.5), add(1.2, 0.5), add(1.2, 0.4), add(1, 0.4),
      add(1, 0.5), add(0, 0.5) });
    faces.push_back({ add(0, 0.5), add(1, 0.5), add(1, 0.6), add(1.2, 0.6), add(1.2, 0.5), add(2, 0.5),
      add(2, 1), add(0, 1) });
    // From x = 2 to 3: 200 slivers in a fan.
    const int middle = add(2, 0);
    int last = add(3, 0);
    for (int i = 1; i <= 100; ++i)
    {
      const int next = add(3, 0.01 * i);
      faces.push_back({ middle, last, next });
      last = next;
    }
    for (int i = 99; i >= 0; --i)
    {
      const int next = add(2 + 0.01 * i, 1);
      faces.push_back({ middle, last, next });
      last = next;
    }
  }
  std::string ply() const
  {
    std::ostringstream text;
    text.precision(17);
    text << "ply\nformat ascii 1.0\nelement vertex " << vertices.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar "
            "green\nproperty uchar blue\nproperty double number\nproperty int label\nelement face "
         << faces.size() << "\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& v : vertices)
    {
      text << v[0] << " " << v[1] << " 0 " << std::round(80 * v[0]) << " " << std::round(200 * v[1]) << " 7 "
           << v[0] + 10 * v[1] << " " << (v[0] < 1.1 ? 5 : 1000) << "\n";
    }
    for (const auto& face : faces)
    {
      text << "3 " << face.size();
      for (const int v : face)
      {
        text << " " << v;
      }
      text << "\n";
    }
    return text.str();
  }
};

class FaceSamples : public CloudFiles
{
protected:
  ReadResult sample(const std::string& file, vtkIdType samples)
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SetSamples(samples);
    return readCloudBy(reader, file);
  }
};

TEST_F(FaceSamples, HitAreasInProportion)
{
  const ReadResult result = sample(write("plate.ply", Plate().ply()), 20000);
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.points(), 20000);
  EXPECT_EQ(result.notes, std::vector<std::string>{ "20,000 samples of 202 faces" });
  // Cells of 0.2 x 0.2, of which the hole is one.
  std::array<std::array<int, 5>, 15> counts{};
  for (vtkIdType i = 0; i < result.points(); ++i)
  {
    const double* p = result.cloud->GetPoint(i);
    ++counts[std::size_t(p[0] / 0.2)][std::size_t(p[1] / 0.2)];
    ASSERT_EQ(p[2], 0.0);
  }
  double chiSquare = 0.0;
  const double expected = 20000 * 0.04 / Plate().area;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    for (std::size_t j = 0; j < counts[i].size(); ++j)
    {
      const bool isHole = i == 5 && j == 2;
      chiSquare += isHole ? 0.0 : std::pow(counts[i][j] - expected, 2) / expected;
      EXPECT_TRUE(!isHole || counts[i][j] == 0) << counts[i][j];
    }
  }
  // 73 degrees of freedom: 73 on average for random points, and less for even ones.
  EXPECT_LT(chiSquare, 20.0);
}

TEST_F(FaceSamples, AreEven)
{
  const ReadResult result = sample(write("plate.ply", Plate().ply()), 20000);
  ASSERT_EQ(result.error, "");
  const double spacing = std::sqrt(Plate().area / 20000);
  vtkNew<vtkPointLocator> locator;
  locator->SetDataSet(result.cloud);
  locator->BuildLocator();
  double sum = 0.0;
  double squares = 0.0;
  vtkNew<vtkIdList> two;
  for (vtkIdType i = 0; i < result.points(); ++i)
  {
    double at[3];
    result.cloud->GetPoint(i, at);
    locator->FindClosestNPoints(2, at, two);
    double other[3];
    result.cloud->GetPoint(two->GetId(1), other);
    const double distance = std::sqrt(vtkMath::Distance2BetweenPoints(at, other)) / spacing;
    sum += distance;
    squares += distance * distance;
  }
  const double mean = sum / 20000;
  const double variation = std::sqrt(squares / 20000 - mean * mean) / mean;
  RecordProperty("mean", std::to_string(mean));
  RecordProperty("variation", std::to_string(variation));
  std::cout << "nearest: mean " << mean << " variation " << variation << "\n";
  EXPECT_GT(mean, 0.6);       // 0.5 for random points
  EXPECT_LT(variation, 0.35); // 0.52 for random points
  double farthest = 0.0;
  for (double x = 0.0; x <= 3.0; x += 0.004)
  {
    for (double y = 0.0; y <= 1.0; y += 0.004)
    {
      if (x > 0.99 && x < 1.21 && y > 0.39 && y < 0.61)
      {
        continue;
      }
      const double at[3] = { x, y, 0.0 };
      double other[3];
      result.cloud->GetPoint(locator->FindClosestPoint(at), other);
      farthest = std::max(farthest, std::sqrt(vtkMath::Distance2BetweenPoints(at, other)) / spacing);
    }
  }
  EXPECT_LT(farthest, 1.4); // 1.9 for random points
}

TEST_F(FaceSamples, InterpolateArrays)
{
  const ReadResult result = sample(write("plate.ply", Plate().ply()), 5000);
  ASSERT_EQ(result.error, "");
  int labels = 0;
  for (vtkIdType i = 0; i < result.points(); ++i)
  {
    const double* p = result.cloud->GetPoint(i);
    EXPECT_NEAR(result.value("number", i), p[0] + 10 * p[1], 1e-9);
    EXPECT_NEAR(result.value("RGB", i, 0), 80 * p[0], 1.01);
    EXPECT_NEAR(result.value("RGB", i, 1), 200 * p[1], 1.01);
    EXPECT_EQ(result.value("RGB", i, 2), 7.0);
    const double label = result.value("label", i);
    EXPECT_TRUE(label == 5.0 || label == 1000.0);
    labels += label == 5.0 ? 1 : 0;
    EXPECT_NEAR(std::abs(result.value("Normals", i, 2)), 1.0, 1e-6);
  }
  EXPECT_GT(labels, 1000);
  EXPECT_LT(labels, 3000);
  EXPECT_EQ(result.array("RGB")->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(result.cloud->GetPointData()->GetScalars(), result.array("RGB"));
  EXPECT_EQ(result.cloud->GetPointData()->GetNormals(), result.array("Normals"));
  EXPECT_EQ(result.cloud->GetNumberOfCells(), result.points());
}

TEST_F(FaceSamples, AreTheSameWithAnyNumberOfThreads)
{
  const std::string file = write("plate.ply", Plate().ply());
  const ReadResult first = sample(file, vtkPointCloudReader::AUTOMATIC);
  vtkSMPTools::Initialize(1);
  const ReadResult again = sample(file, vtkPointCloudReader::AUTOMATIC);
  vtkSMPTools::Initialize(0);
  ASSERT_EQ(first.points(), 200000);
  EXPECT_EQ(first.notes[0], "200,000 samples of 202 faces");
  expectSameBits(first.cloud->GetPoints()->GetData(), again.cloud->GetPoints()->GetData());
  for (const char* name : { "RGB", "number", "label", "Normals" })
  {
    expectSameBits(first.array(name), again.array(name));
  }
}

/// On each side of the cube lies a sixth of the points, with its outward normal.
void expectEvenCube(const ReadResult& result, const char* name)
{
  std::array<int, 6> counts{};
  for (vtkIdType i = 0; i < result.points(); ++i)
  {
    const double* p = result.cloud->GetPoint(i);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const double side : { 0.0, 1.0 })
      {
        const bool isOn = p[axis] == side;
        counts[std::size_t(2 * axis + int(side))] += isOn ? 1 : 0;
        EXPECT_TRUE(!isOn || result.value("Normals", i, axis) == 2 * side - 1) << name;
      }
    }
  }
  for (const int count : counts)
  {
    EXPECT_NEAR(count, double(result.points()) / 6, 30) << name;
  }
}

/// A cube of side 1 as quads, whose corners are given with and without a normal.
TEST_F(FaceSamples, OfAllFormatsAreThoseOfTheirFaces)
{
  const std::string corners[8] = { "0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1" };
  const int faces[6][4] = { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 },
    { 3, 0, 4, 7 } };
  std::string obj, off = "OFF\n8 6 0\n", stl = "solid cube\n", vtk, plyFaces;
  vtk = "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET POLYDATA\nPOINTS 8 float\n";
  std::string ply = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty "
                    "float z\nelement face 6\nproperty list uchar int vertex_index\nend_header\n";
  for (const std::string& corner : corners)
  {
    obj += "v " + corner + "\n";
    off += corner + "\n";
    vtk += corner + "\n";
    ply += corner + "\n";
  }
  vtk += "POLYGONS 6 30\n";
  for (const auto& face : faces)
  {
    std::string line = "4", relative = "f", loop = "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face)
    {
      line += " " + std::to_string(corner);
      relative += " " + std::to_string(corner - 8) + "/3/4";
      loop += "vertex " + corners[corner] + "\n";
    }
    obj += relative + "\n";
    off += line + " 0.5 0.5 0.5\n";
    vtk += line + "\n";
    ply += line + "\n";
    stl += loop + "endloop\nendfacet\n";
  }
  stl += "endsolid cube\n";
  const std::pair<const char*, std::string> files[] = { { "cube.obj", obj }, { "cube.off", off },
    { "cube.stl", stl }, { "cube.vtk", vtk }, { "cube.ply", ply } };
  for (const auto& [name, content] : files)
  {
    const std::string file = write(name, content);
    const ReadResult bare = readCloud(file);
    EXPECT_EQ(bare.points(), 8) << name;
    ASSERT_EQ(bare.notes.size(), 1u) << name;
    EXPECT_EQ(bare.notes[0], "the points are the vertices of 6 faces") << name;
    const ReadResult result = sample(file, 6000);
    ASSERT_EQ(result.error, "") << name;
    ASSERT_EQ(result.points(), 6000) << name;
    EXPECT_EQ(result.notes[0], "6,000 samples of 6 faces") << name;
    expectEvenCube(result, name);
  }
}

TEST_F(FaceSamples, OfVtkFilesOfBothVersionsAreThoseOfTheTextFile)
{
  const ReadResult expected = sample(write("plate.ply", Plate().ply()), 3000);
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(readCloud(path("plate.ply")).cloud);
  vtkNew<vtkCellArray> polygons;
  for (const auto& face : Plate().faces)
  {
    polygons->InsertNextCell(int(face.size()));
    for (const int corner : face)
    {
      polygons->InsertCellPoint(corner);
    }
  }
  mesh->SetVerts(nullptr);
  mesh->SetPolys(polygons);
  for (const int version : { 42, 51 })
  {
    vtkNew<vtkPolyDataWriter> writer;
    writer->SetInputData(mesh);
    writer->SetFileName(path("plate.vtk").c_str());
    writer->SetFileTypeToBinary();
    writer->SetFileVersion(version);
    ASSERT_EQ(writer->Write(), 1);
    const ReadResult result = sample(path("plate.vtk"), 3000);
    EXPECT_EQ(result.notes[0], "3,000 samples of 202 faces");
    expectSameBits(expected.cloud->GetPoints()->GetData(), result.cloud->GetPoints()->GetData());
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(path("plate.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);
  const ReadResult result = sample(path("plate.vtp"), 3000);
  EXPECT_EQ(result.notes[0], "3,000 samples of 202 faces");
  expectSameBits(expected.cloud->GetPoints()->GetData(), result.cloud->GetPoints()->GetData());
}

TEST_F(FaceSamples, OfBrokenFacesAreTheVertices)
{
  const std::string head = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
  const std::pair<const char*, const char*> cases[] = {
    { "3 0 1 7\n3 0 1 9\n", "the points are the vertices of 2 faces that name missing ones" },
    { "3 0 1 1\n3 0 0 0\n", "the points are the vertices of 2 faces, which have no area" },
    { "x y z\n", "the points are the vertices of 2 faces, which cannot be read" },
  };
  for (const auto& [faces, note] : cases)
  {
    const ReadResult result = sample(write("broken.off", head + faces), vtkPointCloudReader::AUTOMATIC);
    EXPECT_EQ(result.error, "");
    EXPECT_EQ(result.points(), 3);
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_EQ(result.notes[0], note);
  }
  const std::string cloud = write("cloud.xyz", "1 2 3\n4 5 6\n");
  EXPECT_EQ(sample(cloud, 7).notes.at(0), "there are no faces to sample: the points stay");
  EXPECT_TRUE(sample(cloud, vtkPointCloudReader::AUTOMATIC).notes.empty());
}

/// Vertices that outnumber what samples there would be are kept.
TEST_F(FaceSamples, AreNotFewerThanTheVertices)
{
  std::string off = "OFF\n200001 1 0\n";
  for (int i = 0; i < 200001; ++i)
  {
    off += std::to_string(i % 500) + " " + std::to_string(i / 500) + " 0\n";
  }
  const std::string file = write("many.off", off + "3 0 499 200000\n");
  EXPECT_EQ(sample(file, vtkPointCloudReader::AUTOMATIC).points(), 200001);
  EXPECT_EQ(sample(file, 7).points(), 7);
}

TEST_F(FaceSamples, AreOfTheFacesThatAreRight)
{
  const std::string off = "OFF\n4 5 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const ReadResult result =
    sample(write("one.off", off + "3 0 1 2\n3 0 1 9\n3 1 3 2\n3 0 x 2\n2 0 1\n"), 100);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_EQ(
    result.notes[0], "100 samples of 5 faces, but for 3 with missing vertices or fewer than three corners");
  EXPECT_EQ(result.points(), 100);
  const ReadResult obj =
    sample(write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 a 2\n"), 50);
  EXPECT_EQ(obj.points(), 50);
  EXPECT_NE(obj.notes[0].find("but for 2 with"), std::string::npos) << obj.notes[0];
}

TEST_F(FaceSamples, OfStripsAndCellsAreMissed)
{
  const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string vtk = "# vtk DataFile Version 3.0\na\nASCII\nDATASET ";
  const std::string points = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n";
  const std::string vtu =
    "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"><UnstructuredGrid><Piece "
    "NumberOfPoints=\"4\" NumberOfCells=\"2\"><Points><DataArray type=\"Float32\" "
    "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>"
    "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 0"
    "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 5"
    "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10 1"
    "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
  const std::pair<const char*, std::string> files[] = { { "a.ply", ply },
    { "a.vtk", vtk + "POLYDATA\n" + points + "TRIANGLE_STRIPS 1 5\n4 0 1 2 3\n" },
    { "b.vtk", vtk + "UNSTRUCTURED_GRID\n" + points + "CELLS 2 7\n4 0 1 2 3\n1 0\nCELL_TYPES 2\n10\n1\n" },
    { "a.vtu", vtu } };
  for (const auto& [name, content] : files)
  {
    const ReadResult result = sample(write(name, content), vtkPointCloudReader::AUTOMATIC);
    EXPECT_EQ(result.error, "") << name;
    ASSERT_EQ(result.notes.size(), 1u) << name;
    EXPECT_NE(result.notes[0].find("strips and cells are not read as faces, of which there are 1;"),
      std::string::npos)
      << name;
  }
}

/// Sampling tells how far it is and ends where an observer says so.
TEST_F(FaceSamples, StopOnRequest)
{
  const std::string file = write("plate.ply", Plate().ply());
  vtkNew<vtkPointCloudReader> reader;
  reader->SetSamples(1000000);
  std::vector<double> reports;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&reports);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void* fraction)
    {
      auto& kept = *static_cast<std::vector<double>*>(self);
      kept.push_back(*static_cast<double*>(fraction));
      kept.back() > 0.93 ? vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1) : void();
    });
  reader->AddObserver(vtkCommand::ProgressEvent, command);
  const ReadResult result = readCloudBy(reader, file);
  EXPECT_NE(result.error.find("stopped on request"), std::string::npos) << result.error;
  EXPECT_GT(
    std::count_if(reports.begin(), reports.end(), [](double at) { return at > 0.6 && at < 0.99; }), 20);
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
}

} // namespace
