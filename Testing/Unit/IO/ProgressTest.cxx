// Progress and stopping on request, of every writer and of the readers that leave the work to VTK.
#include "CloudFiles.h"

#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFloatArray.h"

#include <algorithm>

namespace
{

constexpr vtkIdType kPoints = 200000;

/// Points on a grid of millimetres, so that LAS has an exact grid to find, and an array.
vtkSmartPointer<vtkPolyData> makeLargeCloud()
{
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(kPoints);
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  density->SetNumberOfTuples(kPoints);
  for (vtkIdType i = 0; i < kPoints; ++i)
  {
    coordinates->SetTuple3(i, static_cast<double>(i) * 0.001, static_cast<double>(i % 1000) * 0.001, 0.25);
    density->SetValue(i, static_cast<float>(i));
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->AddArray(density);
  return cloud;
}

/// Remembers every progress report and, from one above @c stopAbove on, asks to stop.
struct Observer
{
  std::vector<double> reports;
  double stopAbove = 2.0;
  int errors = 0;
  std::string folder; ///< where set, the unfinished file there gets the name @c kept as well
  std::string kept;

  void watch(vtkAlgorithm* algorithm)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback(
      [](vtkObject* caller, unsigned long event, void* self, void* fraction)
      {
        Observer* observer = static_cast<Observer*>(self);
        if (event == vtkCommand::ErrorEvent)
        {
          ++observer->errors;
          return;
        }
        observer->reports.push_back(*static_cast<double*>(fraction));
        if (observer->reports.back() > observer->stopAbove)
        {
          vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
          observer->keepUnfinishedFile();
        }
      });
    algorithm->AddObserver(vtkCommand::ProgressEvent, command);
    algorithm->AddObserver(vtkCommand::ErrorEvent, command);
  }

  void keepUnfinishedFile() const
  {
    if (!folder.empty() && !std::filesystem::exists(kept))
    {
      std::filesystem::create_hard_link(*std::filesystem::directory_iterator(folder), kept);
    }
  }

  int reportsBetween(double from, double to) const
  {
    return static_cast<int>(std::count_if(
      reports.begin(), reports.end(), [=](double report) { return report > from && report < to; }));
  }
};

void expectSteadyProgress(const std::vector<double>& reports)
{
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  ASSERT_FALSE(reports.empty());
  EXPECT_GE(reports.front(), 0.0);
  EXPECT_EQ(reports.back(), 1.0);
}

std::string contentOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

} // namespace

class WritingProgress
  : public CloudFiles
  , public ::testing::WithParamInterface<const char*>
{
protected:
  std::string target() const { return path(std::string("cloud.") + GetParam()); }
  std::ptrdiff_t filesInFolder() const
  {
    return std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator());
  }
};

TEST_P(WritingProgress, RisesToOne)
{
  Observer observer;
  vtkNew<vtkPointCloudWriter> writer;
  observer.watch(writer);
  writer->SetInputData(makeLargeCloud());
  writer->SetFileName(target().c_str());
  ASSERT_EQ(writer->Write(), 1) << writer->GetErrorMessage();
  expectSteadyProgress(observer.reports);
  EXPECT_GE(observer.reportsBetween(0.0, 1.0), 2);
  EXPECT_EQ(readCloud(target()).points(), kPoints);
}

TEST_P(WritingProgress, StopsOnRequestAndLeavesNoFileBehind)
{
  // In the middle, and at the last moment before the file gets its name.
  for (const double stopAbove : { 0.0, 0.4, 0.999 })
  {
    Observer observer;
    observer.stopAbove = stopAbove;
    vtkNew<vtkPointCloudWriter> writer;
    observer.watch(writer);
    writer->SetInputData(makeLargeCloud());
    writer->SetFileName(target().c_str());
    EXPECT_EQ(writer->Write(), 0);
    EXPECT_EQ(filesInFolder(), 0) << stopAbove;
    EXPECT_EQ(observer.errors, 0);
    EXPECT_EQ(writer->GetErrorCode(), vtkErrorCode::UserError);
    EXPECT_EQ(writer->GetErrorMessage(), target() + ": writing was stopped on request; write it again");
  }
}

TEST_P(WritingProgress, KeepsTheOldFileWhenStoppedAndReplacesItTheNextTime)
{
  write(std::string("cloud.") + GetParam(), "old");
  Observer observer;
  observer.stopAbove = 0.4;
  vtkNew<vtkPointCloudWriter> writer;
  observer.watch(writer);
  writer->SetInputData(makeLargeCloud());
  writer->SetFileName(target().c_str());
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_EQ(contentOf(target()), "old");
  EXPECT_EQ(filesInFolder(), 1);
  observer.stopAbove = 2.0;
  EXPECT_EQ(writer->Write(), 1) << writer->GetErrorMessage();
  EXPECT_EQ(readCloud(target()).points(), kPoints);
}

TEST_P(WritingProgress, WritesNoFurtherOnceStopped)
{
  ASSERT_EQ(writeCloud(makeLargeCloud(), target()), "");
  const std::uintmax_t whole = std::filesystem::file_size(target());
  std::filesystem::remove(target());
  Observer observer;
  observer.stopAbove = 0.05;
  observer.folder = folder_.string();
  observer.kept = path("kept");
  vtkNew<vtkPointCloudWriter> writer;
  observer.watch(writer);
  writer->SetInputData(makeLargeCloud());
  writer->SetFileName(target().c_str());
  EXPECT_EQ(writer->Write(), 0);
  ASSERT_TRUE(std::filesystem::exists(observer.kept));
  EXPECT_LT(std::filesystem::file_size(observer.kept), whole / 2);
}

INSTANTIATE_TEST_SUITE_P(Formats, WritingProgress,
  ::testing::Values("vtp", "ply", "pcd", "las", "csv", "xyz"),
  [](const auto& format) { return std::string(format.param); });

using ReadingProgress = CloudFiles;

TEST_F(ReadingProgress, OfVtpRisesToOneAndStopsOnRequest)
{
  const std::string file = path("cloud.vtp");
  ASSERT_EQ(writeCloud(makeLargeCloud(), file), "");
  for (const double stopAbove : { 2.0, 0.6 })
  {
    Observer observer;
    observer.stopAbove = stopAbove;
    vtkNew<vtkPointCloudReader> reader;
    observer.watch(reader);
    reader->SetFileName(file.c_str());
    reader->Update();
    EXPECT_EQ(observer.errors, 0);
    if (stopAbove > 1.0)
    {
      expectSteadyProgress(observer.reports);
      EXPECT_GE(observer.reportsBetween(0.4, 1.0), 2); // while VTK reads, not only before
      EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), kPoints);
    }
    else
    {
      EXPECT_EQ(reader->GetErrorMessage(), file + ": reading was stopped on request; read it again");
      EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
    }
  }
}
