#include "Clouds/Pipeline.h"

#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StandardStreams.h"
#include "Terminal/StopSignals.h"

#include "IO/Info/LengthUnit.h"
#include "MergedCloud.h"
#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"

#include <fmt/format.h>
#include <vtkAlgorithm.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <thread>

namespace pointhaptics::app
{
namespace
{

/// Measures the seconds since it was made.
class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

std::string firstOf(const std::vector<std::string>& messages)
{
  return messages.empty() ? std::string() : messages.front();
}

/// Reads a file. @p shown: its name in messages.
bool readFile(const std::string& path, const std::string& shown, Cloud& cloud, std::string& message,
  const ReadOptions& options)
{
  const Stopwatch watch;
  vtkNew<vtkPointCloudReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetExtension(options.extension);
  reader->SetResolution(options.resolution);
  reader->SetApplyPoses(options.applyPoses);
  reader->SetColumns(options.columns);
  reader->SetSalvage(options.salvage);
  reader->SetSamples(vtkIdType(options.samples));
  if (!options.clip.empty())
  {
    reader->SetBox(options.clip.data());
  }
  reader->SetRanks(options.ranks);
  reader->SetGenerateVertices(false); // a writer whose format has cells makes them
  {
    const ProgressBar bar("reading", reader);
    reader->Update();
  }
  message = reader->GetErrorMessage();
  if (message.compare(0, path.size(), path) == 0)
  {
    message.replace(0, path.size(), shown);
  }
  const std::string other = firstOf(takeVtkErrors());
  if (message.empty() && !other.empty())
  {
    message = shown + ": " + other;
  }
  if (message.empty() && !options.ranks && reader->GetOutput()->GetNumberOfPoints() == 0)
  {
    message = shown + ": holds no points; give a file with at least one";
  }
  cloud.points = reader->GetOutput();
  cloud.format = reader->GetFormat();
  cloud.notes = reader->GetNotes();
  cloud.isValidWithoutPoints = reader->IsValidWithoutPoints();
  cloud.bytesRead = reader->GetNumberOfBytesRead();
  say("read",
    fmt::format("{}: {}, {} in {:.2f} s", shown, cloud.format,
      countOfPoints(cloud.points->GetNumberOfPoints()), watch.seconds()));
  return message.empty() && !reader->FailedElsewhere();
}

bool writeFile(vtkPointSet* points, const std::string& path, const std::string& shown,
  const std::string& command, std::string& message, const WriteOptions& options, vtkIdType* count)
{
  const Stopwatch watch;
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetExtension(options.format);
  writer->SetLasScale(options.lasScale);
  writer->SetKeepDoubles(options.keepsDoubles);
  writer->SetInputDataObject(points);
  bool written = false;
  {
    const ProgressBar bar("writing", writer);
    written = writer->Write() == 1;
  }
  for (const std::string& note : writer->GetNotes())
  {
    warn(command, note, shown);
  }
  if (count)
  {
    *count = writer->GetNumberOfPointsWritten();
  }
  if (written)
  {
    say(command,
      fmt::format("{}: {} written in {:.2f} s", shown, countOfPoints(writer->GetNumberOfPointsWritten()),
        watch.seconds()));
    return true;
  }
  message = writer->GetErrorMessage();
  const std::string other = firstOf(takeVtkErrors());
  if (message.compare(0, path.size(), path) == 0)
  {
    message.replace(0, path.size(), shown);
  }
  if (message.empty())
  {
    message =
      shown + ": " + (other.empty() ? "cannot be written; check the folder and the space left" : other);
  }
  return false;
}

} // namespace

bool readCloud(const std::string& fileName, Cloud& cloud, std::string& message, const ReadOptions& options)
{
  const bool isStandard = fileName == kStandardStream;
  cloud.name = fileName;
  return readFile(
    isStandard ? "/dev/stdin" : fileName, isStandard ? "standard input" : fileName, cloud, message, options);
}

bool updateFilter(vtkAlgorithm* filter, const std::string& label, std::string& message)
{
  const Stopwatch watch;
  {
    const ProgressBar bar(label, filter);
    filter->Update();
  }
  say(label, fmt::format("done in {:.2f} s", watch.seconds()));
  message = firstOf(takeVtkErrors());
  if (stopIsRequested())
  {
    message = label + " was stopped on request; start it again";
  }
  return message.empty();
}

std::vector<std::string> writableExtensions()
{
  std::vector<std::string> extensions;
  std::istringstream words(vtkPointCloudWriter::GetExtensions()); // ".vtp, .ply or .csv"
  for (std::string word; words >> word;)
  {
    if (word.front() == '.')
    {
      extensions.push_back(word.substr(1, word.find_last_not_of(',')));
    }
  }
  return extensions;
}

void WriteOptions::addTo(CLI::App& command)
{
  addWord(command, "--output-format", this->format, writableExtensions(),
    "Format of the output where its name does not tell it");
  command.add_flag("--double", this->keepsDoubles,
    "Keep types and names of all arrays in .pcd; default: floats and names that PCL's point types read");
  addNumber(command, "--las-scale", this->lasScale, { 0.0, 1e6, true }, "UNITS",
    "Step of the coordinates in .las and .laz, in units of the cloud; default: the step of the file that it "
    "comes from or of its decimals, else 0.1 mm, and finer or coarser ones where the cloud is too small or "
    "too "
    "large for that");
}

bool writeCloud(vtkPointSet* points, const std::string& fileName, Files& files, const std::string& command,
  std::string& message, const WriteOptions& options, vtkIdType* written)
{
  rememberStopSignals();
  WriteOptions writing = options;
  if (options.format.empty())
  {
    writing.format = lowerExtension(fileName); // its part has another one
  }
  const std::vector<std::string> known = writableExtensions();
  const std::string named = lowerExtension(fileName);
  if (writing.format != named && std::find(known.begin(), known.end(), named) != known.end())
  {
    warn(command, fmt::format("holds .{} as --output-format says, whatever its name ends in", writing.format),
      fileName);
  }
  if (options.lasScale > 0.0 && writing.format != "las" && writing.format != "laz")
  {
    warn(command, fmt::format("--las-scale has no effect on .{}; leave it out", writing.format), fileName);
  }
  if (fileName != kStandardStream || writing.format != "vtp")
  {
    const std::string shown = fileName == kStandardStream ? "standard output" : fileName;
    return writeFile(points, files.output(fileName), shown, command, message, writing, written);
  }
  // The writer of VTP seeks in the file.
  const TemporaryFolder folder;
  const std::string path = folder.path("output");
  return writeFile(points, path, "standard output", command, message, writing, written) &&
    copyToStandardOutput(path, message);
}

Cloud mergedCloud(const std::string& command, std::vector<Cloud>& clouds)
{
  Cloud merged = clouds.front();
  if (clouds.size() > 1)
  {
    std::vector<vtkPolyData*> parts;
    std::vector<std::string> names;
    for (const Cloud& each : clouds)
    {
      parts.push_back(each.points);
      names.push_back(each.name);
    }
    std::vector<std::string> notes;
    merged.points = io::mergeClouds(parts, names, notes);
    if (!merged.points)
    {
      throw Failure(notes.back());
    }
    for (const std::string& note : notes)
    {
      warn(command, note);
    }
  }
  for (Cloud& each : clouds)
  {
    each = {};
  }
  return merged;
}

std::string whyNoLengths(vtkPolyData* cloud, const AffineTransform& transform)
{
  constexpr double kFewestPerLongitude = 100.0; // of a length: near the poles such a degree is short
  constexpr double kFewestPerLatitude = 1e4;
  const auto lengthOf = [&](const Vec3& v) { return norm(transform.applyToVector(v)); };
  const double z = lengthOf({ 0, 0, 1 });
  const bool areLengths =
    lengthOf({ 1, 0, 0 }) > kFewestPerLongitude * z && lengthOf({ 0, 1, 0 }) > kFewestPerLatitude * z;
  return lengthUnitOf(cloud, Bounds()).name == "deg" && !areLengths
    ? "x and y are degrees and z is a length; project the cloud to metres"
    : "";
}

vtkSmartPointer<vtkPolyData> transformedPoints(vtkPolyData* cloud, const AffineTransform& transform)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->Allocate(cloud->GetNumberOfPoints());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    cloud->GetPoint(i, &p.x);
    const Vec3 moved = transform.apply(p);
    if (isFinite(moved))
    {
      points->InsertNextPoint(moved.x, moved.y, moved.z);
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  return result;
}

std::string noFinitePoint(const std::string& fileName, std::int64_t count)
{
  return fmt::format("{}: no point is finite: {} with a coordinate that is NaN or infinite; mend the file",
    fileName, countOfPoints(count));
}

void showNotes(const std::string& command, const std::string& fileName, const Cloud& cloud)
{
  for (const std::string& note : cloud.notes)
  {
    warn(command, note, fileName == kStandardStream ? "standard input" : fileName);
  }
}

void showWarnings(const std::string& command)
{
  for (const std::string& warning : takeVtkWarnings())
  {
    warn(command, warning);
  }
}

void useThreads(std::int64_t threads)
{
  if (threads > 0)
  {
    // TBB prints a warning where it gets fewer threads than it asks for.
    const auto most = static_cast<std::int64_t>(std::max(1U, std::thread::hardware_concurrency()));
    vtkSMPTools::Initialize(static_cast<int>(std::min(threads, most)));
  }
}

} // namespace pointhaptics::app
