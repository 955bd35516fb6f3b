/// How long do our reader and writer take beside those of VTK and PCL?
#include "Benchmark/Harness/Machine.h"
#include "Benchmark/Harness/Race.h"
#include "Benchmark/Harness/RivalModule.h"
#include "Benchmark/Io/Rival.h"
#include "Benchmark/Tasks.h"
#include "Options/OptionParsing.h"

#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <stdexcept>

#include <stdlib.h>

namespace pointhaptics::bench::io
{
namespace
{

using namespace app;

constexpr std::int64_t kMostPoints = 100'000'000;
constexpr const char* kOurs = "ours";
constexpr double kEdge = 10.0; ///< Metres of the cube that the points are drawn from.
/// Float files must bring every bit; LAS and LAZ round to a grid of 0.1 mm.
constexpr double kGridTolerance = 0.50001e-4;

struct Kind
{
  FileKind kind;
  const char* name;
  const char* extension;
};

constexpr Kind kKinds[] = { { FileKind::BinaryPly, "PLY binary", ".ply" },
  { FileKind::BinaryPcd, "PCD binary", ".pcd" }, { FileKind::Csv, "CSV", ".csv" },
  { FileKind::Las, "LAS", ".las" }, { FileKind::Laz, "LAZ", ".laz" }, { FileKind::Vtp, "VTP", ".vtp" } };

const std::vector<RivalFile>& rivalFiles()
{
  static const std::vector<RivalFile> files{
#ifdef POINTHAPTICS_RIVAL_IO_PCL
    { "pcl", POINTHAPTICS_RIVAL_IO_PCL }
#endif
  };
  return files;
}

class Ours : public Rival
{
public:
  std::string readerOf(FileKind) const override { return kOurs; }
  std::string writerOf(FileKind) const override { return kOurs; }
  void read(FileKind, const std::string& path) override
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    if (*reader->GetErrorMessage())
    {
      throw std::runtime_error(reader->GetErrorMessage());
    }
    cloud_ = reader->GetOutput();
  }
  void discard() override { cloud_ = nullptr; }
  std::vector<double> points() const override
  {
    std::vector<double> xyz(3 * std::size_t(cloud_->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < cloud_->GetNumberOfPoints(); ++i)
    {
      cloud_->GetPoint(i, &xyz[3 * std::size_t(i)]);
    }
    return xyz;
  }
  void load(vtkPolyData* cloud) override { cloud_ = cloud; }
  void write(FileKind, const std::string& path) override
  {
    vtkNew<vtkPointCloudWriter> writer;
    writer->SetInputData(cloud_);
    writer->SetFileName(path.c_str());
    if (writer->Write() != 1)
    {
      throw std::runtime_error(writer->GetErrorMessage());
    }
  }
  std::int64_t resultBytes() const { return 1024 * std::int64_t(cloud_->GetActualMemorySize()); }

protected:
  vtkSmartPointer<vtkPolyData> cloud_;
};

/// VTK has the cloud in the same form.
class Vtk : public Ours
{
public:
  std::string readerOf(FileKind kind) const override
  {
    return kind == FileKind::BinaryPly ? "vtkPLYReader" : kind == FileKind::Vtp ? "vtkXMLPolyDataReader" : "";
  }
  std::string writerOf(FileKind kind) const override
  {
    return kind == FileKind::BinaryPly ? "vtkPLYWriter" : kind == FileKind::Vtp ? "vtkXMLPolyDataWriter" : "";
  }
  void read(FileKind kind, const std::string& path) override
  {
    if (kind == FileKind::Vtp)
    {
      vtkNew<vtkXMLPolyDataReader> reader;
      reader->SetFileName(path.c_str());
      reader->Update();
      cloud_ = reader->GetOutput();
    }
    else
    {
      vtkNew<vtkPLYReader> reader;
      reader->SetFileName(path.c_str());
      reader->Update();
      cloud_ = reader->GetOutput();
    }
  }
  void write(FileKind kind, const std::string& path) override
  {
    int written = 0;
    if (kind == FileKind::Vtp)
    {
      vtkNew<vtkXMLPolyDataWriter> writer;
      writer->SetInputData(cloud_);
      writer->SetFileName(path.c_str());
      writer->SetDataModeToAppended();
      writer->EncodeAppendedDataOff();
      writer->SetCompressorTypeToNone();
      written = writer->Write();
    }
    else
    {
      vtkNew<vtkPLYWriter> writer;
      writer->SetInputData(cloud_);
      writer->SetFileName(path.c_str());
      writer->SetArrayName("RGB");
      written = writer->Write();
    }
    if (written != 1)
    {
      throw std::runtime_error(path + ": VTK cannot write it");
    }
  }
};

/// A folder that is removed at the end.
class Folder
{
public:
  Folder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "pointhaptics-bench-XXXXXX").string();
    if (!::mkdtemp(name.data()))
    {
      throw std::runtime_error(
        "no folder can be made for the files: " + name + "; set TMPDIR to one with space");
    }
    folder_ = name;
  }
  ~Folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
  std::filesystem::path folder_;
};

/// Float points drawn at random with seed 1; arrays "intensity" (float) and "RGB" (3 bytes).
vtkSmartPointer<vtkPolyData> makeCloud(std::int64_t points)
{
  std::mt19937 random(1);
  const auto unit = [&] { return double(random()) / 4294967296.0; };
  vtkNew<vtkPoints> made;
  vtkNew<vtkFloatArray> intensity;
  vtkNew<vtkUnsignedCharArray> color;
  made->SetNumberOfPoints(points);
  intensity->SetName("intensity");
  intensity->SetNumberOfValues(points);
  color->SetName("RGB");
  color->SetNumberOfComponents(3);
  color->SetNumberOfTuples(points);
  for (vtkIdType i = 0; i < points; ++i)
  {
    const double x = kEdge * unit(), y = kEdge * unit(), z = kEdge * unit();
    made->SetPoint(i, x, y, z);
    intensity->SetValue(i, float(unit()));
    for (int channel = 0; channel < 3; ++channel)
    {
      color->SetValue(3 * i + channel, static_cast<unsigned char>(random() >> 24));
    }
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(made);
  cloud->GetPointData()->AddArray(intensity);
  cloud->GetPointData()->SetScalars(color);
  return cloud;
}

/// Largest difference of any coordinate, with @p points rounded to floats where no grid rounded them;
/// infinite where the number of points differs.
double largestError(vtkPolyData* expected, const std::vector<double>& points, bool isOnGrid)
{
  const vtkIdType count = expected->GetNumberOfPoints();
  if (points.size() != 3 * std::size_t(count))
  {
    return std::numeric_limits<double>::infinity();
  }
  double largest = 0.0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double* p = expected->GetPoint(i);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double point = points[3 * std::size_t(i) + std::size_t(axis)];
      const double error = std::abs((isOnGrid ? point : double(float(point))) - p[axis]);
      largest = error <= largest ? largest : error; // NaN stays
    }
  }
  return largest;
}

/// Ours first.
std::vector<std::unique_ptr<Rival>> everyone(const Run& run)
{
  std::vector<std::unique_ptr<Rival>> all;
  all.push_back(std::make_unique<Ours>());
  for (const std::string& word : run.rivals)
  {
    all.push_back(word == "vtk" ? std::make_unique<Vtk>() : makeRival<Rival>(rivalFiles(), word));
  }
  return all;
}

/// Whether what a reader read, or what our reader finds in what a writer wrote, is @p cloud.
bool isRight(const Kind& kind, vtkPolyData* cloud, const Rival& rival, const std::string& path, bool reads)
{
  const bool isOnGrid = kind.kind == FileKind::Las || kind.kind == FileKind::Laz;
  Ours reader;
  if (!reads)
  {
    reader.read(kind.kind, path);
  }
  const std::vector<double> points = reads ? rival.points() : reader.points();
  return largestError(cloud, points, isOnGrid) <= (isOnGrid ? kGridTolerance : 0.0);
}

/// Times all who can read, or write, files of a kind.
void raceOn(Run& run, const Kind& kind, vtkPolyData* cloud, const Folder& folder, bool reads)
{
  const char* const study = reads ? "read" : "write";
  run.say(fmt::format("{} {}", study, kind.name));
  const std::string common = folder.path(std::string("cloud") + kind.extension);
  Ours ours;
  ours.load(cloud);
  ours.write(kind.kind, common);
  const std::vector<std::unique_ptr<Rival>> rivals = everyone(run);
  std::vector<Contestant> contestants;
  std::vector<char> right(rivals.size(), false);
  for (const std::unique_ptr<Rival>& owned : rivals)
  {
    Rival& rival = *owned;
    Contestant contestant;
    contestant.name = reads ? rival.readerOf(kind.kind) : rival.writerOf(kind.kind);
    if (contestant.name.empty())
    {
      continue;
    }
    // Each writes its own file.
    const std::string path =
      reads ? common : folder.path(fmt::format("written-{}{}", contestants.size(), kind.extension));
    if (reads)
    {
      contestant.before = [&rival] { rival.discard(); };
      contestant.run = [&rival, &kind, path] { rival.read(kind.kind, path); };
    }
    else
    {
      rival.load(cloud);
      contestant.run = [&rival, &kind, path] { rival.write(kind.kind, path); };
    }
    contestant.check = [&isItRight = right[contestants.size()], &rival, &kind, cloud, path, reads]
    {
      isItRight = isRight(kind, cloud, rival, path, reads);
      return true; // a wrong one is timed too, and said to be wrong
    };
    contestants.push_back(contestant);
  }
  RaceSettings settings;
  settings.rounds = run.repetitions;
  settings.warmUps = 1;
  const std::vector<Lap> laps = race(contestants, settings);
  for (std::size_t i = 0; i < laps.size(); ++i)
  {
    Json row{ { "file", kind.name }, { "bytes", std::filesystem::file_size(common) } };
    row.update(timesOf(laps, i));
    row["right"] = bool(right[i]);
    run.add(study, std::move(row));
  }
  if (!right.front())
  {
    run.fault("vtkPointCloudReader or vtkPointCloudWriter is wrong; look for rows that are not right");
  }
}

/// Memory that our reader holds beyond the file and the result.
void measureMemory(Run& run, const Kind& kind, vtkPolyData* cloud, const Folder& folder)
{
  run.say(fmt::format("memory for {}", kind.name));
  const std::string path = folder.path(std::string("large") + kind.extension);
  Ours ours;
  ours.load(cloud);
  ours.write(kind.kind, path);
  ours.discard();
  const std::int64_t peak = peakBytesOf([&] { ours.read(kind.kind, path); });
  if (peak < 0)
  {
    run.remark("memory", "memory cannot be measured here: the kernel has no counters");
    return;
  }
  const auto bytes = std::int64_t(std::filesystem::file_size(path));
  run.add("memory",
    { { "file", kind.name }, { "contestant", kOurs }, { "file_bytes", bytes },
      { "output_bytes", ours.resultBytes() }, { "peak_bytes", peak },
      { "beyond_bytes", peak - bytes - ours.resultBytes() } });
}

TaskRun addOptions(CLI::App& command)
{
  auto points = std::make_shared<std::int64_t>(0);
  addInteger(command, "--points", *points, 1, kMostPoints,
    "Points of the files; default 543652, for the study of memory 3000000");
  return [points](Run& run)
  {
    const Folder folder;
    const vtkSmartPointer<vtkPolyData> cloud = makeCloud(run.chosen<std::int64_t>(*points, 543652, 5000));
    for (const bool reads : { true, false })
    {
      for (const Kind& kind : kKinds)
      {
        if (run.wants(reads ? "read" : "write"))
        {
          raceOn(run, kind, cloud, folder, reads);
        }
      }
    }
    if (run.wants("memory"))
    {
      const vtkSmartPointer<vtkPolyData> large = makeCloud(run.chosen<std::int64_t>(*points, 3000000, 20000));
      for (const Kind& kind : kKinds)
      {
        measureMemory(run, kind, large, folder);
      }
    }
  };
}

std::vector<std::string> rivalWords()
{
  std::vector<std::string> words = wordsOf(rivalFiles());
  words.emplace_back("vtk");
  return words;
}

} // namespace
} // namespace pointhaptics::bench::io

namespace pointhaptics::bench
{

Task ioTask()
{
  return { "io", "Time reading and writing of files: ours, VTK's, PCL's; answers checked first", 15, 3, false,
    { "read", "write", "memory" }, io::rivalWords(), io::addOptions };
}

} // namespace pointhaptics::bench
