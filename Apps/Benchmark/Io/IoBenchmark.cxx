#include "Benchmark/Io/IoBenchmark.h"

#include "Benchmark/Harness/PeakMemory.h"
#include "Benchmark/Harness/Race.h"
#include "Benchmark/Harness/StudyList.h"
#include "Benchmark/Io/Files.h"
#include "Benchmark/Io/PackedStudy.h"

#include <fmt/format.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace pointhaptics
{
namespace bench
{
namespace io
{
namespace
{

constexpr const char* kOurs = "ours";
constexpr const char* kNewMemory = "bytes into new memory";
constexpr const char* kOldMemory = "bytes into old memory";
/// Float files must bring every bit; LAS rounds to its grid.
constexpr double kLasTolerance = 0.50001e-4;
constexpr double kPromisedMegabytes = 64.0;

constexpr const char* kMethod =
  "The files lie in the page cache; everything runs on one thread, but for our readers of E57 and LAZ,\n"
  "which take all there are. A time is that of the whole call: from a name to the finished result in\n"
  "memory, which is freed outside the timing, and for writing from a cloud in memory to a closed\n"
  "file. Before anything is timed every coordinate is\n"
  "compared with the cloud that was written.\n"
  "\n"
  "- The cloud has float x y z, a float intensity and colours. Ours reads all of them, and so does\n"
  "  VTK where its reader can; PCL is asked for x y z and intensity.\n"
  "- Two contestants only move the file's bytes with read(2): into memory fresh from the system, as\n"
  "  in a program that reads one file, and into memory that is used again and again. Readers lie in\n"
  "  between, as malloc hands out some memory a second time.\n"
  "- \"x ours\" is the time over ours; \"of bytes\" the time of the bytes into new memory over that of\n"
  "  the contestant. Ratios are medians of the ratios within a round.";

struct Context
{
  const IoBenchmarkOptions& options;
  const Progress& progress;
  Files files;
  bool allRight = true;
};

bool isBytes(const std::string& name)
{
  return name == kNewMemory || name == kOldMemory;
}

std::vector<std::unique_ptr<Rival>> everyone(const Context& context)
{
  std::vector<std::unique_ptr<Rival>> all;
  all.push_back(makeOurs());
  for (const std::string& word : context.options.rivals)
  {
    all.push_back(makeRival(word));
  }
  return all;
}

RaceSettings settingsOf(const Context& context)
{
  RaceSettings settings;
  settings.rounds = context.options.repetitions;
  settings.warmUps = context.options.warmUps;
  return settings;
}

const Lap* lapOf(const std::vector<Lap>& laps, const std::string& name)
{
  const auto found = std::find_if(laps.begin(), laps.end(), [&](const Lap& lap) { return lap.name == name; });
  return found == laps.end() ? nullptr : &*found;
}

/// LAS and LAZ round to a grid, of 0.1 mm where the data have none.
bool isOnGrid(FileKind kind)
{
  return kind == FileKind::Las || kind == FileKind::Laz;
}

std::string verdictOn(FileKind kind, double error)
{
  const double allowed = isOnGrid(kind) ? kLasTolerance : 0.0;
  return error <= allowed ? "right" : fmt::format("wrong by {}", brief(error));
}

void addRaceRows(const std::vector<Lap>& laps, const std::vector<std::string>& verdicts, FileKind kind,
  std::int64_t bytes, ReportPart& part, std::vector<Series>& series)
{
  const Lap* ours = lapOf(laps, kOurs);
  const Lap* floor = lapOf(laps, kNewMemory);
  for (std::size_t i = 0; i < laps.size(); ++i)
  {
    const Lap& lap = laps[i];
    const Quartiles q = quartiles(lap.seconds);
    const double timesOurs = pairedRatios(lap.seconds, ours->seconds).median;
    const double ofBytes = floor ? pairedRatios(floor->seconds, lap.seconds).median : 0.0;
    std::vector<std::string> row = { nameOf(kind), brief(double(bytes) / 1e6), lap.name,
      milliseconds(q.median), quartilesText(q), milliseconds(lap.firstSeconds),
      brief(double(bytes) / 1e6 / q.median), brief(timesOurs) };
    if (floor)
    {
      row.push_back(fmt::format("{:.1f} %", 100.0 * ofBytes));
    }
    row.push_back(verdicts[i]);
    part.table.rows.push_back(row);
    part.rows.push_back({ { "file", nameOf(kind) }, { "bytes", bytes }, { "contestant", lap.name },
      { "repetitions", lap.seconds.size() }, { "median_seconds", q.median },
      { "lower_quartile_seconds", q.lower }, { "upper_quartile_seconds", q.upper },
      { "first_seconds", lap.firstSeconds }, { "times_ours", timesOurs }, { "of_bytes", ofBytes },
      { "right", verdicts[i].rfind("wrong", 0) != 0 } });
    if (!isBytes(lap.name))
    {
      const std::string who = lap.name == kOurs ? "ours" : lap.name.find("vtk") == 0 ? "VTK" : "PCL";
      addPoint(series, who,
        double(std::find(std::begin(kAllKinds), std::end(kAllKinds), kind) - kAllKinds) + 1.0,
        1e3 * q.median);
    }
  }
}

Chart chartOf(const std::string& fileName, const std::string& title, const std::vector<Series>& series)
{
  Chart chart;
  chart.fileName = fileName;
  chart.title = title;
  std::string kinds;
  for (std::size_t i = 0; i < std::size(kAllKinds); ++i)
  {
    chart.x.ticks.push_back(double(i + 1));
    kinds += fmt::format("{}{} {}", i ? ", " : "", i + 1, nameOf(kAllKinds[i]));
  }
  chart.x.title = kinds;
  chart.x.logarithmic = false;
  chart.y.title = "median time [ms]";
  chart.series = series;
  for (Series& each : chart.series)
  {
    each.line = false;
  }
  return chart;
}

void readKind(
  Context& context, FileKind kind, vtkPolyData* cloud, ReportPart& part, std::vector<Series>& series)
{
  context.progress(fmt::format("reading {}", nameOf(kind)));
  const std::string path = context.files.write(kind, cloud);
  std::vector<std::unique_ptr<Rival>> rivals = everyone(context);
  rivals.push_back(makeBytes(true));
  rivals.push_back(makeBytes(false));
  std::vector<Contestant> contestants;
  std::vector<std::string> verdicts(rivals.size());
  for (const std::unique_ptr<Rival>& owned : rivals)
  {
    Rival& rival = *owned;
    if (rival.readerOf(kind).empty())
    {
      continue;
    }
    std::string& verdict = verdicts[contestants.size()];
    Contestant contestant;
    contestant.name = rival.readerOf(kind);
    contestant.before = [&rival] { rival.discard(); };
    contestant.run = [&rival, kind, &path] { rival.read(kind, path); };
    contestant.check = [&rival, &verdict, kind, cloud, name = contestant.name, &context]
    {
      verdict = isBytes(name) ? "-" : verdictOn(kind, largestError(cloud, rival.points(), !isOnGrid(kind)));
      context.allRight = context.allRight && (name != kOurs || verdict == "right");
      return true; // a wrong one is timed too, and said to be wrong
    };
    contestants.push_back(contestant);
  }
  const std::vector<Lap> laps = race(contestants, settingsOf(context));
  addRaceRows(laps, verdicts, kind, std::int64_t(std::filesystem::file_size(path)), part, series);
  std::filesystem::remove(path);
}

ReportPart studyRead(Context& context)
{
  ReportPart part;
  part.title = "Reading";
  part.text =
    fmt::format("{} points drawn at random. The compressed PCD holds literals only, as random numbers do "
                "not compress.",
      grouped(context.options.points));
  part.table.header = { "file", "MB", "contestant", "median ms", "quartiles ms", "first ms", "MB/s", "x ours",
    "of bytes", "answer" };
  const vtkSmartPointer<vtkPolyData> cloud = makeCloud(context.options.points);
  std::vector<Series> series;
  for (const FileKind kind : kAllKinds)
  {
    readKind(context, kind, cloud, part, series);
  }
  part.charts.push_back(
    chartOf("io-read", fmt::format("Reading {} points", grouped(context.options.points)), series));
  return part;
}

void writeKind(
  Context& context, FileKind kind, vtkPolyData* cloud, ReportPart& part, std::vector<Series>& series)
{
  context.progress(fmt::format("writing {}", nameOf(kind)));
  std::vector<std::unique_ptr<Rival>> rivals = everyone(context);
  if (rivals.front()->writerOf(kind).empty())
  {
    return;
  }
  std::vector<Contestant> contestants;
  std::vector<std::string> verdicts(rivals.size());
  // Each writes its own file; the extension must be that of the kind.
  const std::string extension = std::filesystem::path(context.files.write(kind, cloud)).extension().string();
  std::string ourPath;
  for (const std::unique_ptr<Rival>& owned : rivals)
  {
    Rival& rival = *owned;
    if (rival.writerOf(kind).empty())
    {
      continue;
    }
    rival.load(cloud);
    std::string& verdict = verdicts[contestants.size()];
    const std::string path = context.files.path(fmt::format("written-{}{}", contestants.size(), extension));
    ourPath = ourPath.empty() ? path : ourPath;
    Contestant contestant;
    contestant.name = rival.writerOf(kind);
    contestant.run = [&rival, kind, path] { rival.write(kind, path); };
    contestant.check = [&verdict, kind, cloud, path, name = contestant.name, &context]
    {
      const std::unique_ptr<Rival> reader = makeOurs();
      reader->read(kind, path);
      verdict = verdictOn(kind, largestError(cloud, reader->points(), !isOnGrid(kind)));
      context.allRight = context.allRight && (name != kOurs || verdict == "right");
      return true;
    };
    contestants.push_back(contestant);
  }
  const std::vector<Lap> laps = race(contestants, settingsOf(context));
  addRaceRows(laps, verdicts, kind, std::int64_t(std::filesystem::file_size(ourPath)), part, series);
}

ReportPart studyWrite(Context& context)
{
  ReportPart part;
  part.title = "Writing";
  part.text = fmt::format(
    "{} points, to a file that is replaced in each round. MB is the size of our file; PCL writes "
    "no colours here, and vtkPLYWriter no intensity. What was written is read again by our reader "
    "and compared. We rename the complete file over the old one, which makes ext4 write its blocks "
    "out at once; \"first\" is without an old file.",
    grouped(context.options.points));
  part.table.header = { "file", "MB", "contestant", "median ms", "quartiles ms", "first ms", "MB/s", "x ours",
    "answer" };
  const vtkSmartPointer<vtkPolyData> cloud = makeCloud(context.options.points);
  std::vector<Series> series;
  for (const FileKind kind : kAllKinds)
  {
    writeKind(context, kind, cloud, part, series);
  }
  part.charts.push_back(
    chartOf("io-write", fmt::format("Writing {} points", grouped(context.options.points)), series));
  return part;
}

void measureMemory(Context& context, FileKind kind, vtkPolyData* cloud, ReportPart& part)
{
  context.progress(fmt::format("memory for {}", nameOf(kind)));
  const std::string path = context.files.pathOf(kind);
  PeakMemory ignored;
  std::string problem;
  // In a child too: VTK's writer would leave threads behind.
  const auto prepare = [&context, kind, cloud]
  {
    context.files.write(kind, cloud);
    return std::int64_t{ 0 };
  };
  if (!measurePeakMemory(prepare, ignored, problem))
  {
    part.remarks.push_back(problem);
    return;
  }
  const std::int64_t bytes = std::int64_t(std::filesystem::file_size(path));
  for (const std::unique_ptr<Rival>& owned : everyone(context))
  {
    Rival& rival = *owned;
    const std::string name = rival.readerOf(kind);
    if (name.empty())
    {
      continue;
    }
    PeakMemory memory;
    std::string message;
    const auto work = [&rival, kind, &path]
    {
      rival.read(kind, path);
      return rival.resultBytes();
    };
    if (!measurePeakMemory(work, memory, message))
    {
      part.remarks.push_back(fmt::format("{}, {}: {}", nameOf(kind), name, message));
      continue;
    }
    const double beyond = double(memory.peakBytes - bytes - memory.result) / 1e6;
    part.table.rows.push_back({ nameOf(kind), name, brief(double(bytes) / 1e6),
      brief(double(memory.result) / 1e6), brief(double(memory.peakBytes) / 1e6),
      fmt::format("{:.1f}", beyond), beyond <= kPromisedMegabytes ? "yes" : "no" });
    part.rows.push_back({ { "file", nameOf(kind) }, { "contestant", name }, { "file_bytes", bytes },
      { "output_bytes", memory.result }, { "peak_bytes", memory.peakBytes },
      { "beyond_bytes", 1e6 * beyond } });
  }
  std::filesystem::remove(path);
}

ReportPart studyMemory(Context& context)
{
  ReportPart part;
  part.title = "Memory of reading";
  part.text =
    fmt::format("{} points. Highest resident memory during the call, in a process of its own. \"beyond\" is "
                "that less the file and the result; our promise is at most {} MB of it.",
      grouped(context.options.memoryPoints), kPromisedMegabytes);
  part.table.header = { "file", "contestant", "file MB", "result MB", "peak MB", "beyond MB",
    "within 64 MB" };
  const vtkSmartPointer<vtkPolyData> cloud = makeCloud(context.options.memoryPoints);
  for (const FileKind kind : kAllKinds)
  {
    measureMemory(context, kind, cloud, part);
  }
  return part;
}

ReportPart studyScans(Context& context)
{
  context.progress("reading compressed files");
  return studyPacked(context.options.points, settingsOf(context), context.files, context.allRight);
}

/// In the order of the report.
constexpr Study<Context> kStudies[] = { { "read", studyRead }, { "packed", studyScans },
  { "write", studyWrite }, { "memory", studyMemory, true } };

} // namespace

void IoBenchmarkOptions::makeQuick()
{
  points = 5000;
  memoryPoints = 20000;
  repetitions = 3;
}

std::vector<std::string> studyWords()
{
  return wordsOf(kStudies);
}

Report benchmarkIo(const IoBenchmarkOptions& options, const Progress& progress, bool& allRight)
{
  Report report;
  report.task = "io";
  report.title = "Reading and writing files";
  report.method = kMethod;
  report.machine = thisMachine();
  Context context{ options, progress, {}, true };
  report.parts = runStudies(kStudies, options.studies, context);
  allRight = context.allRight;
  return report;
}

} // namespace io
} // namespace bench
} // namespace pointhaptics
