#include "IO/Vtk/VtpWriter.h"

#include "IO/CloudColumns.h"
#include "IO/FileProblem.h"
#include "IO/Vtk/ErrorCollector.h"
#include "IO/WriteTask.h"

#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

namespace pointhaptics::io
{

namespace
{

/// VTK's writer takes no notice of AbortExecute; this one does at each progress report, at least once an
/// array: the rest is written nowhere, and Write() fails.
class VtpWriter : public vtkXMLPolyDataWriter
{
public:
  static VtpWriter* New();
  vtkTypeMacro(VtpWriter, vtkXMLPolyDataWriter);

protected:
  void UpdateProgressDiscrete(float progress) override
  {
    this->Superclass::UpdateProgressDiscrete(progress);
    if (this->AbortExecute && this->Stream)
    {
      this->Stream->setstate(std::ios::badbit);
    }
  }
};
vtkStandardNewMacro(VtpWriter);

/// All arrays at the end of the file, as they are in memory.
void useRawData(vtkXMLWriter* writer)
{
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
}

} // namespace

void writeVtp(vtkPointSet* cloud, const WriteTask& task)
{
  vtkNew<vtkPolyData> written;
  if (vtkPolyData* polyData = vtkPolyData::SafeDownCast(cloud))
  {
    written->ShallowCopy(polyData);
  }
  else
  {
    written->SetPoints(cloud->GetPoints());
    written->GetPointData()->ShallowCopy(cloud->GetPointData());
    written->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  }
  if (written->GetNumberOfCells() == 0)
  {
    setOneVertexPerPoint(written);
  }
  vtkNew<ErrorCollector> errors;
  vtkNew<VtpWriter> writer;
  useRawData(writer);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->SetInputData(written);
  writer->SetFileName(task.out.path().c_str());
  RelayedProgress progress(writer, task.algorithm, 0.0, 1.0);
  const bool isWritten = writer->Write() == 1;
  progress.finish();
  if (!isWritten || !errors->first().empty())
  {
    const bool full = writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError;
    throw FileProblem(full ? vtkErrorCode::OutOfDiskSpaceError : vtkErrorCode::CannotOpenFileError,
      errors->first().empty() ? "writing stopped" : errors->first(),
      full ? "free some space on the disk or write elsewhere"
           : "check the folder, its permissions and the free space");
  }
}

std::string vtpText(vtkPolyData* cloud)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  useRawData(writer);
  writer->SetInputData(cloud);
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

} // namespace pointhaptics::io
