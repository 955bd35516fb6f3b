#include "vtkPointCloudWriter.h"

#include "Bytes/FileBytes.h"
#include "FileProblem.h"
#include "IO/Formats/FormatList.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Info/FieldText.h"
#include "IO/Info/FileComments.h"
#include "IO/Info/LengthUnit.h"
#include "IO/Las/LasCoordinateSystem.h"
#include "WriteTask.h"

#include "Core/Base/Host/GuardedWork.h"
#include "Core/Base/Host/StopRequest.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationIterator.h"
#include "vtkInformationKey.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <fmt/format.h>

#include <initializer_list>
#include <string_view>

namespace io = pointhaptics::io;

vtkStandardNewMacro(vtkPointCloudWriter);

namespace
{

/// Unit of @p cloud for a comment or a header of @p format. Metres, the default unit of clouds, are left out
/// of the names that programs look for in a table.
std::string unitFor(const io::CloudFormat& format, vtkPointSet* cloud)
{
  const std::string unit = io::fieldText(cloud->GetFieldData(), "LengthUnit");
  const bool isLeftOut = io::isMetre(unit) && format.name == std::string("CSV");
  return io::isUnitWord(unit) && !isLeftOut ? unit : std::string();
}

bool keeps(const io::CloudFormat& format, vtkPointSet* cloud, const std::string& fieldName)
{
  if (fieldName == "LengthUnit")
  {
    const bool isLas = format.name == std::string("LAS") || format.name == std::string("LAZ");
    return isLas ? io::lasSaysUnit(cloud->GetFieldData()) : !unitFor(format, cloud).empty();
  }
  if (fieldName == pointhaptics::kHeightUnit)
  {
    return std::string_view(format.keptFieldData).find("Las") == std::string_view::npos ||
      io::fieldText(cloud->GetFieldData(), "CoordinateSystem").find("VERT") != std::string::npos;
  }
  return (" " + std::string(format.keptFieldData) + " ").find(" " + fieldName + " ") != std::string::npos;
}

/// Field data that tells how a file was written or a cloud was made: without it nothing of the cloud is lost.
constexpr std::string_view kOfTheMaking =
  " LasScale LasOffset LasGlobalEncoding LasHeader LasRecords LasFarRecords Generator Chunks LocalFrame "
  "ScanNames ScanPoints File LatticeOrigin LatticeSpacing LatticeDimensions ModelToWorkspace ";

/// True if @p name is a viewpoint or poses (tx ty tz qw qx qy qz) that change nothing.
bool isIdentityPose(vtkPointSet* cloud, const std::string& name)
{
  vtkDataArray* poses = cloud->GetFieldData()->GetArray(name.c_str());
  bool same = (name == "Viewpoint" || name == "ScanPoses") && poses && poses->GetNumberOfComponents() == 7;
  for (vtkIdType i = 0; same && i < poses->GetNumberOfValues(); ++i)
  {
    same = poses->GetComponent(i / 7, static_cast<int>(i % 7)) == (i % 7 == 3 ? 1.0 : 0.0);
  }
  return same;
}

/// Names of what others noted about @p array; ranges, which VTK notes itself, are none of them.
std::string informationOf(vtkAbstractArray* array)
{
  std::string names;
  if (!array->HasInformation())
  {
    return names;
  }
  vtkNew<vtkInformationIterator> keys;
  keys->SetInformationWeak(array->GetInformation());
  for (keys->InitTraversal(); !keys->IsDoneWithTraversal(); keys->GoToNextItem())
  {
    const std::string name = keys->GetCurrentKey()->GetName();
    const bool isRange = name.find("RANGE") != std::string::npos || name.rfind("PER_", 0) == 0;
    names += isRange ? "" : (names.empty() ? "" : ", ") + name;
  }
  return names;
}

void noteInformation(vtkPointSet* cloud, std::vector<std::string>& notes)
{
  const auto note = [&](vtkAbstractArray* array, const char* name)
  {
    const std::string keys = informationOf(array);
    keys.empty() ? void()
                 : notes.push_back("what is noted of array " + io::inQuotes(name ? name : "") + " as " +
                     keys + " is left out");
  };
  note(cloud->GetPoints()->GetData(), "Points");
  for (vtkFieldData* data : std::initializer_list<vtkFieldData*>{
         cloud->GetPointData(), cloud->GetCellData(), cloud->GetFieldData() })
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      note(data->GetAbstractArray(i), data->GetAbstractArray(i)->GetName());
    }
  }
}

void noteWhatIsNoColumn(vtkPointSet* cloud, const io::CloudFormat& format, std::vector<std::string>& notes)
{
  std::string lost;
  for (int i = 0; i < cloud->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    const char* given = cloud->GetFieldData()->GetAbstractArray(i)->GetName();
    const std::string name = io::utf8Name(given ? given : "");
    if (!keeps(format, cloud, name) && kOfTheMaking.find(" " + name + " ") == std::string_view::npos &&
      !isIdentityPose(cloud, name))
    {
      const std::string unit = name == "LengthUnit" ? io::fieldText(cloud->GetFieldData(), name.c_str()) : "";
      if (unit.empty())
      {
        lost += (lost.empty() ? "" : ", ") + io::inQuotes(name);
      }
      else if (unit != "metre") // readers take metres where nothing is said
      {
        notes.push_back("the file does not say that the unit is " + io::inQuotes(unit) +
          ": readers guess it by the cloud's size, or take --unit");
      }
    }
  }
  if (!lost.empty())
  {
    notes.push_back(
      "field data " + lost + (lost.find(',') == std::string::npos ? " is" : " are") + " left out");
  }
  vtkPolyData* polyData = vtkPolyData::SafeDownCast(cloud);
  const vtkIdType faces = polyData ? polyData->GetNumberOfCells() - polyData->GetNumberOfVerts() : 0;
  if (faces > 0)
  {
    notes.push_back(std::to_string(faces) + " lines and faces are left out");
  }
}

} // namespace

bool vtkPointCloudWriter::CanWrite(const std::string& fileName)
{
  return io::writtenFormat(io::lowerExtension(fileName)) != nullptr;
}

const char* vtkPointCloudWriter::GetExtensions()
{
  static const std::string list = []
  {
    const std::vector<std::string> all = io::formatExtensions(true);
    return fmt::format(".{} or .{}", fmt::join(all.begin(), all.end() - 1, ", ."), all.back());
  }();
  return list.c_str();
}

vtkPointCloudWriter::~vtkPointCloudWriter()
{
  this->SetFileName(nullptr);
}

int vtkPointCloudWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet"); // which WriteData() refuses
  return 1;
}

void vtkPointCloudWriter::Fail(unsigned long code, const std::string& message)
{
  this->ErrorMessage = io::messageOf(this->FileName, this->Format, message);
  this->SetErrorCode(code);
  vtkErrorMacro(<< this->ErrorMessage);
}

int vtkPointCloudWriter::Write()
{
  this->SetAbortExecute(0); // a stop is for the write that it came in; VTK 9.1 forgets it, 9.3 does not
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
  const io::CloudFormat* format = io::writtenFormat(extension);
  if (!format)
  {
    throw io::FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
      "unknown extension " + io::inQuotes("." + extension), std::string("use ") + GetExtensions());
  }
  this->Format = format->name;
  io::failFormatIf(!cloud || cloud->GetNumberOfPoints() == 0,
    "check the steps before: was the workspace away from the cloud?", "the cloud holds no points");
  io::WriteTask task(this->FileName, this);
  task.points = cloud->GetNumberOfPoints();
  task.lasScale = this->LasScale;
  task.keepsDoubles = this->KeepDoubles;
  task.progress(0.0);
  task.cloud = cloud;
  noteInformation(cloud, task.notes);
  if (this->Format != "VTP") // which keeps all else
  {
    noteWhatIsNoColumn(cloud, *format, task.notes);
    task.comments.unit = unitFor(*format, cloud);
    task.comments.heightUnit = io::fieldText(cloud->GetFieldData(), pointhaptics::kHeightUnit);
  }
  format->write(task);
  task.out.commit();
  this->Notes = task.notes;
  this->NumberOfPointsWritten = task.points;
}

void vtkPointCloudWriter::WriteData()
{
  this->SetProgressShiftScale(0.0, 1.0);
  if (!this->FileName || !*this->FileName)
  {
    this->Fail(vtkErrorCode::NoFileNameError, "there is nowhere to write to; set a file name");
    return;
  }
  pointhaptics::HostStop stop(this->AbortExecute);
  const pointhaptics::WithoutInterpreterLock unlocked(stop.request());
  try
  {
    pointhaptics::requireRoomOfWork();
    io::failFormatIf(vtkCompositeDataSet::SafeDownCast(this->GetInput()), "merge them first (vtkMergeBlocks)",
      "the input has blocks, and a file holds one cloud");
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
  os << indent << "KeepDoubles: " << (this->KeepDoubles ? "On" : "Off") << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
}
