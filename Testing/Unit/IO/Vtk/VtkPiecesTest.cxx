// A list of VTP files (PVTP) is one cloud: for a reader alone, and for ranks that read it together. Lists
// that are damaged or hostile are refused, with the piece.
#include "CloudFiles.h"
#include "Unit/Core/ThreadRanks.h"

#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLPolyDataWriter.h"

namespace
{

using pointhaptics::Ranks;
using pointhaptics::trial::ThreadJob;

vtkSmartPointer<vtkPolyData> rowsOfCloud(vtkIdType first, vtkIdType last)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  vtkNew<vtkLongLongArray> numbers;
  numbers->SetName("Number");
  for (vtkIdType i = first; i < last; ++i)
  {
    points->InsertNextPoint(1.0 / (1.0 + i), 0.5 * i, -i);
    colors->InsertNextTuple3(i % 256, 7, 255 - i % 256);
    numbers->InsertNextValue((1ll << 60) + i);
  }
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(colors);
  cloud->GetPointData()->AddArray(numbers);
  return cloud;
}

std::string listOf(const std::vector<std::string>& names, const std::string& level = "0")
{
  std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\" version=\"1.0\" "
                     "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PPolyData GhostLevel=\"" +
    level + "\">\n<PPoints><PDataArray type=\"Float64\" NumberOfComponents=\"3\"/></PPoints>\n";
  for (const std::string& name : names)
  {
    list += "<Piece Source=\"" + name + "\"/>\n";
  }
  return list + "</PPolyData>\n</VTKFile>\n";
}

class VtkPieces : public CloudFiles
{
protected:
  void SetUp() override
  {
    CloudFiles::SetUp();
    // Pieces of other sizes, one without points, one in a folder below.
    std::filesystem::create_directories(folder_ / "below");
    const vtkIdType ends[] = { 0, 40, 40, 75, 101 };
    for (int i = 0; i < 4; ++i)
    {
      writePiece(names_[static_cast<std::size_t>(i)], rowsOfCloud(ends[i], ends[i + 1]));
    }
  }
  void writePiece(const std::string& name, vtkPolyData* cloud) const
  {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(cloud);
    writer->SetFileName(path(name).c_str());
    ASSERT_EQ(writer->Write(), 1);
  }
  std::string list() const
  {
    return write("all.pvtp", listOf({ names_[0], names_[1], "below/c&amp;d.vtp", names_[3] }));
  }
  void expectRefused(const std::vector<std::string>& names, const std::string& text) const
  {
    const ReadResult result = readCloud(write("bad.pvtp", listOf(names)));
    EXPECT_NE(result.error.find(text), std::string::npos) << result.error;
    EXPECT_NE(result.error.find("; "), std::string::npos) << "no cure: " << result.error;
    EXPECT_EQ(result.points(), 0);
    EXPECT_EQ(result.errorEvents, 1);
  }
  std::vector<std::string> names_{ "a.vtp", "b.vtp", "below/c&d.vtp", "e.vtp" };
};

void expectRows(vtkPolyData* cloud, vtkIdType first, vtkIdType last)
{
  ASSERT_EQ(cloud->GetNumberOfPoints(), last - first);
  EXPECT_EQ(cloud->GetNumberOfVerts(), last - first);
  const vtkSmartPointer<vtkPolyData> expected = rowsOfCloud(first, last);
  ASSERT_EQ(cloud->GetPointData()->GetNumberOfArrays(), 2);
  ASSERT_NE(cloud->GetPointData()->GetScalars(), nullptr);
  EXPECT_STREQ(cloud->GetPointData()->GetScalars()->GetName(), "RGB");
  const auto isSame = [](vtkDataArray* a, vtkDataArray* b)
  {
    return a && a->GetDataType() == b->GetDataType() && a->GetNumberOfValues() == b->GetNumberOfValues() &&
      (b->GetNumberOfValues() == 0 ||
        std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
          static_cast<std::size_t>(b->GetNumberOfValues() * b->GetDataTypeSize())) == 0);
  };
  EXPECT_TRUE(isSame(cloud->GetPoints()->GetData(), expected->GetPoints()->GetData()));
  for (int i = 0; i < 2; ++i)
  {
    vtkDataArray* array = expected->GetPointData()->GetArray(i);
    EXPECT_TRUE(isSame(cloud->GetPointData()->GetArray(array->GetName()), array)) << array->GetName();
  }
}

TEST_F(VtkPieces, AreOneCloudInTheOrderOfTheList)
{
  const ReadResult result = readCloud(list());
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.format, "PVTP (VTK XML PolyData in pieces)");
  expectRows(result.cloud, 0, 101);
}

TEST_F(VtkPieces, MayBeText)
{
  // The numbers of points are found behind a start of any length.
  vtkNew<vtkXMLPolyDataWriter> ascii;
  ascii->SetDataModeToAscii();
  ascii->SetInputData(rowsOfCloud(0, 5000));
  ascii->SetFileName(path("ascii.vtp").c_str());
  ASSERT_EQ(ascii->Write(), 1);
  EXPECT_EQ(readCloud(write("ascii.pvtp", listOf({ "ascii.vtp", "e.vtp" }))).points(), 5026);
}

TEST_F(VtkPieces, AreCutEvenlyForRanks)
{
  const std::string file = list();
  for (const int size : { 1, 2, 3, 4, 8, 150 })
  {
    SCOPED_TRACE(size);
    ThreadJob(size).run(
      [&](Ranks& ranks)
      {
        vtkNew<vtkPointCloudReader> reader;
        reader->SetFileName(file.c_str());
        reader->SetRanks(&ranks);
        reader->Update();
        EXPECT_STREQ(reader->GetErrorMessage(), "");
        expectRows(reader->GetOutput(), 101 * ranks.rank() / size, 101 * (ranks.rank() + 1) / size);
      });
  }
}

TEST_F(VtkPieces, ARankReadsItsPiecesAlone)
{
  std::vector<std::string> names;
  std::uintmax_t bytes = 0;
  for (int i = 0; i < 4; ++i)
  {
    names.push_back("large" + std::to_string(i) + ".vtp");
    vtkNew<vtkPointCloudWriter> writer;
    writer->SetInputData(rowsOfCloud(20000 * i, 20000 * (i + 1)));
    writer->SetFileName(path(names.back()).c_str());
    ASSERT_EQ(writer->Write(), 1);
    bytes += std::filesystem::file_size(path(names.back()));
  }
  const std::string file = write("large.pvtp", listOf(names));
  ThreadJob(4).run(
    [&](Ranks& ranks)
    {
      vtkNew<vtkPointCloudReader> reader;
      reader->SetFileName(file.c_str());
      reader->SetRanks(&ranks);
      reader->Update();
      expectRows(reader->GetOutput(), 20000 * ranks.rank(), 20000 * (ranks.rank() + 1));
      // A piece, and the starts of all.
      EXPECT_LT(static_cast<double>(reader->GetNumberOfBytesRead()), 0.25 * static_cast<double>(bytes) + 3e5);
    });
}

TEST_F(VtkPieces, WhatIsMissingOrElsewhereIsNamed)
{
  expectRefused({ "a.vtp", "absent.vtp" }, "piece 2 of 2, 'absent.vtp': there is no such file");
  expectRefused({ "a.vtp", "below" }, "piece 2 of 2, 'below': ");
  expectRefused({ path("a.vtp") }, "does not lie beside or below the list");
  expectRefused({ "below/../../a.vtp" }, "does not lie beside or below the list");
  expectRefused({ "" }, "a piece called '', which does not lie beside or below the list");
  expectRefused({ "a.vtp", "./a.vtp" }, "the piece './a.vtp' is there twice");
  expectRefused({}, "the file holds no points");
  expectRefused({ "b.vtp" }, "the file holds no points");
}

TEST_F(VtkPieces, NoListLeadsToAList)
{
  expectRefused({ "bad.pvtp" }, "piece 1 of 1, 'bad.pvtp': a VTK file of the type 'PPolyData'");
  write("a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n");
  expectRefused({ "a.ply" }, "piece 1 of 1, 'a.ply': ");
}

TEST_F(VtkPieces, DamagedPiecesAreRefused)
{
  std::ifstream whole(path("a.vtp"), std::ios::binary);
  std::string bytes{ std::istreambuf_iterator<char>(whole), std::istreambuf_iterator<char>() };
  write("cut.vtp", bytes.substr(0, bytes.size() / 2));
  expectRefused({ "e.vtp", "cut.vtp" }, "piece 2 of 2, 'cut.vtp': ");
  const std::size_t at = bytes.find("NumberOfPoints=\"40\"");
  ASSERT_NE(at, std::string::npos);
  write("huge.vtp", bytes.replace(at, 19, "NumberOfPoints=\"4000000000000000000\""));
  expectRefused({ "e.vtp", "huge.vtp" }, "NumberOfPoints is '4000000000000000000' in a file of");
  const ReadResult ghosts = readCloud(write("ghosts.pvtp", listOf({ "a.vtp" }, "1")));
  EXPECT_NE(ghosts.error.find("GhostLevel is '1'"), std::string::npos) << ghosts.error;
  const ReadResult cut = readCloud(write("cut.pvtp", listOf({ "a.vtp" }).substr(0, 200)));
  EXPECT_NE(cut.error.find("without </VTKFile>"), std::string::npos) << cut.error;
}

TEST_F(VtkPieces, HaveTheSameArrays)
{
  const vtkSmartPointer<vtkPolyData> other = rowsOfCloud(0, 40);
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("Number");
  numbers->SetNumberOfTuples(40);
  numbers->FillValue(0);
  other->GetPointData()->AddArray(numbers);
  writePiece("other.vtp", other);
  expectRefused({ "a.vtp", "other.vtp" },
    "piece 2 of 2, 'other.vtp': other arrays than in the pieces before: points double, 'RGB' unsigned char "
    "3, 'Number' int 1 instead of "
    "points double, 'RGB' unsigned char 3, 'Number' long long 1");
  // Each rank reads one of them.
  const std::string file = write("other.pvtp", listOf({ "a.vtp", "other.vtp" }));
  ThreadJob(2).run(
    [&](Ranks& ranks)
    {
      vtkNew<vtkCallbackCommand> silence;
      vtkNew<vtkPointCloudReader> reader;
      reader->AddObserver(vtkCommand::ErrorEvent, silence);
      reader->SetFileName(file.c_str());
      reader->SetRanks(&ranks);
      reader->Update();
      EXPECT_NE(std::string(reader->GetErrorMessage()).find("other arrays"), std::string::npos);
      EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
    });
}

TEST_F(VtkPieces, AFaultOfOneRankEndsTheReadingOfAll)
{
  const std::string good = list();
  const std::string bad = write("bad.pvtp", listOf({ names_[0], names_[1], "below/x&amp;d.vtp", names_[3] }));
  ThreadJob(3).run(
    [&](Ranks& ranks)
    {
      vtkNew<vtkCallbackCommand> silence;
      vtkNew<vtkPointCloudReader> reader;
      reader->AddObserver(vtkCommand::ErrorEvent, silence);
      reader->SetFileName((ranks.rank() == 1 ? bad : good).c_str());
      reader->SetRanks(&ranks);
      reader->Update();
      EXPECT_EQ(reader->FailedElsewhere(), ranks.rank() != 1);
      EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
    });
}

} // namespace
