#include "CloudFiles.h"

#include "vtkErrorCode.h"

#include <random>

namespace
{

class Reader : public CloudFiles
{
};

TEST_F(Reader, RefusesWhatIsNotAFileWithPoints)
{
  const ReadResult missing = readCloud(path("missing.ply"));
  expectRefused(missing, "no such file");
  EXPECT_EQ(missing.code, static_cast<unsigned long>(vtkErrorCode::FileNotFoundError));
  EXPECT_EQ(missing.error.find(path("missing.ply")), 0u);
  expectRefused(readCloud(folder_.string()), "folder");
  expectRefused(readCloud(write("empty.ply", "")), "empty");
  expectRefused(readCloud("/dev/null"), "this is a device");
  expectRefused(readCloud(""), "file name");
}

TEST_F(Reader, RefusesUnknownContent)
{
  expectRefused(readCloud(write("a.ply", std::string("\x01\x02\x03\x00garbage", 11))), "unknown format");
  expectRefused(readCloud(write("notes.md", "Dear reader,\nthis is no cloud.\n")), "unknown format");
  expectRefused(readCloud(write("a.html", "<html></html>")), "the download failed");
}

TEST_F(Reader, NamesAConverterForKnownForeignFormats)
{
  expectRefused(readCloud(write("a.glb", "glTF and so on")), "a glTF file (GLB)");
  expectRefused(readCloud(write("a.ply.gz", "\x1f\x8b\x08 and so on")), "gunzip");
  expectRefused(readCloud(write("a.asc", "ncols 2\nnrows 1\n1 2\n")), "no cellsize");
  expectRefused(readCloud(write("a.zip", "PK\x03\x04 and so on")), "zipfile");
}

TEST_F(Reader, SurvivesRandomBytesAfterEveryMagic)
{
  const std::string starts[] = { "ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\n",
    "LASF", "ASTM-E57", "# .PCD v0.7\n", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", "v 1 2 3\n",
    "1 2 3\n" };
  std::mt19937 random(20260101);
  for (const std::string& start : starts)
  {
    for (int round = 0; round < 50; ++round)
    {
      std::string bytes = start;
      for (int i = 0; i < 600; ++i)
      {
        bytes += static_cast<char>(random() & 255);
      }
      const ReadResult result = readCloud(write("r.bin", bytes));
      EXPECT_EQ(result.error.empty(), result.points() > 0);
    }
  }
}

TEST_F(Reader, MakesAVertexPerPointOnlyWhereAsked)
{
  const std::string name = write("three.xyz", "0 0 0\n1 2 3\n4 5 6\n");
  vtkNew<vtkPointCloudReader> reader;
  reader->SetFileName(name.c_str());
  reader->SetBox(0.5, 9.0, 0.0, 9.0, 0.0, 9.0);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 2);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfVerts(), 2);
  reader->GenerateVerticesOff();
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 2);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0);
}

TEST_F(Reader, CanBeUsedAgainAfterAFault)
{
  vtkNew<vtkPointCloudReader> reader;
  vtkNew<vtkCallbackCommand> observer;
  int events = 0;
  observer->SetCallback(&countEvent);
  observer->SetClientData(&events);
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(path("missing.ply").c_str());
  for (int times = 1; times <= 3; ++times)
  {
    reader->Update();
    EXPECT_EQ(events, times) << "it is said on each update";
    EXPECT_STRNE(reader->GetErrorMessage(), "");
  }
  reader->RepeatsErrorsOff();
  for (int time = 0; time < 2; ++time)
  {
    reader->Update();
    EXPECT_EQ(events, 4) << "nothing was set";
    EXPECT_STRNE(reader->GetErrorMessage(), "");
  }
  reader->SetFileName(write("a.xyz", "1 2 3\n").c_str());
  reader->Update();
  EXPECT_STREQ(reader->GetErrorMessage(), "");
  EXPECT_EQ(reader->GetErrorCode(), 0u);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 1);
  EXPECT_EQ(events, 4);
}

void abortAtHalf(vtkObject* caller, unsigned long, void* calls, void*)
{
  vtkAlgorithm* algorithm = vtkAlgorithm::SafeDownCast(caller);
  ++*static_cast<int*>(calls);
  if (algorithm->GetProgress() > 0.5)
  {
    algorithm->SetAbortExecute(1);
  }
}

TEST_F(Reader, ReportsProgressAndStopsOnRequest)
{
  std::string text;
  for (int i = 0; i < 200000; ++i)
  {
    text += "1 2 3\n";
  }
  int calls = 0;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(&abortAtHalf);
  observer->SetClientData(&calls);
  vtkNew<vtkPointCloudReader> reader;
  reader->AddObserver(vtkCommand::ProgressEvent, observer);
  reader->SetFileName(write("a.xyz", text).c_str());
  reader->Update();
  EXPECT_GE(calls, 3);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_NE(std::string(reader->GetErrorMessage()).find("stopped"), std::string::npos);
}

/// Every format of the shared clouds, with the counts and bounds their manifest states.
struct Shared
{
  const char* file;
  vtkIdType points;
  vtkIdType invalid;
  double bounds[6];
  double tolerance;
};

/// How GoogleTest names a parameter.
void PrintTo(const Shared& shared, std::ostream* os)
{
  *os << shared.file;
}

class SharedClouds : public ::testing::TestWithParam<Shared>
{
};

TEST_P(SharedClouds, HaveTheCountsAndBoundsOfTheirManifest)
{
  const std::string folder = sharedData();
  if (folder.empty())
  {
    GTEST_SKIP() << "no real clouds beside this checkout (set POINTHAPTICS_SHARED_DATA to their folder)";
  }
  const Shared& expected = GetParam();
  const ReadResult result = readCloud(folder + "/" + expected.file);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.points(), expected.points);
  EXPECT_EQ(result.cloud->GetNumberOfVerts(), expected.points);
  vtkIdType invalid = 0;
  double bounds[6] = { 1e300, -1e300, 1e300, -1e300, 1e300, -1e300 };
  for (vtkIdType i = 0; i < result.points(); ++i)
  {
    double p[3];
    result.cloud->GetPoint(i, p);
    const bool valid = p[0] == p[0] && p[1] == p[1] && p[2] == p[2];
    invalid += valid ? 0 : 1;
    for (int axis = 0; axis < 3 && valid; ++axis)
    {
      bounds[2 * axis] = std::min(bounds[2 * axis], p[axis]);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], p[axis]);
    }
  }
  EXPECT_EQ(invalid, expected.invalid);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected.bounds[i], expected.tolerance) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Manifest, SharedClouds,
  ::testing::Values(Shared{ "bun_zipper.ply", 35947, 0,
                      { -0.0946899, 0.0610091, 0.0329874, 0.187321, -0.0618736, 0.0587997 }, 1e-6 },
    Shared{ "lucy_50k.ply", 49987, 0, { 225.906, 1156.03, -388.421, 145.348, -605.89, 991.332 }, 5e-3 },
    Shared{ "happy_543652.ply", 543652, 0,
      { -0.0466557, 0.0358044, 0.0490337, 0.248953, -0.0477991, 0.0345634 }, 1e-6 },
    Shared{
      "lion_takanawa.ply", 272768, 0, { -0.748213, 2.44972, -2.78041, 1.4885, 2.55082, 7.19477 }, 1e-5 },
    Shared{ "office1.pcd", 307200, 52744, { -2.64548, 1.50436, -2.19643, 1.58125, 1.833, 5.364 }, 1e-5 },
    Shared{ "Megaplot.las", 81590, 0, { 684766.39, 684993.29, 5017773.08, 5018007.25, 0, 29.97 }, 1e-8 },
    Shared{
      "outdoor_lidar.ply", 69088, 0, { -23.3375, 19.0247, -74.6816, 8.91951, -2.95734, 10.7959 }, 1e-4 },
    Shared{ "room_scan1.pcd", 112586, 0, { -13.7998, 15.4471, -6.49282, 7.97957, -1.3517, 1.70909 }, 1e-4 },
    Shared{ "pine.las", 73851, 0, { -1.2493, 1.2407, -1.24, 1.24, -0.224071, 19.9359 }, 5e-5 },
    Shared{
      "samp11-utm.pcd", 38010, 0, { 512700.88, 512834.75, 5403547.5, 5403850, 295.25, 404.08 }, 0.006 }),
  [](const ::testing::TestParamInfo<Shared>& test)
  {
    std::string name = test.param.file;
    for (char& c : name)
    {
      c = c == '.' || c == '-' ? '_' : c;
    }
    return name;
  });

} // namespace
