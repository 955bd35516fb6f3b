#include "vtkPointCloudReader.h"

#include "Bytes/FileBytes.h"
#include "FileProblem.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatList.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Info/CloudExtent.h"
#include "IO/Info/FieldText.h"
#include "IO/Info/LengthUnit.h"
#include "IO/Las/LasHeader.h"
#include "IO/Mesh/FaceSamples.h"
#include "ReadTask.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/Host/GuardedWork.h"
#include "Core/Base/Host/StopRequest.h"
#include "Core/Base/QuantityText.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <limits>
#include <numeric>
#include <set>
#include <string_view>

namespace io = pointhaptics::io;
using pointhaptics::Bounds;
using pointhaptics::Vec3;

vtkStandardNewMacro(vtkPointCloudReader);

namespace
{

/// The universe spans 9e26 metres. A float's, so that float and double points have the same limit.
constexpr double kMostCoordinate = 1e30f;

/// Bytes that tell a cloud optimised point cloud from others.
constexpr std::size_t kCopcStart = 400;
/// Bytes that show what format a file has.
constexpr std::size_t kStart = 65536;

/// The first coordinate of @p count that is finite and too large for any unit; @p count where none is. The
/// largest float stands for no data in grids of GDAL and Esri, and becomes NaN; @p noData counts those.
template <typename T>
vtkIdType firstImpossible(T* values, vtkIdType count, std::int64_t& noData)
{
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double size = std::abs(values[i]);
    if (size > kMostCoordinate && std::isfinite(size))
    {
      if (size < 3.4e38 || size > 3.41e38) // in texts it has few digits
      {
        return i;
      }
      values[i] = std::numeric_limits<T>::quiet_NaN();
      ++noData;
    }
  }
  return count;
}

/// A coordinate too large for any unit means a damaged file. @return how many stand for no data.
std::int64_t checkCoordinates(vtkPolyData* cloud)
{
  vtkDataArray* array = cloud->GetPoints()->GetData();
  const vtkIdType count = array->GetNumberOfValues();
  vtkIdType at = count;
  std::int64_t noData = 0;
  const auto check = [&](auto* typed)
  { at = typed ? firstImpossible(typed->GetPointer(0), count, noData) : at; };
  check(vtkFloatArray::FastDownCast(array));
  check(vtkDoubleArray::FastDownCast(array));
  if (at < count)
  {
    io::failFormat(fmt::format("point {} of {}: {} is {:g}, which can be no position", at / 3, count / 3,
                     "xyz"[at % 3], array -> GetComponent(at / 3, static_cast<int>(at % 3))),
      io::kDamagedCure);
  }
  return noData;
}

/// Takes away the points outside the box that is wanted, with their values in all arrays. Among floats its
/// ends are floats, too: 0.2 is no less than the 0.2 of a point.
void keepInside(const io::ReadTask& task, vtkPolyData* cloud)
{
  std::array<double, 6> box = task.wanted.box;
  vtkNew<vtkIdList> kept;
  vtkPoints* points = cloud->GetPoints();
  for (double& end : box)
  {
    end = points->GetDataType() == VTK_FLOAT ? double(float(end)) : end;
  }
  const Bounds wanted{ { box[0], box[2], box[4] }, { box[1], box[3], box[5] } };
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    const double* at = points->GetPoint(i);
    pointhaptics::contains(wanted, { at[0], at[1], at[2] }) ? void(kept->InsertNextId(i)) : void();
  }
  io::failFormatIf(
    task.sumOfRanks(kept->GetNumberOfIds()) == 0 && task.sumOfRanks(points->GetNumberOfPoints()) > 0,
    "choose a box that meets the bounds of the cloud", "no point lies in the box");
  if (kept->GetNumberOfIds() < points->GetNumberOfPoints())
  {
    io::keepPoints(cloud, kept);
  }
}

/// Floats far from the origin lie on a coarse grid: "0.5 in y, 0.0312 in x" where its steps can be seen in
/// the cloud; else empty.
std::string coarseFloats(const io::ReadTask& task, vtkPolyData* cloud)
{
  constexpr double kNear = 1000.0;  // its steps are far below a millimetre of the unit
  constexpr double kVisible = 0.05; // of the spacing of a surface of as many points
  vtkFloatArray* floats = vtkFloatArray::FastDownCast(cloud->GetPoints()->GetData());
  const bool isFar = floats && floats->GetNumberOfValues() > 0 &&
    std::max({ std::abs(floats->GetValue(0)), std::abs(floats->GetValue(1)),
      std::abs(floats->GetValue(2)) }) > kNear;
  if (task.sumOfRanks(isFar ? 1 : 0) == 0)
  {
    return {};
  }
  const double* own = cloud->GetBounds();
  const bool isHere = cloud->GetNumberOfPoints() > 0;
  Bounds box;
  for (const Bounds& part :
    task.ofRanks(isHere ? Bounds{ { own[0], own[2], own[4] }, { own[1], own[3], own[5] } } : Bounds()))
  {
    part.empty() ? void() : box.include(part.minimum);
    part.empty() ? void() : box.include(part.maximum);
  }
  const Vec3 size = box.extent();
  const double spacing = std::max({ size.x, size.y, size.z }) /
    std::sqrt(static_cast<double>(task.sumOfRanks(cloud->GetNumberOfPoints())));
  const Vec3 steps = pointhaptics::floatSteps(box);
  std::string text;
  for (int a = 0; a < 3; ++a)
  {
    text += steps[a] > kVisible * spacing
      ? fmt::format("{}{:.3g} in {}", text.empty() ? "" : ", ", steps[a], "xyz"[a])
      : "";
  }
  return text;
}

/// Stores the format's name and the notes, also when reading fails.
struct KeepFindings
{
  io::ReadTask& task;
  std::string& format;
  std::vector<std::string>& notes;
  ~KeepFindings()
  {
    format = std::move(task.format);
    notes = std::move(task.notes);
  }
};

/// Files of other programs have names in Latin-1, which no host could show and no VTP file hold.
void useUtf8Names(vtkFieldData* data)
{
  std::set<std::string> used;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const std::string given = array->GetName() ? array->GetName() : "";
    const std::string name = given.empty() ? given : io::unusedName(used, io::utf8Name(given));
    name != given ? array->SetName(name.c_str()) : void();
  }
}

} // namespace

vtkPointCloudReader::vtkPointCloudReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkPointCloudReader::~vtkPointCloudReader()
{
  this->SetFileName(nullptr);
}

void vtkPointCloudReader::SetColumns(const std::vector<std::string>& names)
{
  if (this->Columns != names)
  {
    this->Columns = names;
    this->Modified();
  }
}

std::vector<std::string> vtkPointCloudReader::GetExtensions()
{
  return io::formatExtensions(false);
}

std::string vtkPointCloudReader::GetFormatTable()
{
  return io::formatTable();
}

bool vtkPointCloudReader::IsShared() const
{
  return this->Ranks && this->Ranks->size() > 1;
}

void vtkPointCloudReader::ReadInto(vtkPolyData* cloud)
{
  io::ReadTask task;
  task.path = this->FileName;
  task.extension = this->ExtensionOf(task.path);
  task.columns = this->Columns;
  task.salvage = this->Salvage;
  task.faces.cells.TakeReference(this->Samples != 0 ? vtkCellArray::New() : nullptr);
  task.algorithm = this;
  task.wanted.onlyPositions = this->OnlyPositions;
  task.wanted.resolution = this->Resolution;
  task.wanted.mostPoints = static_cast<std::uint64_t>(this->MostPoints);
  std::copy_n(this->Box, 6, task.wanted.box.begin());
  task.applyPoses = this->ApplyPoses;
  const KeepFindings keep{ task, this->Format, this->Notes };
  if (this->IsShared())
  {
    this->ReadTogether(task, cloud);
  }
  else if (task.wanted.isPart() && io::startsLikeCopc(io::startOfFile(task.path, kCopcStart)))
  {
    this->ReadPart(task, cloud);
  }
  else
  {
    this->ReadWhole(task, cloud);
  }
  this->Coarse = task.isCoarse;
  cloud->SetPolys(nullptr);
  if (this->GenerateVertices)
  {
    io::setOneVertexPerPoint(cloud);
  }
}

/// A fault of this rank is told to the others before it goes on its way.
void vtkPointCloudReader::ReadTogether(io::ReadTask& task, vtkPolyData* cloud)
{
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(task.path, missing);
  const std::uintmax_t bytes = missing ? 0 : size;
  io::SharedReading shared(*this->Ranks, bytes);
  try
  {
    const std::string start = io::startOfFile(task.path, kStart);
    const bool isGzip = start.compare(0, 2, "\x1f\x8b") == 0;
    if (this->Samples == 0 && !this->LocalMetres && !start.empty() && !isGzip &&
      io::identifyFormat(start, static_cast<std::size_t>(bytes), task.extension).isReadInParts)
    {
      task.shared = &shared;
      this->ReadPart(task, cloud);
    }
    else
    {
      this->ReadWhole(task, cloud);
    }
    if (!task.isCut)
    {
      const io::RowRange rows = shared.rowsOf(static_cast<std::uint64_t>(cloud->GetNumberOfPoints()));
      vtkNew<vtkIdList> kept;
      kept->SetNumberOfIds(static_cast<vtkIdType>(rows.count()));
      std::iota(kept->begin(), kept->end(), static_cast<vtkIdType>(rows.first));
      io::keepPoints(cloud, kept);
    }
    shared.gather({});
  }
  catch (...)
  {
    shared.fail(); // does nothing where another rank failed
    throw;
  }
}

/// Loads no more of the file than is asked for.
void vtkPointCloudReader::ReadPart(io::ReadTask& task, vtkPolyData* cloud)
{
  io::FileBytes part(task.path);
  task.bytes = part.view();
  task.load = [&](std::size_t offset, std::size_t size) { part.load(offset, size); };
  const io::CloudFormat& format =
    io::identifyFormat(io::startOfFile(task.path, kStart), part.view().size(), task.extension);
  task.format = format.name;
  format.read(task, cloud);
  this->NumberOfBytesRead = static_cast<vtkTypeInt64>(part.loaded() + task.bytesElsewhere);
  this->Finish(task, cloud);
}

void vtkPointCloudReader::ReadWhole(io::ReadTask& task, vtkPolyData* cloud)
{
  const io::CloudFormat* format = nullptr;
  const io::FileBytes bytes(
    task.path, [&](double done) { task.readingProgress(done); },
    [&](std::string_view start, std::size_t size)
    {
      format = &io::identifyFormat(start, size, task.extension);
      task.format = format->name;
    },
    task.salvage);
  const std::string converted = io::isUtf16(bytes.view()) ? io::utf8Of(bytes.view()) : std::string();
  task.bytes = converted.empty() ? bytes.view() : std::string_view(converted);
  task.isPackedCut = bytes.isCut();
  if (task.isPackedCut && io::isText(task.bytes))
  {
    task.bytes = task.bytes.substr(0, task.bytes.rfind('\n') + 1); // the last number may be torn
  }
  std::error_code ignored;
  task.isStream = bytes.wasPacked() || !std::filesystem::is_regular_file(task.path, ignored);
  format->read(task, cloud);
  this->NumberOfBytesRead = static_cast<vtkTypeInt64>(bytes.view().size() + task.bytesElsewhere);
  this->Finish(task, cloud);
}

/// Checks the cloud of any format, and cuts it to the box.
void vtkPointCloudReader::Finish(io::ReadTask& task, vtkPolyData* cloud)
{
  if (task.isPackedCut && !task.isTorn())
  {
    task.notes.push_back("the gzip file is cut: what is there of it is read");
  }
  if (const std::int64_t noData = task.sumOfRanks(checkCoordinates(cloud)); noData > 0)
  {
    task.notes.push_back(pointhaptics::countText(noData) +
      (noData == 1 ? " coordinate is" : " coordinates are") +
      " 3.4e38, which stands for no data, and become" + (noData == 1 ? "s NaN" : " NaN"));
  }
  useUtf8Names(cloud->GetPointData());
  useUtf8Names(cloud->GetFieldData());
  cloud->GetFieldData()->RemoveArray(pointhaptics::kLocalFrame); // of another cloud that a file was made of
  this->FinishFaces(task, cloud);
  io::finishSplats(task, cloud);
  if (const std::string steps = coarseFloats(task, cloud); !steps.empty())
  {
    task.notes.push_back(
      "coordinates are floats so far from the origin that they lie on a grid of steps of " + steps +
      ", and no finer voxel means anything; export them as double, or with an offset taken away");
  }
  const auto isInDegrees = [cloud] { return pointhaptics::lengthUnitOf(cloud, Bounds()).name == "deg"; };
  if (pointhaptics::looksLikeDegrees(cloud))
  {
    task.notes.push_back("x and y may be degrees of longitude and latitude, by their range beside that of z: "
                         "view and feel take them so unless --unit is given");
    this->LocalMetres ? io::addFieldText(cloud, "LengthUnit", "degree") : void();
  }
  if (const std::string heights = io::fieldText(cloud->GetFieldData(), pointhaptics::kHeightUnit);
      !heights.empty())
  {
    task.notes.push_back("heights are in " + heights + ", x and y in " +
      (isInDegrees() ? std::string("degrees")
                     : io::fieldText(cloud->GetFieldData(), "LengthUnit") +
            ": lengths and voxels are wrong until heights are converted"));
  }
  if (isInDegrees() && !this->LocalMetres)
  {
    task.notes.push_back(
      "x and y are degrees of longitude and latitude, which are no lengths; view and feel take metres "
      "about their middle. To project the cloud: pdal translate IN OUT reprojection "
      "--filters.reprojection.out_srs=EPSG:UTM-ZONE");
  }
  if (task.wanted.hasBox())
  {
    keepInside(task, cloud);
  }
  if (this->LocalMetres && isInDegrees())
  {
    cloud->ShallowCopy(pointhaptics::inLocalMetres(cloud));
    task.notes.emplace_back("x and y were degrees of longitude and latitude, and are metres to the east and "
                            "north of their medians");
  }
}

/// Says of a mesh what the points are, which are samples of its faces where these are wanted.
void vtkPointCloudReader::FinishFaces(io::ReadTask& task, vtkPolyData* cloud)
{
  if (task.faces.others > 0)
  {
    task.notes.push_back(
      "the points are vertices: strips and cells are not read as faces, of which there are " +
      pointhaptics::countText(static_cast<std::int64_t>(task.faces.others)) +
      "; save their surface as polygons, for example with ParaView's filters Extract Surface and "
      "Triangulate");
  }
  if (task.faces.count == 0 || task.isTorn()) // the faces of a torn file come after what is missing
  {
    this->Samples > 0 && !task.isTorn()
      ? task.notes.push_back("there are no faces to sample: the points stay")
      : void();
    return;
  }
  if (!task.faces.isWanted() || task.faces.cells->GetNumberOfCells() == 0)
  {
    task.notes.push_back("the points are the vertices of " + io::facesText(task.faces.count) +
      (task.faces.isWanted() ? ", which cannot be read" : ""));
    return;
  }
  const auto progress = [this](double done)
  { io::reportProgress(this, 1.0 - io::kSamplingPart * (1.0 - done)); };
  progress(0.0);
  cloud->SetPolys(task.faces.cells);
  task.notes.emplace_back();
  this->Sampled = io::sampleFaces(cloud, this->Samples, task.faces.count, progress, task.notes.back());
}

/// The one to go by where the content leaves the format open.
std::string vtkPointCloudReader::ExtensionOf(const std::string& path) const
{
  const bool isNamedGz = io::lowerExtension(path) == "gz";
  return this->Extension.empty() ? io::lowerExtension(path.substr(0, path.size() - (isNamedGz ? 3 : 0)))
                                 : this->Extension;
}

vtkMTimeType vtkPointCloudReader::GetMTime()
{
  if (this->RunsAgain)
  {
    this->RetryTime.Modified();
  }
  return std::max(this->Superclass::GetMTime(), this->RetryTime.GetMTime());
}

void vtkPointCloudReader::Fail(unsigned long code, const std::string& message)
{
  this->ErrorMessage = io::messageOf(this->FileName, this->Format, message);
  this->RunsAgain = this->RepeatsErrors && !this->IsShared();
  this->SetErrorCode(code);
  vtkErrorMacro(<< this->ErrorMessage);
}

int vtkPointCloudReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  this->ErrorMessage.clear();
  this->Format.clear();
  this->Notes.clear();
  this->ValidWithoutPoints = false;
  this->OtherRankFailed = false;
  this->RunsAgain = false;
  this->NumberOfBytesRead = 0;
  this->Coarse = false;
  this->Sampled = false;
  this->SetErrorCode(vtkErrorCode::NoError);
  this->SetProgressShiftScale(0.0, 1.0);
  // The pipeline goes on with an empty cloud after a fault: returning 0 would add the executive's own
  // message, which callers cannot silence.
  pointhaptics::HostStop stop(this->AbortExecute);
  const pointhaptics::WithoutInterpreterLock unlocked(stop.request());
  try
  {
    if (!this->FileName || !*this->FileName)
    {
      throw io::FileProblem(vtkErrorCode::NoFileNameError, "there is nothing to read", "set a file name");
    }
    pointhaptics::requireRoomOfWork();
    this->ReadInto(output);
    this->UpdateProgress(1.0);
    return 1;
  }
  catch (const io::FileProblem& problem)
  {
    this->ValidWithoutPoints = dynamic_cast<const io::NoPoints*>(&problem) != nullptr;
    this->Fail(problem.code, problem.what());
  }
  catch (const io::OtherRankFailed&)
  {
    this->OtherRankFailed = true;
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const io::StoppedOnRequest&)
  {
    this->RunsAgain = true;
    this->ErrorMessage = std::string(this->FileName) + ": reading was stopped on request; read it again";
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const std::exception& fault)
  {
    pointhaptics::isOutOfMemory(fault)
      ? this->Fail(pointhaptics::kOutOfMemoryCode, message(pointhaptics::Status::OutOfMemory))
      : this->Fail(vtkErrorCode::UnknownError,
          std::string(fault.what()) + "; the file is probably damaged: copy it again");
  }
  this->ValidWithoutPoints ? void() : output->Initialize(); // else the field data that was found stays
  output->SetPoints(vtkNew<vtkPoints>());
  return 1;
}

void vtkPointCloudReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "MostPoints: " << this->MostPoints << "\n";
  os << indent << "Box: " << this->Box[0] << " " << this->Box[1] << " " << this->Box[2] << " " << this->Box[3]
     << " " << this->Box[4] << " " << this->Box[5] << "\n";
  os << indent << "OnlyPositions: " << (this->OnlyPositions ? "On" : "Off") << "\n";
  os << indent << "GenerateVertices: " << (this->GenerateVertices ? "On" : "Off") << "\n";
  os << indent << "Extension: " << this->Extension << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "LocalMetres: " << (this->LocalMetres ? "On" : "Off") << "\n";
  os << indent << "Salvage: " << (this->Salvage ? "On" : "Off") << "\n";
  os << indent << "ApplyPoses: " << this->ApplyPoses << "\n";
  os << indent << "Format: " << this->Format << "\n";
  os << indent << "RepeatsErrors: " << (this->RepeatsErrors ? "On" : "Off") << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
}
