#include "vtkPointCloudWriter.h"

#include "Bytes/FileBytes.h"
#include "FileProblem.h"
#include "FormatWriters.h"
#include "IO/Info/FieldText.h"
#include "IO/Las/LasCoordinateSystem.h"
#include "IO/Vtk/VtpWriter.h"
#include "WriteTask.h"

#include "Core/Base/Host/GuardedWork.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace io = pointhaptics::io;

vtkStandardNewMacro(vtkPointCloudWriter);

namespace
{

struct FileFormat
{
  const char* extension;
  const char* name;
  const char* keptFieldData; ///< names, separated by spaces, but for LengthUnit
};

const FileFormat kFormats[] = {
  { "vtp", "VTP", "" },
  { "ply", "PLY", "" },
  { "pcd", "PCD", "Viewpoint OrganizedDimensions" },
  { "las", "LAS", "LasScale LasOffset LasGlobalEncoding CoordinateSystem" },
  { "laz", "LAZ", "LasScale LasOffset LasGlobalEncoding CoordinateSystem" },
  { "csv", "CSV", "" },
  { "xyz", "text", "" },
};

/// What a comment or a header of @p format says of the unit of @p cloud. Metres, which clouds without a unit
/// are taken to be in, are left out of the names that programs look for in a table.
std::string unitFor(const FileFormat& format, vtkPointSet* cloud)
{
  const std::string unit = io::fieldText(cloud->GetFieldData(), "LengthUnit");
  const bool isLeftOut = io::isMetre(unit) && format.name == std::string("CSV");
  return io::isUnitWord(unit) && !isLeftOut ? unit : std::string();
}

bool keeps(const FileFormat& format, vtkPointSet* cloud, const std::string& fieldName)
{
  if (fieldName == "LengthUnit")
  {
    const bool isLas = format.name == std::string("LAS") || format.name == std::string("LAZ");
    return isLas ? io::lasSaysUnit(cloud->GetFieldData()) : !unitFor(format, cloud).empty();
  }
  return (" " + std::string(format.keptFieldData) + " ").find(" " + fieldName + " ") != std::string::npos;
}

/// Null where no format has the extension.
const FileFormat* formatOf(const std::string& extension)
{
  const FileFormat* found = std::find_if(std::begin(kFormats), std::end(kFormats),
    [&](const FileFormat& format) { return extension == format.extension; });
  return found == std::end(kFormats) ? nullptr : found;
}

/// Field data that vtkPointCloudReader adds to a cloud; that of filters is no loss.
constexpr const char* kOfTheCloud[] = { "Viewpoint", "OrganizedDimensions", "CoordinateSystem", "LengthUnit",
  "ScanPoses" };

/// Whether @p name is a viewpoint or poses (tx ty tz qw qx qy qz) that change nothing.
bool isIdentityPose(vtkPointSet* cloud, const std::string& name)
{
  const double usual[] = { 0, 0, 0, 1, 0, 0, 0 };
  vtkDataArray* poses = cloud->GetFieldData()->GetArray(name.c_str());
  bool same = (name == "Viewpoint" || name == "ScanPoses") && poses && poses->GetNumberOfComponents() == 7;
  for (vtkIdType row = 0; same && row < poses->GetNumberOfTuples(); ++row)
  {
    for (int i = 0; i < 7 && same; ++i)
    {
      same = poses->GetComponent(row, i) == usual[i];
    }
  }
  return same;
}

void noteWhatIsNoColumn(vtkPointSet* cloud, const FileFormat& format, io::WriterNotes& notes)
{
  std::string lost;
  for (const std::string name : kOfTheCloud)
  {
    if (!keeps(format, cloud, name) && cloud->GetFieldData()->HasArray(name.c_str()) &&
      !isIdentityPose(cloud, name))
    {
      lost += (lost.empty() ? "" : ", ") + name;
    }
  }
  if (!lost.empty())
  {
    notes.add("field data " + lost + (lost.find(',') == std::string::npos ? " is" : " are") + " left out");
  }
  vtkPolyData* polyData = vtkPolyData::SafeDownCast(cloud);
  const vtkIdType faces = polyData ? polyData->GetNumberOfCells() - polyData->GetNumberOfVerts() : 0;
  if (faces > 0)
  {
    notes.add(std::to_string(faces) + " lines and faces are left out");
  }
}

} // namespace

vtkPointCloudWriter::vtkPointCloudWriter() = default;

bool vtkPointCloudWriter::CanWrite(const std::string& fileName)
{
  return formatOf(io::lowerExtension(fileName)) != nullptr;
}

const char* vtkPointCloudWriter::GetExtensions()
{
  return ".vtp, .ply, .pcd, .las, .laz, .csv or .xyz";
}

vtkPointCloudWriter::~vtkPointCloudWriter()
{
  this->SetFileName(nullptr);
}

int vtkPointCloudWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

void vtkPointCloudWriter::Fail(unsigned long code, const std::string& message)
{
  this->ErrorMessage = this->FileName ? this->FileName : "no file name";
  this->ErrorMessage += ": ";
  if (!this->Format.empty())
  {
    this->ErrorMessage += this->Format + ": ";
  }
  this->ErrorMessage += message;
  this->SetErrorCode(code);
  vtkErrorMacro(<< this->ErrorMessage);
}

void vtkPointCloudWriter::SetExtension(const std::string& extension)
{
  if (this->Extension != extension)
  {
    this->Extension = extension;
    this->Modified();
  }
}

int vtkPointCloudWriter::Write()
{
  this->ErrorMessage.clear();
  this->Format.clear();
  this->Notes.clear();
  this->NumberOfPointsWritten = 0;
  this->SetErrorCode(vtkErrorCode::NoError);
  if (this->GetNumberOfInputConnections(0) < 1)
  {
    this->Fail(vtkErrorCode::UserError, "there is nothing to write; connect a point cloud");
    return 0;
  }
  const int written = this->Superclass::Write();
  return written && this->ErrorMessage.empty() ? 1 : 0;
}

void vtkPointCloudWriter::WriteCloud(vtkPointSet* cloud)
{
  const std::string extension =
    this->Extension.empty() ? io::lowerExtension(this->FileName) : this->Extension;
  const FileFormat* format = formatOf(extension);
  if (!format)
  {
    throw io::FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
      "unknown extension " + io::inQuotes("." + extension), std::string("use ") + GetExtensions());
  }
  this->Format = format->name;
  if (!cloud || cloud->GetNumberOfPoints() == 0)
  {
    io::failFormat(
      "the cloud holds no points", "check the steps before: was the workspace away from the cloud?");
  }
  io::WriteTask task(this->FileName, this);
  task.points = cloud->GetNumberOfPoints();
  task.lasScale = this->LasScale;
  task.progress(0.0);
  if (this->Format == "VTP")
  {
    if (!task.out.isReplacing())
    {
      throw io::FileProblem(vtkErrorCode::CannotOpenFileError,
        "VTP files cannot be written to a pipe or a device",
        "choose the name of a new file, or .ply, .pcd, .las, .laz, .csv or .xyz");
    }
    io::writeVtp(cloud, task);
  }
  else
  {
    noteWhatIsNoColumn(cloud, *format, task.notes);
    task.unit = unitFor(*format, cloud);
    const std::vector<io::OutputArray> arrays = io::outputArrays(cloud, task.notes);
    if (this->Format == "PLY")
    {
      io::writePly(arrays, task);
    }
    else if (this->Format == "PCD")
    {
      io::writePcd(arrays, cloud->GetFieldData(), task);
    }
    else if (this->Format == "LAS" || this->Format == "LAZ")
    {
      io::writeLas(arrays, cloud->GetFieldData(), task, this->Format == "LAZ");
    }
    else
    {
      io::writeTable(arrays, task, this->Format == "CSV" ? ',' : ' ');
    }
  }
  task.out.commit();
  this->Notes = task.notes.all;
  this->NumberOfPointsWritten = task.points;
}

void vtkPointCloudWriter::WriteData()
{
  if (!this->FileName || !*this->FileName)
  {
    this->Fail(vtkErrorCode::NoFileNameError, "there is nowhere to write to; set a file name");
    return;
  }
  const pointhaptics::WithoutInterpreterLock unlocked;
  try
  {
    this->WriteCloud(vtkPointSet::SafeDownCast(this->GetInput()));
  }
  catch (const io::FileProblem& problem)
  {
    this->Fail(problem.code, problem.what());
  }
  catch (const io::StoppedOnRequest&)
  {
    this->ErrorMessage = std::string(this->FileName) + ": writing was stopped on request; write it again";
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const std::exception& fault)
  {
    pointhaptics::isOutOfMemory(fault)
      ? this->Fail(pointhaptics::kOutOfMemoryCode, message(pointhaptics::Status::OutOfMemory))
      : this->Fail(vtkErrorCode::CannotOpenFileError, std::string(fault.what()) + "; check the path");
  }
}

void vtkPointCloudWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Extension: " << this->Extension << "\n";
  os << indent << "LasScale: " << this->LasScale << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
}
