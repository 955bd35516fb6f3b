#include "Clouds/Pipeline.h"

#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StandardStreams.h"
#include "Terminal/StopSignals.h"

#include "IO/Info/FieldText.h"
#include "IO/Info/LengthUnit.h"
#include "MergedCloud.h"
#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"

#include <fmt/format.h>
#include <vtkAlgorithm.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
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

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin)
{
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The fault of a class that works on @p path, which the user calls @p shown: its @p message, or what another
/// class said; empty: there is none.
std::string faultOf(std::string message, const std::string& path, const std::string& shown)
{
  const std::vector<std::string> others = takeVtkErrors();
  if (!path.empty() && message.rfind(path, 0) == 0)
  {
    message.replace(0, path.size(), shown);
  }
  return !message.empty() || others.empty() ? message : shown + ": " + others.front();
}

vtkIdType writeFile(
  vtkPointSet* points, const std::string& path, const std::string& shown, const WriteOptions& options)
{
  const Clock::time_point begin = Clock::now();
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
    warn(note, shown);
  }
  if (!written)
  {
    const std::string fault = faultOf(writer->GetErrorMessage(), path, shown);
    throw Failure(fault.empty() ? shown + ": cannot be written; check the folder and the space left" : fault);
  }
  const vtkIdType count = writer->GetNumberOfPointsWritten();
  say(fmt::format("{}: {} written in {:.2f} s", shown, countOfPoints(count), secondsSince(begin)));
  return count;
}

} // namespace

Cloud readCloud(const std::string& fileName, const ReadOptions& options)
{
  const Clock::time_point begin = Clock::now();
  const std::string path = fileName == kStandardStream ? "/dev/stdin" : fileName;
  const std::string shown = shownFile(fileName);
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
  Cloud cloud{ reader->GetOutput(), fileName, reader->GetFormat(), reader->GetNotes(),
    reader->GetNumberOfBytesRead() };
  std::string fault = faultOf(reader->GetErrorMessage(), path, shown);
  if (fault.empty() && !options.ranks && cloud.points->GetNumberOfPoints() == 0)
  {
    fault = shown + ": holds no points; give a file with at least one";
  }
  say(fmt::format("{}: {}, {} in {:.2f} s", shown, cloud.format,
        countOfPoints(cloud.points->GetNumberOfPoints()), secondsSince(begin)),
    "read");
  if (!fault.empty())
  {
    require(options.mayBeEmpty && reader->IsValidWithoutPoints(), fault);
    const bool isNamed = fault.rfind(shown + ": ", 0) == 0;
    cloud.notes.push_back(isNamed ? fault.substr(shown.size() + 2) : fault);
  }
  return cloud;
}

void updateFilter(vtkAlgorithm* filter, const std::string& label, const std::string& input)
{
  const Clock::time_point begin = Clock::now();
  {
    const ProgressBar bar(label, filter);
    filter->Update();
  }
  say(fmt::format("done in {:.2f} s", secondsSince(begin)), label);
  const std::string fault = faultOf("", "", input);
  require(!stopIsRequested(), input + ": " + label + " was stopped on request; start it again");
  require(fault.empty(), fault);
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

vtkIdType writeCloud(
  vtkPointSet* points, const std::string& fileName, Files& files, const WriteOptions& options)
{
  rememberStopSignals();
  WriteOptions writing = options;
  const std::string named = lowerExtension(fileName);
  writing.format = options.format.empty() ? named : options.format; // its part has another one
  const std::vector<std::string> known = writableExtensions();
  if (writing.format != named && std::find(known.begin(), known.end(), named) != known.end())
  {
    warn(
      fmt::format("holds .{} as --output-format says, whatever its name ends in", writing.format), fileName);
  }
  if (options.lasScale > 0.0 && writing.format != "las" && writing.format != "laz")
  {
    warn(fmt::format("--las-scale has no effect on .{}; leave it out", writing.format), fileName);
  }
  const std::string shown = shownFile(fileName, "standard output");
  if (fileName != kStandardStream || writing.format != "vtp")
  {
    return writeFile(points, files.output(fileName), shown, writing);
  }
  // The writer of VTP seeks in the file.
  const TemporaryFolder folder;
  const std::string path = folder.path("output");
  const vtkIdType count = writeFile(points, path, shown, writing);
  copyToStandardOutput(path);
  return count;
}

Cloud mergedCloud(std::vector<Cloud>& clouds)
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
      warn(note);
    }
  }
  std::fill(clouds.begin(), clouds.end(), Cloud());
  return merged;
}

std::string whyNoLengths(vtkPolyData* cloud, const AffineTransform& transform)
{
  if (lengthUnitOf(cloud, Bounds()).name != "deg")
  {
    return {};
  }
  constexpr double kFewestPerLatitude = 1e4; // of a length
  const double perLongitude = inLocalMetres(cloud)->GetFieldData()->GetArray(kLocalFrame)->GetTuple1(2);
  const auto lengthOf = [&](const Vec3& v) { return norm(transform.applyToVector(v)); };
  const double z = lengthOf({ 0, 0, 1 });
  const bool areLengths = lengthOf({ 1, 0, 0 }) > std::min(100.0, 0.1 * perLongitude) * z &&
    lengthOf({ 0, 1, 0 }) > kFewestPerLatitude * z;
  return areLengths ? "" : "x and y are degrees and z is a length; project the cloud to metres";
}

void sayMetres(vtkPolyData* cloud)
{
  cloud->GetFieldData()->RemoveArray(kHeightUnit);
  io::addFieldText(cloud, "LengthUnit", kLengthUnits[0].word);
}

std::string noFinitePoint(const std::string& fileName, std::int64_t count)
{
  return fmt::format("{}: no point is finite: {} with a coordinate that is NaN or infinite; mend the file",
    fileName, countOfPoints(count));
}

void showNotes(const Cloud& cloud)
{
  for (const std::string& note : cloud.notes)
  {
    warn(note, shownFile(cloud.name));
  }
}

void showWarnings()
{
  for (const std::string& warning : takeVtkWarnings())
  {
    warn(warning);
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
