#include "Benchmark/Io/PackedStudy.h"

#include "Benchmark/Harness/Race.h"
#include "Benchmark/Io/E57File.h"
#include "Benchmark/Io/Files.h"

#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <stdexcept>

namespace pointhaptics
{
namespace bench
{
namespace io
{
namespace
{

constexpr int kThreads = 2;
constexpr vtkIdType kLine = 1000; ///< Points of a scan line.

template <typename Array>
Array* addArray(vtkPolyData* cloud, const char* name, int components = 1)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(cloud->GetNumberOfPoints());
  cloud->GetPointData()->AddArray(array);
  return Array::SafeDownCast(cloud->GetPointData()->GetArray(name));
}

/// Scan lines of 1 m steps with some centimetres of noise, 100 kHz, one return in ten the second of two.
/// @param scanner gives it what only point formats 6 and up have.
vtkSmartPointer<vtkPolyData> makeSurvey(std::int64_t count, bool scanner)
{
  std::mt19937 random(1);
  const auto noise = [&] { return (double(random()) / 4294967296.0 - 0.5) * 0.2; };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  auto* time = addArray<vtkDoubleArray>(cloud, "GpsTime");
  auto* intensity = addArray<vtkUnsignedShortArray>(cloud, "Intensity");
  auto* color = addArray<vtkUnsignedShortArray>(cloud, "Color16", 3);
  auto* returns = addArray<vtkUnsignedCharArray>(cloud, "ReturnNumber");
  auto* of = addArray<vtkUnsignedCharArray>(cloud, "NumberOfReturns");
  auto* channel = scanner ? addArray<vtkUnsignedCharArray>(cloud, "ScannerChannel") : nullptr;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const bool isSecond = i % 10 == 9;
    const double x = double(i % kLine) + noise(), y = double(i / kLine) + noise();
    const double z = 20.0 * std::sin(0.01 * x) * std::cos(0.013 * y) + noise() + (isSecond ? 0.0 : 5.0);
    const auto cents = [](double value) { return std::round(100.0 * value) / 100.0; };
    points->SetPoint(i, cents(636000.0 + x), cents(849000.0 + y), cents(400.0 + z));
    time->SetValue(i, 245379.0 + 1e-5 * double(i - (isSecond ? 1 : 0)));
    intensity->SetValue(i, static_cast<unsigned short>(100 + random() % 64));
    for (int c = 0; c < 3; ++c)
    {
      color->SetValue(3 * i + c, static_cast<unsigned short>((80 + 10 * c + random() % 32) << 8));
    }
    returns->SetValue(i, isSecond ? 2 : 1);
    of->SetValue(i, i % 10 >= 8 ? 2 : 1);
    if (channel)
    {
      channel->SetValue(i, static_cast<unsigned char>(i % 2));
    }
  }
  return cloud;
}

void writeCloud(vtkPolyData* cloud, const std::string& path)
{
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetInputData(cloud);
  writer->SetFileName(path.c_str());
  if (writer->Write() != 1)
  {
    throw std::runtime_error(writer->GetErrorMessage());
  }
}

struct Reading
{
  std::string path;
  bool onlyPositions = false;
  vtkSmartPointer<vtkPolyData> cloud;
  std::string format;

  void run()
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SetFileName(path.c_str());
    reader->SetOnlyPositions(onlyPositions);
    const auto update = [&] { reader->Update(); };
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ kThreads }, update);
    if (*reader->GetErrorMessage())
    {
      throw std::runtime_error(reader->GetErrorMessage());
    }
    cloud = reader->GetOutput();
    format = reader->GetFormat();
  }
  bool hasPointsOf(vtkPolyData* expected) const
  {
    std::vector<double> points(3 * std::size_t(cloud->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
    {
      cloud->GetPoint(i, &points[3 * std::size_t(i)]);
    }
    return largestError(expected, points, false) == 0.0;
  }
};

class PackedRace
{
public:
  PackedRace(std::int64_t points, const RaceSettings& settings, bool& allRight)
    : points_(points)
    , settings_(settings)
    , allRight_(allRight)
  {
  }

  /// @p plain: the same points uncompressed, which the ratios are to.
  void run(const std::string& plain, const std::string& packed, vtkPolyData* cloud, ReportPart& part)
  {
    Reading reference{ plain, false, nullptr, {} };
    reference.run();
    std::vector<Reading> readings = { reference, { packed, false, nullptr, {} },
      { packed, true, nullptr, {} } };
    std::vector<std::string> verdicts(readings.size() + 1, "-");
    std::vector<Contestant> contestants;
    for (Reading& reading : readings)
    {
      Contestant each;
      each.before = [&reading] { reading.cloud = nullptr; };
      each.run = [&reading] { reading.run(); };
      each.check = [&reading, &reference, &verdict = verdicts[contestants.size()], cloud, this]
      {
        const bool isRight = reading.hasPointsOf(cloud ? cloud : reference.cloud.Get());
        verdict = isRight ? "right" : "wrong";
        allRight_ = allRight_ && isRight;
        return true;
      };
      contestants.push_back(each);
    }
    const std::unique_ptr<Rival> bytes = makeBytes(true);
    Contestant floor;
    floor.before = [&bytes] { bytes->discard(); };
    floor.run = [&bytes, &packed] { bytes->read(FileKind::Las, packed); };
    contestants.push_back(floor);
    const std::vector<Lap> laps = race(contestants, settings_);
    const char* kWhat[] = { "all", "all", "x y z", "bytes into new memory" };
    for (std::size_t i = 0; i < laps.size(); ++i)
    {
      const std::string& path = i == 0 ? plain : packed;
      this->addRow(i < readings.size() ? readings[i].format : readings[1].format, path, kWhat[i], laps[i],
        laps[0], verdicts[i], part);
    }
  }

private:
  void addRow(const std::string& format, const std::string& path, const std::string& what, const Lap& lap,
    const Lap& plain, const std::string& verdict, ReportPart& part) const
  {
    const Quartiles q = quartiles(lap.seconds);
    const double megabytes = double(std::filesystem::file_size(path)) / 1e6;
    const double rate = double(points_) / 1e6 / q.median;
    const double timesPlain = pairedRatios(lap.seconds, plain.seconds).median;
    part.table.rows.push_back({ format, brief(megabytes), what, milliseconds(q.median), quartilesText(q),
      brief(rate), brief(timesPlain), verdict });
    part.rows.push_back({ { "file", format }, { "bytes", std::int64_t(1e6 * megabytes) }, { "read", what },
      { "median_seconds", q.median }, { "lower_quartile_seconds", q.lower },
      { "upper_quartile_seconds", q.upper }, { "million_points_a_second", rate },
      { "times_plain", timesPlain }, { "right", verdict != "wrong" } });
  }

  std::int64_t points_;
  const RaceSettings& settings_;
  bool& allRight_;
};

/// The survey with the arrays that asE57() writes.
vtkSmartPointer<vtkPolyData> asScan(vtkPolyData* survey)
{
  auto scan = vtkSmartPointer<vtkPolyData>::New();
  scan->SetPoints(survey->GetPoints());
  auto* intensity = addArray<vtkFloatArray>(scan, "intensity");
  auto* rgb = addArray<vtkUnsignedCharArray>(scan, "RGB", 3);
  vtkDataArray* stored = survey->GetPointData()->GetArray("Intensity");
  vtkDataArray* color = survey->GetPointData()->GetArray("Color16");
  for (vtkIdType i = 0; i < scan->GetNumberOfPoints(); ++i)
  {
    intensity->SetValue(i, float(stored->GetComponent(i, 0)));
    for (int c = 0; c < 3; ++c)
    {
      rgb->SetValue(3 * i + c, static_cast<unsigned char>(color->GetComponent(i, c) / 256.0));
    }
  }
  return scan;
}

} // namespace

ReportPart studyPacked(std::int64_t points, const RaceSettings& settings, const Files& files, bool& allRight)
{
  ReportPart part;
  part.title = "Files of laser scanners";
  part.text = fmt::format(
    "{} points of a made-up survey, scan lines over hills on a grid of a centimetre, read on {} threads. \"x "
    "plain\" is the time over that of the first row of its kind: the LAS file, and for E57 the PLY file, of "
    "the "
    "same points. \"x y z\" leaves the arrays out (`SetOnlyPositions`), which E57 does not.",
    grouped(points), kThreads);
  part.table.header = { "file", "MB", "what", "median ms", "quartiles ms", "million points/s", "x plain",
    "answer" };
  PackedRace race(points, settings, allRight);
  vtkSmartPointer<vtkPolyData> survey;
  for (const bool scanner : { false, true })
  {
    survey = makeSurvey(points, scanner);
    writeCloud(survey, files.path("survey.las"));
    writeCloud(survey, files.path("survey.laz"));
    race.run(files.path("survey.las"), files.path("survey.laz"), nullptr, part);
  }
  const vtkSmartPointer<vtkPolyData> scan = asScan(survey);
  writeCloud(scan, files.path("scan.ply"));
  std::ofstream(files.path("scan.e57"), std::ios::binary) << asE57(scan);
  race.run(files.path("scan.ply"), files.path("scan.e57"), scan, part);
  return part;
}

} // namespace io
} // namespace bench
} // namespace pointhaptics
