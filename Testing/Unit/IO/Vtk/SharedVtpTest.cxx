// One VTP file that ranks write in parts is, byte for byte, the one that vtkPointCloudWriter writes of all
// points.
#include "CloudFiles.h"
#include "Unit/Core/ThreadRanks.h"

#include "IO/Vtk/SharedVtp.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkPointCloudWriter.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <csignal>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace
{

using pointhaptics::Ranks;
using pointhaptics::trial::ThreadJob;

/// The points from @p first to before @p last of one cloud, with an array of each kind.
vtkSmartPointer<vtkPolyData> rowsOfEveryKind(vtkIdType first, vtkIdType last)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("Ids & <marks>");
  vtkNew<vtkDoubleArray> values;
  values->SetName("Values");
  values->SetNumberOfComponents(2);
  values->SetComponentName(0, "Left");
  for (vtkIdType i = first; i < last; ++i)
  {
    points->InsertNextPoint(1.0 / (1.0 + i), 1e-7 * i, -i);
    colors->InsertNextTuple3(i % 256, 7, 255 - i % 256);
    normals->InsertNextTuple3(std::sin(i), std::cos(i), 0.1);
    ids->InsertNextValue((vtkIdType(1) << 60) - i);
    values->InsertNextTuple2(i == 3 ? std::numeric_limits<double>::quiet_NaN() : i, -1e300 / (1 + i));
  }
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(colors);
  cloud->GetPointData()->SetNormals(normals);
  cloud->GetPointData()->AddArray(ids);
  cloud->GetPointData()->AddArray(values);
  vtkNew<vtkStringArray> unit;
  unit->SetName("LengthUnit");
  unit->InsertNextValue("metre");
  cloud->GetFieldData()->AddArray(unit);
  vtkNew<vtkDoubleArray> viewpoint;
  viewpoint->SetName("Viewpoint");
  viewpoint->InsertNextValue(0.25);
  cloud->GetFieldData()->AddArray(viewpoint);
  return cloud;
}

void addVertices(vtkPolyData* cloud, bool have64Bits)
{
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  if (!have64Bits)
  {
    vertices->ConvertTo32BitStorage();
  }
  cloud->SetVerts(vertices);
}

class SharedVtp : public CloudFiles
{
protected:
  using Change = std::function<void(vtkPolyData*)>;

  std::string bytesOf(const std::string& name) const
  {
    std::ifstream file(path(name), std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }
  /// Ranks with the points up to these ends write @p name. @return the problem of each rank.
  std::vector<std::string> write(const std::string& name, const std::vector<vtkIdType>& ends,
    const Change& change, bool isShared = true) const
  {
    std::vector<std::string> problems(ends.size() - 1);
    ThreadJob job(static_cast<int>(problems.size()));
    job.run(
      [&](Ranks& ranks)
      {
        const auto rank = static_cast<std::size_t>(ranks.rank());
        const vtkSmartPointer<vtkPolyData> piece = rowsOfEveryKind(ends[rank], ends[rank + 1]);
        change(piece);
        EXPECT_EQ(pointhaptics::io::writeVtpTogether(ranks, piece, path(name), problems[rank]), isShared);
      });
    return problems;
  }
  void expectSame(const std::vector<vtkIdType>& ends, const Change& change) const
  {
    const vtkSmartPointer<vtkPolyData> all = rowsOfEveryKind(0, ends.back());
    change(all);
    vtkNew<vtkPointCloudWriter> writer;
    writer->SetFileName(path("expected.vtp").c_str());
    writer->SetInputData(all);
    ASSERT_EQ(writer->Write(), 1);
    for (const std::string& problem : write("out.vtp", ends, change))
    {
      EXPECT_EQ(problem, "");
    }
    EXPECT_TRUE(bytesOf("out.vtp") == bytesOf("expected.vtp"));
  }
};

TEST_F(SharedVtp, IsTheFileOfOneWriter)
{
  for (const std::vector<vtkIdType>& ends :
    { std::vector<vtkIdType>{ 0, 70000, 150000 }, { 0, 3, 4, 200 }, { 0, 0, 55, 55, 101 } })
  {
    expectSame(ends, [](vtkPolyData*) {});
    expectSame(ends, [](vtkPolyData* cloud) { addVertices(cloud, true); });
    expectSame(ends, [](vtkPolyData* cloud) { addVertices(cloud, false); });
  }
}

TEST_F(SharedVtp, LeavesWhatHasNoPartsToAnother)
{
  const std::vector<vtkIdType> ends = { 0, 10, 30 };
  const auto expectNone = [&](const std::vector<vtkIdType>& some, const Change& change)
  {
    for (const std::string& problem : write("out.vtp", some, change, false))
    {
      EXPECT_EQ(problem, "");
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
  };
  expectNone({ 0, 0, 0 }, [](vtkPolyData*) {});
  expectNone(ends,
    [](vtkPolyData* cloud)
    {
      vtkNew<vtkStringArray> names;
      names->SetName("Names");
      names->SetNumberOfValues(cloud->GetNumberOfPoints());
      cloud->GetPointData()->AddArray(names);
    });
  expectNone(ends,
    [](vtkPolyData* cloud)
    {
      // On one rank alone.
      const vtkIdType line[] = { 0, 1 };
      vtkNew<vtkCellArray> lines;
      lines->InsertNextCell(2, line);
      cloud->SetLines(cloud->GetNumberOfPoints() == 20 ? lines.Get() : nullptr);
    });
  EXPECT_EQ(write(
              "none/out.vtp", ends, [](vtkPolyData*) {}, false)
              .size(),
    2u);
}

TEST_F(SharedVtp, FullDiskLeavesTheOldFileAsItWas)
{
  CloudFiles::write("a.vtp", "old");
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  void (*handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
  // The first rank's parts of the first arrays fit.
  rlimit small = before;
  small.rlim_cur = 30000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::vector<std::string> problems = write("a.vtp", { 0, 1000, 2000 }, [](vtkPolyData*) {});
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(problems[1].find("a.vtp: VTP: "), std::string::npos) << problems[1];
  EXPECT_EQ(bytesOf("a.vtp"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

} // namespace
